#include "chart/tongue_on_line.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/bracketed_zero.hpp"
#include "base/constants.hpp"
#include "base/minimum.hpp"

namespace strutt {
namespace {

constexpr double kNarrow = 1e-5;  // width in the mean below which its first power gives the growth

/// Two zeros a rounding apart may come in the wrong order: of a rising pair the lower edge is met first, of a
/// falling one the upper.
void order_twins(std::vector<EdgeZero>& zeros, double resolution) {
  std::ranges::sort(zeros, {}, &EdgeZero::position);
  for (std::size_t i = 1; i < zeros.size(); ++i) {
    EdgeZero &first = zeros[i - 1], &second = zeros[i];
    const bool twins = first.upper != second.upper && first.rising == second.rising &&
                       second.position - first.position <= resolution;
    if (twins && first.upper == first.rising) std::swap(first, second);
  }
}

/// Enters a tongue through the lower edge of a rising F or the upper of a falling one.
bool enters(const EdgeZero& zero, int order) {
  if (order == 0) return !zero.rising;
  return zero.rising != zero.upper;
}

std::vector<Stretch> stretches_between(const std::vector<EdgeZero>& zeros, int order, bool begins_inside) {
  std::vector<Stretch> result;
  bool inside = false;
  for (const EdgeZero& zero : zeros) {
    if (enters(zero, order)) {
      if (inside) continue;  // both edges meet in a tip; likewise where it is left
      result.push_back({zero, std::nullopt});
      inside = true;
    } else if (inside) {
      result.back().end = zero;
      inside = false;
    } else if (begins_inside && result.empty()) {
      result.push_back({std::nullopt, zero});
    }
  }
  return result;
}

/// The edges of a narrow tongue, where they are closer than their errors: about their middle.
void place(const TongueWidth& width, TongueEdge& low, TongueEdge& high) {
  if (high.position - low.position > 0.0 && width.value > 1e-9 * std::abs(low.position)) return;
  const double middle = std::midpoint(low.position, high.position);
  low.position = middle - 0.5 * width.value;
  high.position = middle + 0.5 * width.value;
}

}  // namespace

std::vector<Stretch> TongueOnLine::stretches() {
  std::vector<EdgeZero> zeros = edge_zeros(function_, true, line_, options_.resolution, options_.cancel);
  if (function_.order() > 0)
    std::ranges::move(edge_zeros(function_, false, line_, options_.resolution, options_.cancel),
                      std::back_inserter(zeros));
  order_twins(zeros, 1e-9 * (line_.to - line_.from));
  if (zeros.empty()) return inside(line_.from) ? std::vector<Stretch>{Stretch{}} : std::vector<Stretch>{};
  const bool begins_inside = inside(line_.from) || zeros.front().position == line_.from;
  return stretches_between(zeros, function_.order(), begins_inside);
}

bool TongueOnLine::inside(double position) {
  const auto& value = function_.at(position);
  return value.below(true) < 0.0 && (function_.order() == 0 || value.below(false) > 0.0);
}

std::vector<TongueEdge> TongueOnLine::edges() {
  std::vector<TongueEdge> result;
  int crossing = 0;
  for (const Stretch& stretch : stretches()) {
    const std::size_t first = result.size();
    if (stretch.begin) result.push_back(edge(*stretch.begin, false, crossing));
    if (stretch.end) result.push_back(edge(*stretch.end, true, crossing));
    if (function_.order() > 0 && options_.widths) add_width(stretch, result, first);
    ++crossing;
  }
  return result;
}

TongueEdge TongueOnLine::edge(const EdgeZero& zero, bool upper, int crossing) {
  const double p = zero.position, size = std::max(1.0, std::abs(p));
  // with one V all along the line F is the mean but for a constant, and a secant is enough
  const auto slope = line_equation_.one_variation() ? std::nullopt : function_.slope(zero.upper, p, p, line_);
  const double steepness = slope ? std::abs(slope->value) : secant(zero);
  const auto& value = function_.at(p);
  const double off = std::abs(value.below(zero.upper)) + value.error(zero.upper);
  double distance = off == 0.0 ? 0.0 : off / steepness * (slope ? 1.0 + 1e-9 : 1.01);
  if (distance > options_.tolerance * size) distance = std::min(distance, certain_distance_from(zero));
  TongueEdge result{
      .order = function_.order(),
      .upper = upper,
      .crossing = crossing,
      .position = p,
      .error = (distance + kUnit * std::abs(p)) / size,
      .mechanism = function_.order() % 2 == 0 ? Mechanism::plus_one : Mechanism::minus_one,
      .method = value.point.variation.is_piecewise_constant() && !value.point.variation.is_constant()
                    ? Method::exact
                    : Method::fourier};
  if (!(result.error <= options_.tolerance)) result.outcome = Outcome::tolerance_not_reached;
  return result;
}

double TongueOnLine::certain_distance_from(const EdgeZero& zero) {
  const auto certain = [&](double p) {
    const auto& value = function_.at(p);
    return std::abs(value.below(zero.upper)) > value.error(zero.upper);
  };
  return std::max(certain_distance(zero.position, line_.from, certain),
                  certain_distance(zero.position, line_.to, certain));
}

double TongueOnLine::secant(const EdgeZero& zero) {
  const double noise = 2.0 * kUnit * std::abs(function_.at(zero.position).point.mean);
  const double step = std::max(1e-6 * (line_.to - line_.from), 256.0 * kUnit * std::abs(zero.position));
  const double low = std::max(line_.from, zero.position - step),
               high = std::min(line_.to, zero.position + step);
  const double change = std::abs(function_.at(high).below(zero.upper) - function_.at(low).below(zero.upper));
  // on a line of a few roundings the change may be nothing else
  return change > 1e4 * noise ? change / (high - low) : std::max(0.0, change - noise) / (high - low);
}

void TongueOnLine::add_width(const Stretch& stretch, std::vector<TongueEdge>& edges, std::size_t first) {
  TongueWidth width{kNaN, kNaN};
  if (stretch.begin && stretch.end) {
    width = width_of(*stretch.begin, *stretch.end, edges[first], edges[first + 1]);
    const bool good = width.relative_error <= kWidthPromise || width.relative_error == 1.0;
    if (!good) edges[first].outcome = edges[first + 1].outcome = Outcome::tolerance_not_reached;
    if (options_.growth) add_growth(*stretch.end, edges[first], edges[first + 1]);
    place(width, edges[first], edges[first + 1]);
  }
  for (std::size_t i = first; i < edges.size(); ++i) {
    edges[i].width = width.value;
    edges[i].width_relative_error = width.relative_error;
  }
}

TongueWidth TongueOnLine::width_of(const EdgeZero& begin, const EdgeZero& end, const TongueEdge& low,
                                   const TongueEdge& high) {
  const double difference = high.position - low.position;
  const auto size = [](const TongueEdge& e) { return std::max(1.0, std::abs(e.position)); };
  const double error = low.error * size(low) + high.error * size(high) + 2.0 * kUnit * std::abs(difference);
  TongueWidth direct{difference, error / std::abs(difference)};
  if (begin.upper == end.upper || begin.rising != end.rising) return direct;
  const TongueWidth own = width_by_slope(begin, end);
  return own.relative_error <= direct.relative_error || !(difference > error) ? own : direct;
}

/// F of the lower edge is the width in the mean where that of the upper edge is zero.
TongueWidth TongueOnLine::width_by_slope(const EdgeZero& begin, const EdgeZero& end) {
  const double from = std::min(begin.position, end.position), to = std::max(begin.position, end.position);
  const auto slope = function_.slope(false, from, to, line_);
  if (!slope) return {to - from, kNaN};
  const auto& value = function_.at(begin.upper ? begin.position : end.position);
  TongueWidth width =
      function_.tongue().width(value.point.variation, value.edges, value.point.relative_error);
  width.value /= std::abs(slope->value);
  if (width.relative_error >= 1.0 || width.value == 0.0) return width;
  width.relative_error = std::min(1.0, width.relative_error + slope->relative_error + 4.0 * kUnit);
  return width;
}

/// The discriminant has one extremum between the edges of a tongue.
void TongueOnLine::add_growth(const EdgeZero& end, TongueEdge& low, TongueEdge& high) {
  const auto& value = function_.at(end.position);
  const double in_mean = value.edges.upper.value - value.edges.lower->value;
  if (in_mean < kNarrow) {
    low.growth_position = std::midpoint(low.position, high.position);
    const auto& middle = function_.at(low.growth_position);
    low.growth = narrow_tongue_growth(middle.point.variation, middle.edges,
                                      tongue_width(middle.point.variation, middle.edges));
  } else {
    const auto [place, negative] =
        least_between([&](double x) { return -line_equation_.growth(x); }, low.position, high.position);
    low.growth = -negative;
    low.growth_position = place;
  }
  high.growth = low.growth;
  high.growth_position = low.growth_position;
}

}  // namespace strutt
