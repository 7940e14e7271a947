#include "strutt/free_pendulum/period.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "commands.hpp"
#include "rows.hpp"
#include "scene_arguments.hpp"
#include "signals.hpp"
#include "strutt/base/error.hpp"
#include "strutt/free_pendulum/period_formulas.hpp"
#include "terminal.hpp"

namespace strutt::app {
namespace {

/// What an orbit is told by: the column, the flag, and the library's function.
struct Input {
  const char* column;
  const char* flag;
  const char* unit;
  std::optional<std::string> PeriodArguments::*argument;
  Period (*period)(double, const Eigenfrequency&);
  Period (CheapestPeriod::*cheapest)(double, const Eigenfrequency&) const;
  FormulaError (*formula)(PeriodMethod, double);
};
const std::array<Input, 3> kInputs{
    {{"amplitude", "--amplitude", "rad", &PeriodArguments::amplitude, period_of_amplitude,
      &CheapestPeriod::of_amplitude, formula_of_amplitude},
     {"from_top", "--from-top", "rad", &PeriodArguments::from_top, period_of_from_top,
      &CheapestPeriod::of_from_top, formula_of_from_top},
     {"separatrix_excess", "--separatrix-excess", "", &PeriodArguments::separatrix_excess, period_of_excess,
      &CheapestPeriod::of_excess, formula_of_excess}}};

/// The orbits asked for: the columns as they were read, and where the two that matter stand.
struct Orbits {
  const Input* input = nullptr;
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
  std::size_t orbit_column = 0;
  std::optional<std::size_t> alpha_column;

  Eigenfrequency alpha(const std::vector<double>& row, const Eigenfrequency& otherwise) const {
    return alpha_column ? Eigenfrequency{row[*alpha_column], 0.0} : otherwise;
  }
  Period period(const std::vector<double>& row, const Eigenfrequency& alpha) const {
    return input->period(row[orbit_column], alpha);
  }
};

/// What is to be told about an orbit.
struct Wanted {
  double tolerance = 1e-15;
  std::optional<CheapestPeriod> cheapest;  // none: the closed form whatever the tolerance
  bool compare = false;
};

/// The formulas that `--compare` shows.
constexpr std::array kCompared{PeriodMethod::normal_form, PeriodMethod::krylov, PeriodMethod::krylov_squared};

Orbits orbit_of_flag(const Input& input, const std::string& text, const Eigenfrequency& alpha) {
  Orbits orbits;
  orbits.input = &input;
  orbits.columns = {input.column};
  orbits.rows = {{quantity_of(input.flag, text, input.unit)}};
  try {
    orbits.period(orbits.rows[0], alpha);
  } catch (const InvalidInput& error) {
    throw UsageError(std::string(input.flag) + ": " + error.what());
  }
  return orbits;
}

/// The kind of orbit that the columns of a file tell.
const Input& input_of(const NumericTable& table) {
  const Input* found = nullptr;
  for (const Input& input : kInputs) {
    if (std::find(table.columns.begin(), table.columns.end(), input.column) == table.columns.end()) continue;
    if (found != nullptr) {
      throw FileError(
          table.file, 0, 0,
          std::string("the columns ") + found->column + " and " + input.column + " exclude each other");
    }
    found = &input;
  }
  if (found == nullptr)
    throw FileError(table.file, 0, 0, "wanted is a column amplitude, from_top or separatrix_excess");
  return *found;
}

/// Checks every row before anything is written.
Orbits orbits_of_file(const std::string& path, const Eigenfrequency& alpha) {
  NumericTable table =
      read_table(path, {.required = {},
                        .optional = {"amplitude", "from_top", "separatrix_excess", "alpha"},
                        .units = {{"amplitude", "rad"}, {"from_top", "rad"}, {"alpha", "rad/s"}}});
  Orbits orbits;
  orbits.input = &input_of(table);
  orbits.orbit_column = table.column(orbits.input->column);
  if (std::find(table.columns.begin(), table.columns.end(), "alpha") != table.columns.end())
    orbits.alpha_column = table.column("alpha");
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    try {
      orbits.period(table.rows[i], orbits.alpha(table.rows[i], alpha));
    } catch (const InvalidInput& error) {
      const bool is_alpha = orbits.alpha_column && std::string_view(error.what()).starts_with("alpha");
      throw table.error_at(i, is_alpha ? *orbits.alpha_column : orbits.orbit_column, error.what());
    }
  }
  orbits.columns = std::move(table.columns);
  orbits.rows = std::move(table.rows);
  return orbits;
}

Orbits orbits_of(const PeriodArguments& arguments, const Eigenfrequency& alpha) {
  if (arguments.points) return orbits_of_file(*arguments.points, alpha);
  for (const Input& input : kInputs) {
    if (const auto& text = arguments.*input.argument) return orbit_of_flag(input, *text, alpha);
  }
  throw std::logic_error("the flags were not checked");
}

void check_flags(const PeriodArguments& arguments) {
  int given = arguments.points ? 1 : 0;
  for (const Input& input : kInputs) given += arguments.*input.argument ? 1 : 0;
  if (given != 1)
    throw UsageError("wanted is exactly one of --amplitude, --from-top, --separatrix-excess, --points");
  if (arguments.points == "-" && arguments.scene == "-")
    throw UsageError("scene and points cannot both be standard input");
  if (arguments.scene.empty() && !arguments.set.empty()) throw UsageError("--set goes with --scene only");
}

/// The scene, if there is one: a pendulum on which nothing but gravity acts.
std::optional<SceneFile> free_scene(const PeriodArguments& arguments) {
  if (arguments.scene.empty()) return std::nullopt;
  SceneFile file = load_scene(arguments);
  const Scene& scene = file.scene;
  const auto refuse = [&](const std::string& what) {
    throw FileError(file.file, 0, 0, "period needs a free pendulum: " + what);
  };
  if (!scene.pendulum) refuse("the scene has no [pendulum]");
  if (scene.support) refuse("the scene has a [support]");
  if (scene.moment) refuse("the scene has a [moment]");
  if (scene.pendulum->damping != 0.0) refuse("pendulum.damping = " + to_text(scene.pendulum->damping));
  return file;
}

Provenance provenance_of(const PeriodArguments& arguments, const std::optional<SceneFile>& scene,
                         Method method, double tolerance) {
  if (scene) return app::provenance_of(arguments, *scene, method, tolerance);
  Provenance provenance = make_provenance(arguments.command);
  provenance.emplace_back("model", "free pendulum");
  provenance.emplace_back("method", to_string(method));
  provenance.emplace_back("tolerance", to_text(tolerance));
  return provenance;
}

std::vector<Column> columns_of(const Orbits& orbits, bool compare) {
  std::vector<Column> columns;
  for (const auto& name : orbits.columns)
    columns.push_back({name, name == "alpha" ? "rad/s" : name == "separatrix_excess" ? "1" : "rad"});
  columns.insert(columns.end(),
                 {{"period", "s"}, {"ratio", "1"}, {"error", "1"}, {"method", ""}, {"outcome", ""}});
  if (!compare) return columns;
  for (const auto formula : kCompared) {
    const std::string name(to_string(formula));
    columns.insert(columns.end(), {{name, "1"}, {name + "_error", "1"}});
  }
  return columns;
}

Outcome outcome_of(const Period& result, double tolerance) {
  if (std::isinf(result.period) && result.method != PeriodMethod::separatrix) return Outcome::non_finite;
  return result.error <= tolerance ? Outcome::converged : Outcome::tolerance_not_reached;
}

/// Ratio and error of every formula; empty where it has no meaning.
void append_comparison(std::vector<Cell>& cells, const Input& input, double orbit) {
  for (const auto method : kCompared) {
    const FormulaError formula = input.formula(method, orbit);
    if (std::isnan(formula.ratio)) {
      cells.insert(cells.end(), {Cell{}, Cell{}});
    } else {
      cells.insert(cells.end(), {formula.ratio, formula.relative_error});
    }
  }
}

ExitCode write_rows(RowWriter& writer, const Orbits& orbits, const Eigenfrequency& scene_alpha,
                    const Wanted& wanted) {
  ExitCode code = ExitCode::done;
  std::vector<Cell> cells;
  for (const auto& row : orbits.rows) {
    throw_if_interrupted();
    const Eigenfrequency alpha = orbits.alpha(row, scene_alpha);
    const double orbit = row[orbits.orbit_column];
    const Period result = wanted.cheapest ? (*wanted.cheapest.*orbits.input->cheapest)(orbit, alpha)
                                          : orbits.period(row, alpha);
    const Outcome outcome = outcome_of(result, wanted.tolerance);
    if (outcome != Outcome::converged) code = ExitCode::unresolved;
    cells.assign(row.begin(), row.end());
    cells.insert(cells.end(), {result.period, result.ratio, result.error,
                               std::string(to_string(result.method)), std::string(to_string(outcome))});
    if (wanted.compare) append_comparison(cells, *orbits.input, orbit);
    writer.write(cells);
  }
  writer.commit();
  return code;
}

void print_plan(const std::optional<SceneFile>& scene, const Orbits& orbits, const Wanted& wanted) {
  const std::vector<std::string> lines{
      fmt::format("points: {}", orbits.rows.size()),
      std::string("method: ") +
          (wanted.cheapest ? "the cheapest formula that is good enough, else exact" : "exact"),
      "tolerance: " + to_text(wanted.tolerance), "threads: 1"};
  if (scene) return app::print_plan(*scene, lines);
  app::print_plan("free pendulum", lines);
}

}  // namespace

ExitCode run(const PeriodArguments& arguments) {
  check_flags(arguments);
  Wanted wanted;
  wanted.tolerance = tolerance_of(arguments, 1e-15, {.least = 5e-16, .most = 1e-1});
  wanted.compare = arguments.compare;
  const Method method = method_of(arguments, "period", {Method::exact});
  if (method == Method::automatic) wanted.cheapest.emplace(wanted.tolerance);
  threads_of(arguments);  // a period costs less than handing it to a thread
  const auto scene = free_scene(arguments);
  const Eigenfrequency alpha = scene ? eigenfrequency(*scene->scene.pendulum) : Eigenfrequency{};
  const Orbits orbits = orbits_of(arguments, alpha);
  if (arguments.dry_run) {
    print_plan(scene, orbits, wanted);
    return ExitCode::done;
  }
  install_signal_handlers();
  RowWriter writer(row_path(arguments), arguments.json, columns_of(orbits, wanted.compare),
                   provenance_of(arguments, scene, method, wanted.tolerance));
  return write_rows(writer, orbits, alpha, wanted);
}

}  // namespace strutt::app
