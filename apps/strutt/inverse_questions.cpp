#include "inverse_questions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rows.hpp"
#include "scene_arguments.hpp"
#include "signals.hpp"
#include "strutt/base/error.hpp"
#include "strutt/chart/closing_damping.hpp"
#include "strutt/chart/stability_bands.hpp"
#include "strutt/chart/stability_margin.hpp"
#include "strutt/chart/worst_growth.hpp"
#include "strutt/floquet/sensitivity.hpp"
#include "strutt/floquet/stability.hpp"
#include "terminal.hpp"

namespace strutt::app {
namespace {

constexpr double kBoxTolerance = 1e-3;

/// Calls `answer`, whose complaints are about the flag.
template <typename Answer>
auto about(const std::string& flag, const Answer& answer) {
  try {
    return answer();
  } catch (const InvalidInput& error) {
    throw UsageError(flag + ": " + error.what());
  }
}

void plan(const SceneFile& scene, const std::string& question, double tolerance) {
  print_plan(scene, {question, "method: auto", "tolerance: " + to_text(tolerance)});
}

template <typename Rows>
ExitCode exit_code(const Rows& rows) {
  const bool good =
      std::ranges::all_of(rows, [](const auto& row) { return row.outcome == Outcome::converged; });
  return good ? ExitCode::done : ExitCode::unresolved;
}

RowWriter writer_of(const MarginArguments& arguments, const SceneFile& scene, double tolerance,
                    std::vector<Column> columns) {
  return RowWriter(row_path(arguments), arguments.json, std::move(columns),
                   provenance_of(arguments, scene, Method::automatic, tolerance));
}

/// The scene moved to the nearest edge along a parameter; the edge in `position`.
Scene on_edge(const Scene& scene, const std::string& path, double& position) {
  const auto row = about("--edge", [&] { return stability_margin(scene, {path}).parameters.front(); });
  const bool lower =
      row.lower_edge && (!row.upper_edge || row.value - *row.lower_edge <= *row.upper_edge - row.value);
  if (!lower && !row.upper_edge)
    throw UsageError("--edge: there is no edge along '" + path + "' within reach");
  position = lower ? *row.lower_edge : *row.upper_edge;
  Scene result = scene;
  parameter(result, path) = position;
  return result;
}

}  // namespace

void require_one_question(const MarginArguments& arguments) {
  const int asked = arguments.bands.has_value() + arguments.closing_damping.has_value() +
                    arguments.box.has_value() + (arguments.sensitivities ? 1 : 0);
  if (asked > 1)
    throw UsageError(
        "--bands, --closing-damping, --box and --sensitivities are questions of their own: one at a time");
  if (arguments.count && !arguments.closing_damping) throw UsageError("--count goes with --closing-damping");
  if (arguments.edge && !arguments.sensitivities) throw UsageError("--edge goes with --sensitivities");
  if (arguments.parameters && asked == 1 && !arguments.sensitivities)
    throw UsageError("--parameters goes with the distances and with --sensitivities");
}

std::vector<std::string> parameters_of(const MarginArguments& arguments, const Scene& scene) {
  if (!arguments.parameters) return stability_parameters(scene);
  const auto names = split(*arguments.parameters, ',');
  for (auto name = names.begin(); name != names.end(); ++name) {
    about("--parameters", [&] { return parameter_info(scene, *name); });
    if (std::find(names.begin(), name, *name) != name)
      throw UsageError("--parameters: '" + *name + "' is given twice");
  }
  return names;
}

ExitCode run_bands(const MarginArguments& arguments) {
  const SceneFile scene = load_scene(arguments);
  BandOptions options{.cancel = &cancel_flag()};
  options.tolerance = tolerance_of(arguments, scene.chart.tolerance.value_or(options.tolerance));
  const TongueLine line = line_of("--bands", *arguments.bands, scene.scene);
  if (arguments.dry_run) {
    plan(scene, "bands: " + text_of(line), options.tolerance);
    return ExitCode::done;
  }
  warn_about(arguments, scene.scene);
  install_signal_handlers();
  const auto bands = about("--bands", [&] { return stability_bands(scene.scene, line, options); });
  throw_if_interrupted();
  const std::string unit = column_unit(scene.scene, line.parameter);
  auto writer = writer_of(arguments, scene, options.tolerance,
                          {{"parameter", ""},
                           {"from", unit},
                           {"to", unit},
                           {"verdict", ""},
                           {"tongue", "1"},
                           {"from_error", "1"},
                           {"to_error", "1"},
                           {"method", ""},
                           {"outcome", ""}});
  for (const StabilityBand& band : bands)
    writer.write(std::vector<Cell>{line.parameter, band.from, band.to, std::string(to_string(band.verdict)),
                                   number(band.tongue), band.from_error, band.to_error, word(band.method),
                                   std::string(to_string(band.outcome))});
  writer.commit();
  return exit_code(bands);
}

ExitCode run_closing_damping(const MarginArguments& arguments) {
  const SceneFile scene = load_scene(arguments);
  TongueOptions options{.cancel = &cancel_flag()};
  options.tolerance = tolerance_of(arguments, scene.chart.tolerance.value_or(options.tolerance));
  if (arguments.count)
    options.count = static_cast<int>(count_of("--count", *arguments.count, 2, kLargestTongue + 1));
  const TongueLine line = line_of("--closing-damping", *arguments.closing_damping, scene.scene);
  if (arguments.dry_run) {
    plan(scene, "closing damping: " + text_of(line), options.tolerance);
    return ExitCode::done;
  }
  install_signal_handlers();
  const auto rows = about("--closing-damping", [&] { return closing_damping(scene.scene, line, options); });
  throw_if_interrupted();
  auto writer = writer_of(arguments, scene, options.tolerance,
                          {{"tongue", "1"},
                           {"crossing", "1"},
                           {"damping", scene.scene.pendulum ? "1/s" : "1"},
                           {"error", "1"},
                           {"position", column_unit(scene.scene, line.parameter)},
                           {"method", ""},
                           {"outcome", ""}});
  for (const ClosingDamping& row : rows)
    writer.write(std::vector<Cell>{static_cast<double>(row.tongue), static_cast<double>(row.crossing),
                                   row.damping, row.error, row.position, word(row.method),
                                   std::string(to_string(row.outcome))});
  writer.commit();
  return exit_code(rows);
}

ExitCode run_box(const MarginArguments& arguments) {
  const SceneFile scene = load_scene(arguments);
  WorstGrowthOptions options{.tolerance = tolerance_of(arguments, kBoxTolerance), .cancel = &cancel_flag()};
  std::vector<ParameterRange> box;
  for (const std::string& text : split(*arguments.box, ',')) {
    const TongueLine range = line_of("--box", text, scene.scene);
    box.push_back({range.parameter, range.from, range.to});
  }
  if (arguments.dry_run) {
    plan(scene, fmt::format("box: {} parameters, at most {} evaluations", box.size(), options.evaluations),
         options.tolerance);
    return ExitCode::done;
  }
  warn_about(arguments, scene.scene);
  install_signal_handlers();
  const WorstGrowth worst = about("--box", [&] { return worst_growth(scene.scene, box, options); });
  throw_if_interrupted();
  std::vector<Column> columns{{"growth", "1"}, {"error", "1"}, {"error_kind", ""}};
  std::vector<Cell> row{worst.growth, worst.error, std::string(worst.proved ? "bound" : "estimate")};
  for (std::size_t i = 0; i < box.size(); ++i) {
    columns.push_back({box[i].parameter, column_unit(scene.scene, box[i].parameter)});
    row.emplace_back(worst.at[i]);
  }
  columns.insert(columns.end(), {{"evaluations", "1"}, {"method", ""}, {"outcome", ""}});
  row.insert(row.end(), {static_cast<double>(worst.evaluations), word(worst.method),
                         std::string(to_string(worst.outcome))});
  auto writer = writer_of(arguments, scene, options.tolerance, columns);
  writer.write(row);
  writer.commit();
  return exit_code(std::vector{worst});
}

ExitCode run_sensitivities(const MarginArguments& arguments) {
  const SceneFile scene = load_scene(arguments);
  MonodromyOptions options{.tolerance = tolerance_of(arguments, 1e-12), .cancel = &cancel_flag()};
  const auto parameters = parameters_of(arguments, scene.scene);
  if (arguments.edge) about("--edge", [&] { return parameter_info(scene.scene, *arguments.edge); });
  if (arguments.dry_run) {
    plan(scene, fmt::format("sensitivities: {}", fmt::join(parameters, ", ")), options.tolerance);
    return ExitCode::done;
  }
  warn_about(arguments, scene.scene);
  install_signal_handlers();
  double position = 0.0;
  const Scene edge = arguments.edge ? on_edge(scene.scene, *arguments.edge, position) : scene.scene;
  // the unit of a derivative is that of its column over that of its row's parameter
  std::vector<Column> columns{{"parameter", ""}, {"value", ""}};
  for (const char* name : {"growth", "growth_per_time", "winding", "margin"})
    columns.insert(columns.end(), {{std::string(name) + "_slope", ""}, {std::string(name) + "_error", ""}});
  if (arguments.edge) columns.insert(columns.end(), {{"edge", ""}, {"edge_slope", ""}, {"edge_error", ""}});
  columns.push_back({"outcome", ""});
  auto writer = writer_of(arguments, scene, options.tolerance, columns);
  MonodromyEngine engine;
  std::vector<Sensitivity> all;
  for (const std::string& path : parameters) {
    const Sensitivity s = all.emplace_back(sensitivity(engine, scene.scene, path, options));
    std::vector<Cell> row{path, parameter(scene.scene, path)};
    const auto add = [&](const Derivative& d) {
      row.insert(row.end(), {number(d.value), std::isnan(d.value) ? Cell() : Cell(d.error)});
    };
    for (const Derivative& d : {s.growth, s.growth_per_time, s.winding, s.margin}) add(d);
    if (arguments.edge) {
      row.emplace_back(position);
      add(edge_shift(engine, edge, *arguments.edge, path, options));
    }
    row.emplace_back(std::string(to_string(s.outcome)));
    throw_if_interrupted();
    writer.write(row);
  }
  writer.commit();
  return exit_code(all);
}

}  // namespace strutt::app
