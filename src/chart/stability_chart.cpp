#include "strutt/chart/stability_chart.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <span>

#include "strutt/base/error.hpp"
#include "strutt/base/parallel.hpp"
#include "strutt/floquet/stability.hpp"

namespace strutt {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kStripCells = 65'536;
constexpr std::size_t kMostTogether = 256;  // cells given to an engine at once: enough to fill its registers

// Cost of a cell, measured on one core of a 2020s server at tolerance 1e-9; for the forecast only. Of systems of four
// states; a Hill equation takes the propagator an eighth of that, the others half.
struct CellCost {
  Method method;
  double seconds;
};
constexpr CellCost kCellCosts[] = {
    {Method::exact, 5e-6}, {Method::propagator, 1.5e-5}, {Method::arkode, 1.8e-4}, {Method::cvode, 1.2e-3}};

std::string gigabytes(double bytes) { return to_text(std::round(bytes / 1e7) / 100.0) + " GB"; }

void check_request(const ChartRequest& request) {
  request.x.validate("x");
  request.y.validate("y");
  if (request.x.parameter == request.y.parameter) {
    throw InvalidInput("y axis: parameter", request.y.parameter, "different from that of the x axis");
  }
  if (request.layers.empty()) throw InvalidInput("layers", "none", "at least one");
  for (std::size_t i = 0; i < request.layers.size(); ++i) {
    if (std::count(request.layers.begin(), request.layers.end(), request.layers[i]) > 1) {
      throw InvalidInput("layers", to_string(request.layers[i]), "asked for only once");
    }
  }
  MonodromyOptions{.tolerance = request.tolerance, .method = request.method}.validate();
}

/// One thread's model and integrators. Pointers into the scene let a cell set its two parameters in place.
class CellComputer {
 public:
  CellComputer(const Scene& scene, const ChartRequest& request)
      : scene_(scene),
        x_(&parameter(scene_, request.x.parameter)),
        y_(&parameter(scene_, request.y.parameter)),
        options_{.tolerance = request.tolerance, .method = request.method, .cancel = request.cancel} {
    for (const Layer layer : request.layers) {
      parts_.winding = parts_.winding || layer == Layer::winding;
      parts_.matrix = parts_.matrix || layer == Layer::discriminant;
    }
  }
  CellComputer(const CellComputer&) = delete;

  /// One result for each of the points (x, y).
  std::vector<Stability> compute(std::span<const std::array<double, 2>> points) {
    std::vector<LinearModel> models;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < points.size(); ++i) {
      *x_ = points[i][0];
      *y_ = points[i][1];
      try {
        LinearModel model = linear_model(scene_);
        std::visit([](const auto& m) { m.validate(); }, model);
        models.push_back(std::move(model));
        places.push_back(i);
      } catch (const InvalidInput&) {
        // outcome failed: the corners were checked, but not every combination inside need be a body
      }
    }
    auto found = analyse(engine_, models, options_, parts_);
    std::vector<Stability> results(points.size());
    for (std::size_t j = 0; j < places.size(); ++j) results[places[j]] = std::move(found[j]);
    return results;
  }

 private:
  Scene scene_;
  double* x_;
  double* y_;
  MonodromyOptions options_;
  StabilityParts parts_{.winding = false, .matrix = false};
  MonodromyEngine engine_;
};

double layer_value(const Stability& cell, Layer layer) {
  if (layer == Layer::outcome) return static_cast<double>(cell.outcome);
  const bool has_value = cell.outcome == Outcome::converged || cell.outcome == Outcome::tolerance_not_reached;
  if (layer == Layer::verdict) return static_cast<double>(has_value ? cell.verdict : Verdict::unresolved);
  if (!has_value) return kNaN;
  switch (layer) {
    case Layer::growth: return cell.growth;
    case Layer::winding: return cell.winding;
    case Layer::discriminant: {
      const double trace = cell.discriminant * std::exp(cell.log_scale);
      return std::abs(trace) > 1e300 ? std::copysign(std::numeric_limits<double>::infinity(), trace) : trace;
    }
    default: return cell.margin;
  }
}

/// What a cell adds to the summary.
struct CellRecord {
  Outcome outcome = Outcome::failed;
  bool unresolved = false;
  double error = 0.0;
  long right_hand_sides = 0;
};

/// How many cells are computed between two looks at progress: as many as take a fraction of a second.
class BatchSize {
 public:
  explicit BatchSize(int threads) : threads_(static_cast<std::size_t>(threads)), size_(kFirst * threads_) {}

  std::size_t size() const { return size_; }
  std::size_t most() const { return kMost * threads_; }

  void adapt(double seconds) {
    if (seconds < 0.1) size_ = std::min(2 * size_, most());
    if (seconds > 0.4) size_ = std::max(size_ / 2, threads_);
  }

 private:
  static constexpr std::size_t kFirst = 8, kMost = 8192;  // per thread
  std::size_t threads_;
  std::size_t size_;
};

void add(ChartSummary& summary, const CellRecord& cell, bool with_verdict) {
  ++summary.cells;
  ++summary.outcomes[static_cast<std::size_t>(cell.outcome)];
  if (with_verdict && cell.unresolved) ++summary.unresolved;
  summary.right_hand_sides += cell.right_hand_sides;
  if (cell.outcome == Outcome::converged) summary.largest_error = std::max(summary.largest_error, cell.error);
}

}  // namespace

double memory_budget() {
  return 0.5 * static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

double expected_seconds_per_point(Method method) {
  for (const auto& cost : kCellCosts) {
    if (cost.method == method) return cost.seconds;
  }
  return 0.0;
}

ChartPlan plan_chart(const Scene& scene, const ChartRequest& request) {
  check_request(request);
  Scene corner = scene;
  for (const double x : {request.x.from, request.x.to}) {
    for (const double y : {request.y.from, request.y.to}) {
      parameter(corner, request.x.parameter) = x;
      parameter(corner, request.y.parameter) = y;
      validate(corner);
    }
  }
  const LinearModel model = linear_model(corner);

  ChartPlan plan;
  const double cells = static_cast<double>(request.x.points) * static_cast<double>(request.y.points);
  if (!(cells < 9e15)) throw MemoryBudgetExceeded("a chart of " + to_text(cells) + " cells is beyond any machine");
  const std::size_t nx = request.x.points, ny = request.y.points, layers = request.layers.size();
  plan.cells = nx * ny;
  plan.rows_per_strip = std::clamp<std::size_t>(kStripCells / nx, 1, ny);
  plan.result_bytes = 8.0 * (cells * static_cast<double>(layers) + static_cast<double>(nx + ny));
  plan.working_bytes = 8.0 * static_cast<double>(plan.rows_per_strip * nx) * static_cast<double>(layers + 4);
  plan.budget_bytes = memory_budget();
  plan.method = method_for(model, request.method);
  plan.threads = thread_count({.threads = request.threads});
  plan.expected_seconds = cells * expected_seconds_per_point(plan.method) / plan.threads;
  const double bytes = std::max(plan.result_bytes, plan.working_bytes);
  if (bytes > plan.budget_bytes && !request.force) {
    throw MemoryBudgetExceeded("a chart of " + std::to_string(nx) + " x " + std::to_string(ny) + " points with " +
                               std::to_string(layers) + " layers takes " + gigabytes(bytes) +
                               ", more than the budget of " + gigabytes(plan.budget_bytes) +
                               " (half of the memory); --force lifts it");
  }
  return plan;
}

ChartSummary compute_chart(const Scene& scene, const ChartRequest& request, const StripSink& sink,
                           const ProgressSink& progress) {
  const ChartPlan plan = plan_chart(scene, request);
  const std::size_t nx = request.x.points, ny = request.y.points, layers = request.layers.size();
  const bool with_verdict = std::count(request.layers.begin(), request.layers.end(), Layer::verdict) > 0;
  const ParallelOptions parallel{.threads = request.threads, .cancel = request.cancel};
  std::vector<std::unique_ptr<CellComputer>> workers;
  for (int slot = 0; slot < plan.threads; ++slot) workers.push_back(std::make_unique<CellComputer>(scene, request));

  ChartSummary summary;
  summary.outcomes.assign(kOutcomeCount, 0);
  ChartStrip strip{.columns = nx, .values = std::vector<std::vector<double>>(layers)};
  for (auto& layer : strip.values) layer.reserve(plan.rows_per_strip * nx);
  BatchSize batch(plan.threads);
  std::vector<CellRecord> records(batch.most());

  for (strip.first_row = 0; strip.first_row < ny; strip.first_row += strip.rows) {
    strip.rows = std::min(plan.rows_per_strip, ny - strip.first_row);
    const std::size_t cells = strip.rows * nx;
    for (auto& layer : strip.values) layer.resize(cells);  // the last strip may be shorter
    for (std::size_t start = 0, count = 0; start < cells; start += count) {
      const auto begin = std::chrono::steady_clock::now();
      count = std::min(batch.size(), cells - start);
      const std::size_t together =
          std::clamp<std::size_t>(count / (4 * workers.size()), 1, kMostTogether);
      const auto compute_some = [&](std::size_t task, int slot) {
        std::vector<std::array<double, 2>> points;
        const std::size_t first = task * together, last = std::min(first + together, count);
        for (std::size_t cell = start + first; cell < start + last; ++cell) {
          points.push_back({request.x.value(cell % nx), request.y.value(strip.first_row + cell / nx)});
        }
        const auto results = workers[static_cast<std::size_t>(slot)]->compute(points);
        for (std::size_t k = first; k < last; ++k) {
          const auto& result = results[k - first];
          for (std::size_t l = 0; l < layers; ++l) {
            strip.values[l][start + k] = layer_value(result, request.layers[l]);
          }
          records[k] = {result.outcome, result.verdict == Verdict::unresolved, result.error,
                        result.cost.right_hand_sides + result.estimate_cost.right_hand_sides};
        }
      };
      const bool complete = parallel_for((count + together - 1) / together, parallel, compute_some);
      // a cell that was being integrated when the caller cancelled counts as done, but holds nothing
      if (!complete || (request.cancel != nullptr && request.cancel->load())) {
        summary.cancelled = true;
        return summary;
      }
      for (std::size_t k = 0; k < count; ++k) add(summary, records[k], with_verdict);
      if (progress) progress(summary.cells, plan.cells);
      batch.adapt(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    sink(strip);
  }
  return summary;
}

}  // namespace strutt
