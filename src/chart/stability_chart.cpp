#include "strutt/chart/stability_chart.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <string>

#include "chart/cell_engine.hpp"
#include "chart/surrogate_cells.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"
#include "strutt/base/parallel.hpp"

namespace strutt {
namespace {

constexpr std::size_t kMostTogether = 256;  // cells given to an engine at once: enough to fill its registers

/// What a cell adds to the summary.
struct CellRecord {
  Outcome outcome = Outcome::failed;
  Method method = Method::automatic;
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
  ++summary.methods[static_cast<std::size_t>(cell.method)];
  if (with_verdict && cell.unresolved) ++summary.unresolved;
  summary.right_hand_sides += cell.right_hand_sides;
  if (cell.outcome == Outcome::converged) summary.largest_error = std::max(summary.largest_error, cell.error);
}

/// Computes cells of a strip point by point.
class PointByPoint {
 public:
  PointByPoint(const Scene& scene, const ChartRequest& request, std::size_t total,
               const ProgressSink& progress)
      : request_(request),
        with_verdict_(std::count(request.layers.begin(), request.layers.end(), Layer::verdict) > 0),
        parallel_{.threads = request.threads, .cancel = request.cancel},
        batch_(thread_count(parallel_)),
        records_(batch_.most()),
        total_(total),
        progress_(progress) {
    for (int slot = 0; slot < thread_count(parallel_); ++slot)
      engines_.push_back(std::make_unique<CellEngine>(scene, request));
  }

  /// The cells of the strip at `places`. False: cancelled.
  bool fill(ChartStrip& strip, ChartSummary& summary, const std::vector<std::size_t>& places) {
    for (std::size_t start = 0, count = 0; start < places.size(); start += count) {
      const auto begin = std::chrono::steady_clock::now();
      count = std::min(batch_.size(), places.size() - start);
      const std::size_t together = std::clamp<std::size_t>(count / (4 * engines_.size()), 1, kMostTogether);
      const std::span<const std::size_t> some(&places[start], count);
      const bool complete =
          parallel_for_ranges(count, together, parallel_, [&](std::size_t first, std::size_t last, int slot) {
            fill_cells(strip, some.subspan(first, last - first), &records_[first],
                       *engines_[static_cast<std::size_t>(slot)]);
          });
      // a cell that was being integrated when the caller cancelled counts as done, but holds nothing
      if (!complete || (request_.cancel != nullptr && request_.cancel->load())) return false;
      for (std::size_t k = 0; k < count; ++k) add(summary, records_[k], with_verdict_);
      if (progress_) progress_(summary.cells, total_);
      batch_.adapt(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    return true;
  }

 private:
  void fill_cells(ChartStrip& strip, std::span<const std::size_t> cells, CellRecord* records,
                  CellEngine& engine) const {
    std::vector<std::array<double, 2>> points;
    for (const std::size_t cell : cells) {
      points.push_back(
          {request_.x.value(cell % strip.columns), request_.y.value(strip.first_row + cell / strip.columns)});
    }
    const auto results = engine.compute(points);
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const auto& result = results[k];
      for (std::size_t l = 0; l < request_.layers.size(); ++l)
        strip.values[l][cells[k]] = layer_value(result, request_.layers[l]);
      records[k] = {result.outcome, result.method, result.verdict == Verdict::unresolved, result.error,
                    result.cost.right_hand_sides + result.estimate_cost.right_hand_sides};
    }
  }

  const ChartRequest& request_;
  bool with_verdict_;
  ParallelOptions parallel_;
  BatchSize batch_;
  std::vector<CellRecord> records_;
  std::size_t total_;
  const ProgressSink& progress_;
  std::vector<std::unique_ptr<CellEngine>> engines_;
};

/// Points the strip, whose rows are set, to where its values go.
using Placement = std::function<void(ChartStrip& strip)>;

ChartSummary compute(const Scene& scene, const ChartRequest& request, const Placement& place,
                     const StripSink& sink, const ProgressSink& progress) {
  const DefaultFloatingPoint environment;
  const ChartPlan plan = plan_chart(scene, request);
  const std::size_t nx = request.x.points, ny = request.y.points;
  ChartSummary summary;
  summary.outcomes.assign(kOutcomeCount, 0);
  summary.methods.assign(kMethodCount, 0);
  PointByPoint points(scene, request, plan.cells, progress);
  std::optional<SurrogateCells> surrogate;
  if (plan.method == Method::surrogate) {
    surrogate.emplace(scene, request);
    summary.surrogate = surrogate->surrogate().report();
    summary.right_hand_sides = summary.surrogate->right_hand_sides;
    summary.cancelled = surrogate->surrogate().cancelled();
    if (summary.cancelled) return summary;
  }

  ChartStrip strip{.columns = nx, .values = std::vector<std::span<double>>(request.layers.size())};
  std::vector<std::size_t> places;
  for (strip.first_row = 0; strip.first_row < ny; strip.first_row += strip.rows) {
    strip.rows = std::min(plan.rows_per_strip, ny - strip.first_row);
    place(strip);
    bool complete = true;
    if (surrogate) {
      complete = surrogate->fill(strip, summary, places);
      if (complete && progress) progress(summary.cells, plan.cells);
    } else {
      places.resize(strip.rows * nx);
      std::iota(places.begin(), places.end(), std::size_t{0});
    }
    summary.cancelled = !complete || !points.fill(strip, summary, places);
    if (summary.cancelled) return summary;
    if (sink) sink(strip);
  }
  return summary;
}

}  // namespace

ChartSummary compute_chart(const Scene& scene, const ChartRequest& request, const StripSink& sink,
                           const ProgressSink& progress) {
  std::vector<std::vector<double>> buffers(request.layers.size());
  const auto into_buffers = [&](ChartStrip& strip) {
    for (std::size_t l = 0; l < buffers.size(); ++l) {
      buffers[l].resize(strip.rows * strip.columns);  // the last strip may be shorter
      strip.values[l] = buffers[l];
    }
  };
  return compute(scene, request, into_buffers, sink, progress);
}

ChartSummary compute_chart(const Scene& scene, const ChartRequest& request,
                           std::span<const std::span<double>> arrays, const ProgressSink& progress) {
  const std::size_t cells = request.x.points * request.y.points;
  if (arrays.size() != request.layers.size())
    throw InvalidInput("arrays", std::to_string(arrays.size()), "one for each layer");
  for (const auto& array : arrays) {
    if (array.size() != cells)
      throw InvalidInput("array of a layer", std::to_string(array.size()), "as long as the chart has cells");
  }
  const auto into_arrays = [&](ChartStrip& strip) {
    for (std::size_t l = 0; l < arrays.size(); ++l)
      strip.values[l] = arrays[l].subspan(strip.first_row * strip.columns, strip.rows * strip.columns);
  };
  return compute(scene, request, into_arrays, {}, progress);
}

}  // namespace strutt
