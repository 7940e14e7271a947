#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "commands.hpp"
#include "inverse_questions.hpp"
#include "rows.hpp"
#include "scene_arguments.hpp"
#include "signals.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/parallel.hpp"
#include "strutt/chart/stability_margin.hpp"
#include "terminal.hpp"

namespace strutt::app {
namespace {

/// What is known of a row without an edge within reach: only that.
template <typename Row>
bool has_edge(const Row& row) {
  return std::isfinite(row.distance);
}

std::vector<Cell> cells_of(const ParameterMargin& row) {
  const bool edge = has_edge(row);
  return {row.parameter,
          row.value,
          number(row.lower_edge),
          number(row.upper_edge),
          number(row.distance),
          number(row.relative_distance),
          number(row.tongue),
          edge ? Cell(row.error) : Cell(),
          edge ? word(row.method) : Cell()};
}

std::vector<Cell> cells_of(const JointMargin& joint) {
  const bool edge = has_edge(joint);
  return {std::string("joint"),
          {},
          {},
          {},
          number(joint.distance),
          number(joint.distance),
          number(joint.tongue),
          edge ? Cell(joint.error) : Cell(),
          edge ? word(joint.method) : Cell()};
}

std::vector<Column> columns() {
  // the unit of a number is that of its row's parameter
  return {{"parameter", ""},  {"value", ""},    {"lower_edge", ""},
          {"upper_edge", ""}, {"distance", ""}, {"relative_distance", "1"},
          {"tongue", "1"},    {"error", "1"},   {"method", ""}};
}

bool converged(const StabilityMargin& margin) {
  return margin.joint.outcome == Outcome::converged &&
         std::ranges::all_of(margin.parameters,
                             [](const auto& row) { return row.outcome == Outcome::converged; });
}

}  // namespace

ExitCode run(const MarginArguments& arguments) {
  method_of(arguments, "margin", {});
  require_one_question(arguments);
  if (arguments.bands) return run_bands(arguments);
  if (arguments.closing_damping) return run_closing_damping(arguments);
  if (arguments.box) return run_box(arguments);
  if (arguments.sensitivities) return run_sensitivities(arguments);
  const SceneFile scene = load_scene(arguments);
  MarginOptions options{.threads = threads_of(arguments), .cancel = &cancel_flag()};
  options.tolerance = tolerance_of(arguments, scene.chart.tolerance.value_or(options.tolerance));
  const auto parameters = parameters_of(arguments, scene.scene);
  if (arguments.dry_run) {
    print_plan(scene, {fmt::format("parameters: {}", fmt::join(parameters, ", ")), "method: auto",
                       "tolerance: " + to_text(options.tolerance),
                       fmt::format("threads: {}", thread_count({.threads = options.threads}))});
    return ExitCode::done;
  }
  warn_about(arguments, scene.scene);
  install_signal_handlers();
  const StabilityMargin margin = stability_margin(scene.scene, parameters, options);
  throw_if_interrupted();
  RowWriter writer(row_path(arguments), arguments.json, columns(),
                   provenance_of(arguments, scene, Method::automatic, options.tolerance));
  for (const ParameterMargin& row : margin.parameters) writer.write(cells_of(row));
  writer.write(cells_of(margin.joint));
  writer.commit();
  return converged(margin) ? ExitCode::done : ExitCode::unresolved;
}

}  // namespace strutt::app
