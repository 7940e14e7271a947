#include "strutt/free_pendulum/normal_form.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "commands.hpp"
#include "exit_code.hpp"
#include "rows.hpp"
#include "scene_arguments.hpp"
#include "strutt/base/error.hpp"
#include "strutt/io/table.hpp"
#include "terminal.hpp"

namespace strutt::app {
namespace {

/// The columns of one component, in the order of the contract.
struct TermColumn {
  const char* suffix;
  double NonlinearTerms::*term;
};
constexpr std::array<TermColumn, 7> kTerms{{{"20", &NonlinearTerms::c20},
                                            {"11", &NonlinearTerms::c11},
                                            {"02", &NonlinearTerms::c02},
                                            {"30", &NonlinearTerms::c30},
                                            {"21", &NonlinearTerms::c21},
                                            {"12", &NonlinearTerms::c12},
                                            {"03", &NonlinearTerms::c03}}};

std::vector<std::string> term_names() {
  std::vector<std::string> names;
  for (const char* component : {"f1_", "f2_"})
    for (const auto& column : kTerms) names.push_back(std::string(component) + column.suffix);
  return names;
}

/// Sets the coefficient that a column names.
void set(PlanarCoefficients& system, const std::string& column, double value) {
  if (column == "alpha") {
    system.alpha = value;
    return;
  }
  NonlinearTerms& f = column.starts_with("f1_") ? system.f1 : system.f2;
  for (const auto& known : kTerms)
    if (column.ends_with(known.suffix)) f.*known.term = value;
}

/// The normal forms of all rows: what is wrong with one is found before anything is written.
std::vector<NormalForm> compute(const NumericTable& table) {
  std::vector<NormalForm> forms;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    PlanarCoefficients system;
    for (std::size_t j = 0; j < table.columns.size(); ++j) set(system, table.columns[j], table.rows[i][j]);
    try {
      forms.push_back(normal_form(system));
    } catch (const InvalidInput& error) {
      throw table.error_at(i, table.column("alpha"), error.what());  // the only one with a range
    }
  }
  return forms;
}

std::vector<Column> columns_of(const NumericTable& table) {
  std::vector<Column> columns;
  for (const auto& name : table.columns) columns.push_back({name, "1"});
  columns.insert(columns.end(), {{"delta", "1"}, {"beta", "1"}});
  return columns;
}

}  // namespace

ExitCode run(const NormalFormArguments& arguments) {
  if (arguments.tolerance)
    throw UsageError("--tolerance is not for normal-form, which computes to full double precision");
  threads_of(arguments);
  const NumericTable table = read_table(arguments.points, {.required = {"alpha"}, .optional = term_names()});
  const std::vector<NormalForm> forms = compute(table);
  if (arguments.dry_run) {
    print_plan("planar centres", {fmt::format("points: {}", forms.size()), "method: normal_form"});
    return ExitCode::done;
  }
  Provenance provenance = make_provenance(arguments.command);
  provenance.emplace_back("model", "y1' = alpha y2 + f1, y2' = -alpha y1 + f2");
  provenance.emplace_back("method", "normal_form");
  RowWriter writer(row_path(arguments), arguments.json, columns_of(table), provenance);
  bool converged = true;
  for (std::size_t i = 0; i < forms.size(); ++i) {
    std::vector<Cell> row(table.rows[i].begin(), table.rows[i].end());
    row.insert(row.end(), {forms[i].delta, forms[i].beta});
    writer.write(row);
    converged = converged && std::isfinite(forms[i].delta) && std::isfinite(forms[i].beta);
  }
  writer.commit();
  return converged ? ExitCode::done : ExitCode::unresolved;
}

}  // namespace strutt::app
