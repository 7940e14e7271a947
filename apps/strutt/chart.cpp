#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "chart_json.hpp"
#include "commands.hpp"
#include "scene_arguments.hpp"
#include "signals.hpp"
#include "strutt/base/error.hpp"
#include "strutt/chart/forecast.hpp"
#include "strutt/io/figure.hpp"
#include "terminal.hpp"

namespace strutt::app {
namespace {

std::vector<Layer> layers_of(const std::string& text) {
  std::vector<Layer> layers;
  for (const auto& name : split(text, ',')) {
    try {
      layers.push_back(layer_from_string(name));
    } catch (const InvalidInput& error) {
      throw UsageError(std::string("--layers: ") + error.what());
    }
  }
  return layers;
}

Axis chosen_axis(const std::string& name, const std::optional<std::string>& flag,
                 const std::optional<Axis>& file, const Scene& scene) {
  if (flag) return axis_of("--" + name, *flag, scene);
  if (file) return *file;
  throw UsageError("the " + name + " axis is missing: give --" + name + " P=FROM:TO:N, or " + name +
                   " in the table [chart] of the scene");
}

ChartRequest request_of(const ChartArguments& arguments, const SceneFile& scene) {
  ChartRequest request;
  request.tolerance = tolerance_of(arguments, scene.chart.tolerance.value_or(request.tolerance));
  request.method =
      method_of(arguments, "chart",
                {Method::surrogate, Method::propagator, Method::cvode, Method::arkode, Method::exact});
  request.threads = threads_of(arguments);
  request.x = chosen_axis("x", arguments.x, scene.chart.x, scene.scene);
  request.y = chosen_axis("y", arguments.y, scene.chart.y, scene.scene);
  if (arguments.layers)
    request.layers = layers_of(*arguments.layers);
  else if (scene.chart.layers)
    request.layers = *scene.chart.layers;
  request.force = arguments.force;
  request.cancel = &cancel_flag();
  return request;
}

/// The plan; what is wrong with a chart that stands in the scene file alone is the fault of the file.
ChartPlan plan_of(const ChartArguments& arguments, const SceneFile& scene, const ChartRequest& request) {
  const bool flags =
      arguments.x || arguments.y || arguments.layers || arguments.method || !arguments.set.empty();
  try {
    return plan_chart(scene.scene, request);
  } catch (const InvalidInput& error) {
    if (flags) throw;
    throw FileError(scene.file, 0, 0, std::string("[chart]: ") + error.what());
  }
}

/// The request with the layers that only the figure needs behind the others.
ChartRequest with_figure_layers(ChartRequest request) {
  for (const Layer layer : ChartFigure::layers()) {
    if (std::find(request.layers.begin(), request.layers.end(), layer) == request.layers.end()) {
      request.layers.push_back(layer);
    }
  }
  return request;
}

/// The effective scene: what the flags said stands in its [chart].
SceneFile effective(SceneFile scene, const ChartRequest& request) {
  scene.chart = {.x = request.x, .y = request.y, .layers = request.layers, .tolerance = request.tolerance};
  return scene;
}

std::string boxes(std::size_t count) { return fmt::format("{} {}", count, count == 1 ? "box" : "boxes"); }

/// Boxes of a surrogate and what building them took.
std::string surrogate_line(const SurrogateReport& report) {
  std::string line = fmt::format("{}, degrees up to {}, {} nodes, checked at {} points", boxes(report.boxes),
                                 report.highest_degree, report.nodes, report.checks);
  if (report.boxes_left_out > 0) line += ", " + boxes(report.boxes_left_out) + " left to point by point";
  if (report.failed_checks > 0) line += ", " + boxes(report.failed_checks) + " given up by the check";
  return line;
}

/// What was done, for the file.
Provenance done(const ChartSummary& summary) {
  std::string methods;
  for (std::size_t m = 0; m < summary.methods.size(); ++m) {
    if (summary.methods[m] == 0 || static_cast<Method>(m) == Method::automatic) continue;  // failed cells
    methods += (methods.empty() ? "" : ", ") + std::string(to_string(static_cast<Method>(m))) + " " +
               std::to_string(summary.methods[m]);
  }
  Provenance result{{"cells by method", methods}, {"largest error", to_text(summary.largest_error)}};
  if (summary.surrogate) result.emplace_back("surrogate", surrogate_line(*summary.surrogate));
  return result;
}

/// What the plan expects of the surrogate, or why there is none; nothing where another method was asked for.
std::vector<std::string> surrogate_lines(const ChartPlan& plan) {
  if (!plan.refusal.empty()) return {"surrogate: not used, " + plan.refusal};
  if (!plan.surrogate) return {};
  const auto& s = *plan.surrogate;
  return {fmt::format("surrogate: about {}, degrees up to {}, {:.0f} nodes, {:.3g} % of the cells",
                      boxes(s.boxes), s.highest_degree, s.nodes,
                      100.0 * s.cells / static_cast<double>(plan.cells))};
}

std::vector<std::string> plan_lines(const ChartRequest& request, const ChartPlan& plan) {
  std::vector<std::string> lines{
      fmt::format("cells: {} ({} x {})", plan.cells, request.x.points, request.y.points),
      fmt::format("memory: {:.3g} MB at work, {:.3g} MB of results, budget {:.3g} MB",
                  plan.working_bytes / 1e6, plan.result_bytes / 1e6, plan.budget_bytes / 1e6),
      fmt::format("expected time: {:.2g} s", plan.expected_seconds),
      "method: " + std::string(to_string(plan.method)), "point by point: " + point_line(plan.point)};
  for (auto& line : surrogate_lines(plan)) lines.push_back(std::move(line));
  lines.push_back("tolerance: " + to_text(request.tolerance));
  lines.push_back(fmt::format("threads: {}", plan.threads));
  return lines;
}

std::unique_ptr<ChartWriter> writer_for(const ChartArguments& arguments,
                                        const ChartDescription& description) {
  if (!arguments.json) return make_chart_writer(data_path(arguments), description);
  return std::make_unique<JsonChartWriter>(json_path(arguments), description);
}

constexpr int kMostOverlaidTongues = 100;
constexpr double kOverlaySeconds = 20.0;   // of one thread, at most, as expected by counts
constexpr double kLeastEvaluation = 1e-4;  // seconds
constexpr double kOverlayResolution = 1e-5;
constexpr double kOverlayChord = 2e-3;
constexpr double kOverlaidSystemPoint = 2e-4;  // expected seconds; curves of a system take 1e4 to 1e5 points

int most_tongues(const Scene& scene, const TongueLine& x, const TongueLine& y) {
  Scene end = scene;
  int count = 0;
  for (const double value : {y.from, y.to}) {
    parameter(end, y.parameter) = value;
    count = std::max(count, tongue_count(end, x));
  }
  return count;
}

/// How many evaluations curves may take: counts, so that no clock decides what is drawn.
std::int64_t most_evaluations(const Scene& scene, const ChartRequest& request) {
  const StabilityParts margin_alone{.verdict = false, .winding = false, .matrix = false};
  const auto margin = forecast_points(scene, request.x, request.y, {.tolerance = 1e-13}, margin_alone);
  return static_cast<std::int64_t>(kOverlaySeconds / std::max(margin.seconds, kLeastEvaluation));
}

/// The edges of tongues in the window of a chart; none, with a note, where they cannot be had at little cost.
std::vector<TongueCurve> overlaid_tongues(const Scene& scene, const ChartRequest& request,
                                          const ChartPlan& plan, bool quiet) {
  const auto without = [&](const std::string& reason) {
    if (!quiet) print_note("no tongue edges in the figure: " + reason);
    return std::vector<TongueCurve>{};
  };
  const auto line = [](const Axis& axis) {
    return TongueLine{axis.parameter, std::min(axis.from, axis.to), std::max(axis.from, axis.to)};
  };
  const TongueLine x = line(request.x), y = line(request.y);
  if (!(x.from < x.to) || !(y.from < y.to)) return {};
  try {
    const bool indexed = has_tongue_index(scene, x);
    const int count = indexed ? most_tongues(scene, x, y) : 0;
    if (count > kMostOverlaidTongues)
      return without(fmt::format("up to {} tongues, more than {}", count, kMostOverlaidTongues));
    if (!indexed && plan.point.seconds > kOverlaidSystemPoint)
      return without("they would take long for this system");
    return tongue_curves(scene, x, y,
                         {.tolerance = 1e-9,
                          .chord = kOverlayChord,
                          .log_along = request.x.scale == AxisScale::logarithmic,
                          .log_over = request.y.scale == AxisScale::logarithmic,
                          .count = count,
                          .resolution = kOverlayResolution,
                          .max_evaluations = most_evaluations(scene, request),
                          .threads = request.threads,
                          .cancel = &cancel_flag()});
  } catch (const InvalidInput& error) {
    return without(error.what());
  } catch (const NumericalFailure& error) {
    return without(std::string("they would take long, ") + error.what());
  }
}

/// Hands the strips to the data file (the layers asked for) and to the figure (all of them).
class Sinks {
 public:
  Sinks(const ChartArguments& arguments, const Scene& scene, const ChartDescription& description,
        const ChartRequest& computed, const ChartPlan& plan)
      : layers_(description.request.layers.size()), writer_(writer_for(arguments, description)) {
    if (!arguments.figure) return;
    ChartDescription all = description;
    all.request = computed;
    figure_.emplace(*arguments.figure, all);
    figure_->set_tongues(overlaid_tongues(scene, computed, plan, arguments.quiet));
  }

  void add(const ChartStrip& strip) {
    if (figure_) figure_->add(strip);
    if (strip.values.size() == layers_) return writer_->write(strip);
    asked_.first_row = strip.first_row;
    asked_.rows = strip.rows;
    asked_.columns = strip.columns;
    asked_.values.assign(strip.values.begin(), strip.values.begin() + static_cast<std::ptrdiff_t>(layers_));
    writer_->write(asked_);
  }

  void conclude(const Provenance& done) { writer_->conclude(done); }

  /// Data and figure appear together: drawing can fail or be interrupted, and so can writing the last bytes.
  void commit() {
    writer_->prepare();
    throw_if_interrupted();
    if (figure_) figure_->commit();
    writer_->commit();
  }

 private:
  std::size_t layers_;
  std::unique_ptr<ChartWriter> writer_;
  std::optional<ChartFigure> figure_;
  ChartStrip asked_;
};

struct Counts {
  std::size_t unresolved;
  std::size_t not_converged;
};

Counts count(const ChartRequest& asked, const ChartSummary& summary) {
  const bool verdict =
      std::find(asked.layers.begin(), asked.layers.end(), Layer::verdict) != asked.layers.end();
  return {verdict ? summary.unresolved : 0,
          summary.cells - summary.outcomes[static_cast<std::size_t>(Outcome::converged)]};
}

void summarise(const ChartArguments& arguments, const ChartSummary& summary, const Counts& counts,
               double seconds) {
  if (arguments.quiet) return;
  std::string places = data_path(arguments) == "-" ? "standard output" : data_path(arguments).string();
  if (arguments.figure) places += " and " + *arguments.figure;
  print_note(fmt::format("wrote {}: {} cells in {:.3g} s, {} unresolved, {} not converged", places,
                         summary.cells, seconds, counts.unresolved, counts.not_converged));
  if (!summary.surrogate) return;
  print_note(fmt::format("surrogate: {}; {} cells point by point, largest error bound {:.2g}",
                         surrogate_line(*summary.surrogate), summary.cells - summary.interpolated,
                         summary.largest_error));
}

}  // namespace

ExitCode run(const ChartArguments& arguments) {
  const SceneFile scene = load_scene(arguments);
  const ChartRequest request = request_of(arguments, scene);
  require_two_files(arguments.output, arguments.figure);
  const ChartRequest computed = arguments.figure ? with_figure_layers(request) : request;
  const ChartPlan plan = plan_of(arguments, scene, computed);
  if (arguments.dry_run) {
    print_plan(effective(scene, request), plan_lines(request, plan));
    return ExitCode::done;
  }
  warn_about(arguments, scene.scene);
  if (request.method == Method::surrogate && !plan.refusal.empty() && !arguments.quiet) {
    print_warning("no surrogate: " + plan.refusal + "; computing point by point (" +
                  std::string(to_string(plan.method)) + ")");
  }

  install_signal_handlers();
  const ChartDescription description{
      .x = parameter_info(scene.scene, request.x.parameter),
      .y = parameter_info(scene.scene, request.y.parameter),
      .request = request,
      .provenance = provenance_of(arguments, effective(scene, request), plan.method, request.tolerance)};
  Sinks sinks(arguments, scene.scene, description, computed, plan);
  Progress progress(!arguments.quiet, "cells");
  const ChartSummary summary = compute_chart(
      scene.scene, computed, [&](const ChartStrip& strip) { sinks.add(strip); },
      [&](std::size_t done, std::size_t total) { progress.update(done, total); });
  progress.clear();
  throw_if_interrupted();
  sinks.conclude(done(summary));
  sinks.commit();
  const Counts counts = count(request, summary);
  summarise(arguments, summary, counts, progress.seconds());
  return counts.unresolved + counts.not_converged == 0 ? ExitCode::done : ExitCode::unresolved;
}

}  // namespace strutt::app
