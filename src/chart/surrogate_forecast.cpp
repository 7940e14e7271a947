#include "chart/surrogate_forecast.hpp"

#include <algorithm>
#include <cmath>

#include "base/constants.hpp"
#include "chart/box_subdivision.hpp"
#include "chart/chebyshev.hpp"
#include "chart/cost_table.hpp"
#include "chart/degree_ladder.hpp"
#include "chart/reciprocal_cells.hpp"
#include "chart/surrogate_build.hpp"
#include "chart/surrogate_cells.hpp"

namespace strutt {
namespace {

constexpr double kTraceTerms = 1.0;    // coefficients of D along a row against those of a factor
constexpr double kSeriesTerms = 40.0;  // multiply-adds for each coefficient of W in a power series
constexpr double kTables = 5.0;        // tolerances for which plans are made: of plan, nodes and check
constexpr double kOverEdges = 1.3;     // sums of |c| over both directions against those along an edge

/// Samples along an edge of a box: the coordinate `axis` runs.
class BoxEdge {
 public:
  BoxEdge(const SurrogateBox& box, std::size_t axis, double other)
      : axis_(axis), low_(box.low[axis]), high_(box.high[axis]), other_(other) {}

  std::size_t axis() const { return axis_; }
  std::span<const PropagatorSample> samples() const { return samples_; }

  /// At the Chebyshev points of degree n, a multiple of the degree before. False: cancelled.
  bool refine(int n, const Sampling& sampling) {
    const int before = static_cast<int>(samples_.size()) - 1, step = before > 0 ? n / before : 0;
    const auto is_new = [&](int k) { return step == 0 || k % step != 0; };
    std::vector<std::array<double, 2>> points;
    for (int k = 0; k <= n; ++k) {
      if (!is_new(k)) continue;
      points.push_back({other_, other_});
      points.back()[axis_] = chebyshev::point(k, n, low_, high_);
    }
    std::vector<PropagatorSample> found;
    if (!points.empty() && !sampling(points, found)) return false;
    std::vector<PropagatorSample> fine;
    for (int k = 0, next = 0; k <= n; ++k)
      fine.push_back(is_new(k) ? found[static_cast<std::size_t>(next++)]
                               : samples_[static_cast<std::size_t>(k / step)]);
    samples_ = std::move(fine);
    return true;
  }

 private:
  std::size_t axis_;
  double low_, high_, other_;
  std::vector<PropagatorSample> samples_;
};

/// The four edges of a box, which stand for its nodes.
class Edges {
 public:
  Edges(SurrogateBox& box, const Sampling& sampling, const std::array<double, 2>& coordinate_error)
      : box_(box),
        sampling_(sampling),
        edges_{BoxEdge(box, 0, box.low[1]), BoxEdge(box, 0, box.high[1]), BoxEdge(box, 1, box.low[0]),
               BoxEdge(box, 1, box.high[0])} {
    for (const std::size_t i : {0, 1})
      eta_[i] = 5.0 * kUnit + 2.0 * coordinate_error[i] / (box.high[i] - box.low[i]);
  }

  const std::vector<PropagatorSample>& samples() const { return samples_; }

  bool refine(int nx, int ny) {
    samples_.clear();
    for (auto& edge : edges_) {
      if (!edge.refine(edge.axis() == 0 ? nx : ny, sampling_)) return false;
      samples_.insert(samples_.end(), edge.samples().begin(), edge.samples().end());
    }
    return true;
  }

  /// Error bounds of the box as a full grid would have them, and the coefficients along the edges.
  Tail fit() {
    set_unit(box_, edges_[1].samples()[edges_[1].samples().size() / 2], samples_);
    const auto n = static_cast<std::size_t>(samples_[0].value.rows());
    coefficients_.assign(n * n, {});
    box_.error.assign(n * n, 0.0);
    Tail worst;
    std::vector<std::vector<PointPropagator>> values;
    for (const auto& edge : edges_) values.push_back(in_unit_of(box_, edge.samples()));
    for (std::size_t f = 0; f < n * n; ++f) {
      const Tail tail = fit_entry(f, n, values);
      worst = {std::max(worst.x, tail.x), std::max(worst.y, tail.y)};
    }
    return worst;
  }

  /// The direction along which the size of the factors changes more.
  BoxOutcome steeper() const {
    std::array<double, 2> change{};
    for (const auto& edge : edges_) {
      const double from = log2_size(edge.samples().front(), box_.kappa),
                   to = log2_size(edge.samples().back(), box_.kappa);
      change[edge.axis()] = std::max(change[edge.axis()], std::abs(to - from));
    }
    return change[0] >= change[1] ? BoxOutcome::split_x : BoxOutcome::split_y;
  }

  /// How many coefficients along an axis are left when those that add up to `share` of the bounds are cut.
  std::size_t terms(std::size_t axis, double share) const {
    std::size_t most = 1;
    for (std::size_t f = 0; f < coefficients_.size(); ++f) {
      for (std::size_t e = 0; e < edges_.size(); ++e) {
        if (edges_[e].axis() != axis) continue;
        const auto& c = coefficients_[f][e];
        Eigen::Index kept = c.size();
        for (double sum = 0.0; kept > 1; --kept) {
          sum += kOverEdges * std::abs(c[kept - 1]);
          if (sum > share * box_.error[f]) break;
        }
        most = std::max(most, static_cast<std::size_t>(kept));
      }
    }
    return most;
  }

 private:
  Tail fit_entry(std::size_t f, std::size_t n, const std::vector<std::vector<PointPropagator>>& values) {
    const auto row = static_cast<Eigen::Index>(f / n), column = static_cast<Eigen::Index>(f % n);
    std::array<double, 2> tail{};
    double error = 0.0, rounding = 0.0;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const auto count = static_cast<Eigen::Index>(values[e].size());
      Eigen::VectorXd v(count);
      for (Eigen::Index k = 0; k < count; ++k) {
        const auto& sample = values[e][static_cast<std::size_t>(k)];
        v[k] = sample.value(row, column);
        error = std::max(error, sample.error(row, column));
      }
      const Eigen::VectorXd c = chebyshev::transform(static_cast<int>(count) - 1) * v;
      const std::size_t axis = edges_[e].axis();
      tail[axis] = std::max(tail[axis], kOverEdges * c.tail(tail_length(count)).cwiseAbs().sum());
      const Eigen::ArrayXd place = Eigen::ArrayXd::LinSpaced(count, 0.0, static_cast<double>(count - 1));
      const double slope = (place.square() * c.array().abs()).sum();
      rounding = std::max(rounding, static_cast<double>(2 * count + 4) * kUnit * c.cwiseAbs().sum() +
                                        (eta_[0] + eta_[1]) * slope);
      error = std::max(error, sample_rounding(v, count));
      coefficients_[f].push_back(c);
    }
    box_.error[f] = 2.0 * (tail[0] + tail[1]) + kNodeErrorGrowth * error + kOverEdges * rounding;
    return {tail[0], tail[1]};
  }

  static double sample_rounding(const Eigen::VectorXd& values, Eigen::Index count) {
    return transform_error(static_cast<int>(count), static_cast<int>(count), values.cwiseAbs().maxCoeff());
  }

  SurrogateBox& box_;
  const Sampling& sampling_;
  std::array<BoxEdge, 4> edges_;
  std::array<double, 2> eta_{};
  std::vector<PropagatorSample> samples_;
  std::vector<std::vector<Eigen::VectorXd>> coefficients_;  // entry by entry, edge by edge
};

/// Of one thread, for a cell that is interpolated, but for the tensor product.
double seconds_of_cell(const Scene& scene, const ChartRequest& request, const SurrogateScope& scope) {
  if (scope.kind == SurrogateKind::half_period) {
    const auto layers = static_cast<double>(request.layers.size());
    return (wants_trace_only(request) ? 0.0 : kCosts.cell) + kCosts.cell_layer * layers;
  }
  if (!scope.is_system) return kCosts.period_cell;
  if (ReciprocalCells::serves(scene, request.x, request.y)) return kCosts.reciprocal_cell;
  return kCosts.matrix_cell * cube_of(scene.linear->degrees_of_freedom());
}

double mean_work(const std::vector<PropagatorSample>& samples) {
  double sum = 0.0;
  for (const auto& sample : samples) sum += static_cast<double>(sample.right_hand_sides);
  return samples.empty() ? 0.0 : sum / static_cast<double>(samples.size());
}

}  // namespace

SurrogateForecast forecast_surrogate(const Scene& scene, const ChartRequest& request,
                                     const SurrogateScope& scope) {
  const Axis &x = request.x, &y = request.y;
  SurrogateOptions options = surrogate_options(request);
  options.threads = 1;
  const auto source = surrogate_source(scope, scene, x, y, options);
  const Sampling sampling = [&](const auto& points, auto& result) {
    return source.nodes(parameter_values(x, y, points), result);
  };
  const auto rounding = coordinate_errors(x, y);
  SurrogateForecast forecast;
  double work = 0.0;
  std::size_t terms_x = 1, terms_y = 1, functions = 4;
  const auto attempt = [&](SurrogateBox& box, double affordable) {
    Edges edges(box, sampling, rounding);
    const auto ladder = raise_degrees(edges, box, scope.kind, options.tolerance, affordable);
    box.interpolated = ladder.outcome == BoxOutcome::interpolated;
    BoxBuild build{.outcome = ladder.outcome};
    if (ladder.nx > 0) build.nodes = static_cast<std::size_t>((ladder.nx + 1) * (ladder.ny + 1));
    forecast.nodes += static_cast<double>(build.nodes);
    work += static_cast<double>(build.nodes) * mean_work(edges.samples());
    if (!box.interpolated) return build;
    const double share = kShareAfterCut * options.tolerance / ladder.error - 1.0;
    terms_x = edges.terms(0, share);
    terms_y = edges.terms(1, share);
    functions = box.error.size();
    const auto samples = static_cast<double>(build.nodes * functions);
    forecast.bytes = std::max(forecast.bytes, 64.0 * samples);
    return build;
  };
  double stored = 0.0;
  subdivide(x, y, attempt, [&](SurrogateBox&& box, BoxOutcome) {
    if (!box.interpolated) {
      ++forecast.boxes_left_out;
      return;
    }
    ++forecast.boxes;
    const double cells = cells_in(box, x, y);
    forecast.cells += cells;
    forecast.highest_degree =
        std::max(forecast.highest_degree, static_cast<int>(std::max(terms_x, terms_y)) - 1);
    const bool trace = scope.kind == SurrogateKind::half_period && wants_trace_only(request);
    const double together = trace ? kTraceTerms : static_cast<double>(functions);
    forecast.multiply_adds += cells * together * static_cast<double>(terms_x);
    stored += 8.0 * static_cast<double>(terms_x * terms_y * functions);
  });
  forecast.bytes += stored + 8.0 * static_cast<double>(x.points * (terms_x + 12));
  if (forecast.nodes > 0.0) forecast.right_hand_sides = work / forecast.nodes;
  return forecast;
}

double expected_seconds(const SurrogateForecast& forecast, const PointForecast& point, const Scene& scene,
                        const ChartRequest& request, const SurrogateScope& scope) {
  const double work = forecast.right_hand_sides;
  const double node = scope.is_system ? seconds_of_system(scene.linear->degrees_of_freedom(), work)
                                      : kCosts.hill_node + kCosts.hill_term * kSeriesTerms * work;
  const double check = scope.is_system ? node : kCosts.hill_check;
  const auto cells = static_cast<double>(request.x.points) * static_cast<double>(request.y.points);
  const double tables = scope.is_system ? 0.0 : kTables * kCosts.hill_tables;
  return tables + forecast.nodes * node + static_cast<double>(forecast.boxes * kChecks) * check +
         static_cast<double>(request.x.points + request.y.points) * kCosts.axis_point +
         forecast.multiply_adds * kCosts.cell_multiply_add +
         forecast.cells * seconds_of_cell(scene, request, scope) + (cells - forecast.cells) * point.seconds;
}

}  // namespace strutt
