#include "strutt/chart/tradeoff.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "commands.hpp"
#include "rows.hpp"
#include "scene_arguments.hpp"
#include "signals.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/instruction_set.hpp"
#include "strutt/floquet/stability.hpp"
#include "strutt/io/tradeoff_figure.hpp"
#include "terminal.hpp"

namespace strutt::app {
namespace {

constexpr std::size_t kSamples = 64;
constexpr std::size_t kMostSamples = 100'000;

/// A sample of the box of [chart]; the scene as it stands where there is none or none is asked for.
TradeoffPoints points_of(const TradeoffArguments& arguments, const SceneFile& scene) {
  const bool box = scene.chart.x && scene.chart.y;
  if (!arguments.samples)
    return box ? scattered_points(*scene.chart.x, *scene.chart.y, kSamples) : scene_point();
  const auto count = count_of("--samples", *arguments.samples, 0, kMostSamples);
  if (count == 0) return scene_point();
  if (!box) throw UsageError("--samples: the scene has no [chart] with x and y to take them from");
  return scattered_points(*scene.chart.x, *scene.chart.y, count);
}

TradeoffRequest request_of(const TradeoffArguments& arguments, const SceneFile& scene) {
  TradeoffRequest request{
      .points = points_of(arguments, scene), .threads = threads_of(arguments), .cancel = &cancel_flag()};
  const Method method =
      method_of(arguments, "tradeoff",
                {Method::surrogate, Method::propagator, Method::cvode, Method::arkode, Method::exact});
  if (method != Method::automatic) request.methods = {method};
  if (arguments.tolerance) request.tolerances = {tolerance_of(arguments)};
  try {
    return completed(scene.scene, std::move(request));
  } catch (const InvalidInput& error) {
    throw UsageError("--method " + std::string(to_string(method)) + ": " + error.what());
  }
}

template <typename Values, typename Text>
std::string list_of(const Values& values, const Text& text) {
  std::string result;
  for (const auto& value : values) result += (result.empty() ? "" : " ") + std::string(text(value));
  return result;
}

std::string names_of(const std::vector<Method>& methods) {
  return list_of(methods, [](Method method) { return to_string(method); });
}

std::vector<std::string> plan_lines(const SceneFile& scene, const TradeoffRequest& request) {
  return {fmt::format("points: {}", request.points.rows.size()), "methods: " + names_of(request.methods),
          "tolerances: " + list_of(request.tolerances, [](double value) { return to_text(value); }),
          fmt::format("expected time: {:.2g} s", expected_seconds(scene.scene, request)),
          "threads: 1 while the time is taken"};
}

const std::vector<Column>& columns() {
  static const std::vector<Column> columns{{"method", ""},
                                           {"tolerance", "1"},
                                           {"used", ""},
                                           {"points", "1"},
                                           {"converged", "1"},
                                           {"exceeded", "1"},
                                           {"error", "1"},
                                           {"true_error", "1"},
                                           {"median_true_error", "1"},
                                           {"points_per_second", "1/s"},
                                           {"spread", "1"},
                                           {"steps", "1"},
                                           {"right_hand_sides", "1"},
                                           {"estimate_right_hand_sides", "1"},
                                           {"pareto", "1"}};
  return columns;
}

std::vector<Cell> cells_of(const TradeoffRow& row) {
  return {std::string(to_string(row.method)),
          row.tolerance,
          names_of(row.used),
          static_cast<double>(row.points),
          static_cast<double>(row.converged),
          static_cast<double>(row.exceeded),
          row.error,
          row.true_error,
          row.median_true_error,
          row.points_per_second,
          row.spread,
          row.steps,
          row.right_hand_sides,
          row.estimate_right_hand_sides,
          row.pareto ? 1.0 : 0.0};
}

Provenance provenance_of(const TradeoffArguments& arguments, const SceneFile& scene) {
  Provenance provenance = make_provenance(arguments.command);
  provenance.emplace_back("model", describe(scene.scene));
  provenance.emplace_back("instruction_set", to_string(instruction_set()));
  provenance.emplace_back("scene", to_toml(scene));
  return provenance;
}

/// What was measured: the number of points, or the parameters of the only one if they are few.
std::string title_of(const SceneFile& scene, const Tradeoff& tradeoff) {
  constexpr std::size_t kFew = 4;
  std::string title = describe(scene.scene);
  if (tradeoff.points > 1) return title + fmt::format(", {} points", tradeoff.points);
  const auto paths = parameter_paths(scene.scene);
  for (std::size_t i = 0; paths.size() <= kFew && i < paths.size(); ++i) {
    title += (i == 0 ? ": " : ", ") + paths[i] + " = " + to_text(parameter(scene.scene, paths[i]));
  }
  return title;
}

/// Points whose error is above its bound, all rows together; says so if there are any.
std::size_t warn_about_bounds(const Tradeoff& tradeoff) {
  std::size_t exceeded = 0;
  for (const auto& row : tradeoff.rows) exceeded += row.exceeded;
  if (exceeded > 0)
    print_warning(
        fmt::format("{} results are further from the truth than they say: a bug of Strutt", exceeded));
  return exceeded;
}

}  // namespace

ExitCode run(const TradeoffArguments& arguments) {
  const SceneFile scene = load_scene(arguments);
  const TradeoffRequest request = request_of(arguments, scene);
  require_two_files(arguments.output, arguments.figure);
  if (arguments.dry_run) {
    print_plan(scene, plan_lines(scene, request));
    return ExitCode::done;
  }
  warn_about(arguments, scene.scene);

  install_signal_handlers();
  std::optional<TradeoffFigure> figure;
  if (arguments.figure) figure.emplace(*arguments.figure);
  RowWriter writer(row_path(arguments), arguments.json, columns(), provenance_of(arguments, scene));
  Progress progress(!arguments.quiet, "measurements");
  const Tradeoff tradeoff = measure_tradeoff(
      scene.scene, request, [&](std::size_t done, std::size_t total) { progress.update(done, total); });
  progress.clear();
  throw_if_interrupted();
  for (const auto& row : tradeoff.rows) writer.write(cells_of(row));
  writer.prepare();
  if (figure) figure->draw(tradeoff, title_of(scene, tradeoff));
  writer.commit();
  return warn_about_bounds(tradeoff) == 0 ? ExitCode::done : ExitCode::unresolved;
}

}  // namespace strutt::app
