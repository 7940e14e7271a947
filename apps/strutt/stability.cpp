#include "strutt/floquet/stability.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "commands.hpp"
#include "rows.hpp"
#include "scene_arguments.hpp"
#include "signals.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/parallel.hpp"
#include "strutt/chart/forecast.hpp"
#include "terminal.hpp"

namespace strutt::app {
namespace {

// Beyond, the columns m11 ... mnn are left out.
constexpr int kMostMatrixStates = 9;
constexpr std::size_t kBlockRows = 256;    // per thread: computed before they are written
constexpr std::size_t kMostTogether = 64;  // rows given to an engine at once

/// The points asked for: the parameters that change, and a row of values for each point.
struct Points {
  std::vector<std::string> parameters;
  std::vector<std::vector<double>> values;
};

void check_method(Method method, const LinearModel& model) {
  try {
    method_for(model, method);
  } catch (const InvalidInput& error) {
    throw UsageError("--method " + std::string(to_string(method)) + ": " + error.what());
  }
}

/// A scene whose parameters are set row by row.
class ScenePoint {
 public:
  ScenePoint(const Scene& scene, const std::vector<std::string>& parameters) : scene_(scene) {
    for (const auto& path : parameters) values_.push_back(&parameter(scene_, path));
  }
  ScenePoint(const ScenePoint&) = delete;

  const Scene& at(const std::vector<double>& row) {
    for (std::size_t i = 0; i < row.size(); ++i) *values_[i] = row[i];
    return scene_;
  }

 private:
  Scene scene_;
  std::vector<double*> values_;
};

/// The column that a complaint "field = value ..." is about: the parameter of that name, or one inside the
/// matrix of that name. The first one where no cell alone is to blame.
std::size_t blamed_column(const std::vector<std::string>& columns, const std::string& complaint) {
  const std::string field = complaint.substr(0, complaint.find(" = "));
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const std::string& column) {
    return column == field || column.starts_with(field + ".");
  });
  return found == columns.end() ? 0 : static_cast<std::size_t>(found - columns.begin());
}

/// Reads the points and checks every one of them before anything is computed.
Points read_points(const StabilityArguments& arguments, const SceneFile& scene, Method method) {
  if (!arguments.points) {
    check_method(method, linear_model(scene.scene));
    return {{}, {{}}};
  }
  TableSchema schema{.required = {}, .optional = parameter_paths(scene.scene)};
  for (const auto& path : schema.optional) {
    const std::string unit = parameter_info(scene.scene, path).unit;
    if (!unit.empty()) schema.units[path] = unit;
  }
  NumericTable table = read_table(*arguments.points, schema);
  ScenePoint point(scene.scene, table.columns);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    try {
      const Scene& changed = point.at(table.rows[i]);
      validate(changed);
      check_method(method, linear_model(changed));
    } catch (const InvalidInput& error) {
      throw table.error_at(i, blamed_column(table.columns, error.what()), error.what());
    }
  }
  return {std::move(table.columns), std::move(table.rows)};
}

int states_of(const Scene& scene) { return scene.linear ? scene.linear->states() : 2; }

/// The unit of time of the scene: seconds where its parameters have units.
std::string per_time(const Scene& scene) { return scene.pendulum ? "1/s" : "1"; }

std::vector<Column> columns_of(const Scene& scene, const Points& points) {
  std::vector<Column> columns;
  for (const auto& path : points.parameters) {
    const std::string unit = parameter_info(scene, path).unit;
    columns.push_back({path, unit.empty() ? "1" : unit});
  }
  columns.insert(columns.end(), {{"verdict", ""},
                                 {"margin", "1"},
                                 {"margin_error", "1"},
                                 {"growth", "1"},
                                 {"growth_per_time", per_time(scene)},
                                 {"winding", "1"},
                                 {"discriminant", "1"}});
  const int n = states_of(scene), half = n / 2;
  for (int i = 0; n <= kMostMatrixStates && i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const bool same = (i < half) == (j < half);
      const std::string unit = same ? "1" : !scene.pendulum ? "1" : i < half ? "s" : "1/s";
      columns.push_back({fmt::format("m{}{}", i + 1, j + 1), unit});
    }
  }
  columns.push_back({"log_scale", "1"});
  for (int i = 1; i <= n; ++i) {
    columns.push_back({fmt::format("multiplier{}_re", i), "1"});
    columns.push_back({fmt::format("multiplier{}_im", i), "1"});
  }
  columns.insert(columns.end(), {{"error", "1"}, {"method", ""}, {"outcome", ""}});
  return columns;
}

std::vector<Cell> cells_of(const std::vector<double>& input, const Stability& s, int states) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<Cell> row(input.begin(), input.end());
  const Cell winding = states == 2 ? Cell(s.winding) : Cell();
  row.insert(row.end(), {std::string(to_string(s.verdict)), s.margin, s.margin_error, s.growth,
                         s.growth_per_time, winding, s.discriminant});
  const bool has_matrix = s.matrix.rows() == states;
  for (int i = 0; states <= kMostMatrixStates && i < states; ++i) {
    for (int j = 0; j < states; ++j) row.emplace_back(has_matrix ? s.matrix(i, j) : nan);
  }
  row.emplace_back(s.log_scale);
  for (std::size_t i = 0; i < static_cast<std::size_t>(states); ++i) {
    const bool has = i < s.multipliers.size();
    row.emplace_back(has ? s.multipliers[i].real() : nan);
    row.emplace_back(has ? s.multipliers[i].imag() : nan);
  }
  row.insert(row.end(), {s.error, std::string(to_string(s.method)), std::string(to_string(s.outcome))});
  return row;
}

/// What came out, for the exit code and the summary.
struct Counts {
  std::size_t rows = 0, unresolved = 0, not_converged = 0;

  void add(const Stability& s) {
    ++rows;
    unresolved += s.verdict == Verdict::unresolved ? 1 : 0;
    not_converged += s.outcome != Outcome::converged ? 1 : 0;
  }
};

/// Computes block after block in parallel and writes the rows in order.
Counts compute(const Scene& scene, const Points& points, const MonodromyOptions& options, int threads,
               RowWriter& writer, Progress& progress) {
  const ParallelOptions parallel{.threads = threads, .cancel = options.cancel};
  const auto slots = static_cast<std::size_t>(thread_count(parallel));
  std::vector<MonodromyEngine> engines(slots);
  std::vector<std::unique_ptr<ScenePoint>> scenes;
  for (std::size_t i = 0; i < slots; ++i)
    scenes.push_back(std::make_unique<ScenePoint>(scene, points.parameters));

  Counts counts;
  const std::size_t total = points.values.size(), most = kBlockRows * slots;
  std::vector<Stability> block(std::min(most, total));
  for (std::size_t first = 0; first < total; first += most) {
    const std::size_t size = std::min(most, total - first);
    const std::size_t together = std::clamp<std::size_t>(size / (4 * slots), 1, kMostTogether);
    parallel_for_ranges(size, together, parallel, [&](std::size_t begin, std::size_t end, int slot) {
      const auto own = static_cast<std::size_t>(slot);
      std::vector<LinearModel> models;
      for (std::size_t i = begin; i < end; ++i)
        models.push_back(linear_model(scenes[own]->at(points.values[first + i])));
      std::ranges::move(analyse(engines[own], models, options), block.begin() + begin);
    });
    throw_if_interrupted();
    for (std::size_t i = 0; i < size; ++i) {
      counts.add(block[i]);
      writer.write(cells_of(points.values[first + i], block[i], states_of(scene)));
    }
    progress.update(counts.rows, total);
  }
  return counts;
}

/// Mean over some points of the table, evenly among its rows.
PointForecast forecast_of(const Scene& scene, const Points& points, const MonodromyOptions& options) {
  constexpr std::size_t kMostTried = 16;
  const std::size_t rows = points.values.size(), tried = std::min(rows, kMostTried);
  ScenePoint point(scene, points.parameters);
  std::vector<LinearModel> models;
  for (std::size_t i = 0; i < tried; ++i)
    models.push_back(linear_model(point.at(points.values[i * rows / tried])));
  return forecast_points(models, options);
}

std::vector<std::string> plan_lines(const Scene& scene, const Points& points, const MonodromyOptions& options,
                                    int threads) {
  const std::size_t rows = points.values.size();
  const auto point = forecast_of(scene, points, options);
  const int used = thread_count({.threads = threads}), states = states_of(scene);
  const auto numbers = static_cast<double>(points.parameters.size() * rows),
             block = static_cast<double>(std::min(rows, kBlockRows * static_cast<std::size_t>(used)));
  const double bytes = 8.0 * numbers + block * (sizeof(Stability) + 8.0 * states * (states + 2));
  return {fmt::format("points: {}", rows),
          fmt::format("states: {}", states),
          fmt::format("memory: {:.3g} MB", bytes / 1e6),
          fmt::format("expected time: {:.2g} s", static_cast<double>(rows) * point.seconds / used),
          "method: " + std::string(to_string(point.method)),
          "point by point: " + point_line(point),
          "tolerance: " + to_text(options.tolerance),
          fmt::format("threads: {}", used)};
}

}  // namespace

ExitCode run(const StabilityArguments& arguments) {
  MonodromyOptions options{
      .method = method_of(arguments, "stability",
                          {Method::propagator, Method::cvode, Method::arkode, Method::exact}),
      .cancel = &cancel_flag()};
  const int threads = threads_of(arguments);
  require_one_standard_input(arguments, "--points", arguments.points);
  const SceneFile scene = load_scene(arguments);
  options.tolerance = tolerance_of(arguments, scene.chart.tolerance.value_or(options.tolerance));
  const Points points = read_points(arguments, scene, options.method);
  if (arguments.dry_run) {
    print_plan(scene, plan_lines(scene.scene, points, options, threads));
    return ExitCode::done;
  }
  warn_about(arguments, scene.scene);

  install_signal_handlers();
  RowWriter writer(row_path(arguments), arguments.json, columns_of(scene.scene, points),
                   provenance_of(arguments, scene, options.method, options.tolerance));
  Progress progress(!arguments.quiet, "rows");
  const Counts counts = compute(scene.scene, points, options, threads, writer, progress);
  progress.clear();
  writer.commit();
  if (!arguments.quiet && arguments.points) {
    print_note(fmt::format("{} rows in {:.2g} s, {} unresolved, {} not converged", counts.rows,
                           progress.seconds(), counts.unresolved, counts.not_converged));
  }
  return counts.unresolved + counts.not_converged == 0 ? ExitCode::done : ExitCode::unresolved;
}

}  // namespace strutt::app
