#include "chart/damped_tongue.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/constants.hpp"
#include "chart/margin_pieces.hpp"

namespace strutt {
namespace {

constexpr double kNarrowUndamped = 2e-6;  // undamped width in the mean
constexpr double kUneven = 1e-2;     // change of h/h0 across the tongue, above which it has no narrow form
constexpr double kEstimated = 1e-2;  // the same, below which the narrow form is worth a comparison
constexpr double kCurvature =
    8.0;  // bounds the relative error of the narrow form by its product with width^2
constexpr double kFarBelow = 0x1p-10;  // of the tolerance: good enough where no width follows from it
constexpr int kStepsOfMean = 8;
constexpr int kGrowthSteps = 16;

}  // namespace

std::vector<TongueEdge> DampedTongue::edges() {
  for (const Stretch& stretch : undamped_.stretches())
    if (!add_narrow(stretch)) add_wide(stretch);
  return std::move(edges_);
}

TongueEdge DampedTongue::edge(double position, double error, bool upper) const {
  const int order = undamped_.function().order();
  TongueEdge result{.order = order,
                    .upper = upper,
                    .crossing = crossing_,
                    .position = position,
                    .error = error / std::max(1.0, std::abs(position)),
                    .mechanism = order % 2 == 0 ? Mechanism::plus_one : Mechanism::minus_one};
  if (!(result.error <= options_.tolerance)) result.outcome = Outcome::tolerance_not_reached;
  return result;
}

/// The resonant block at the exponent n/2 + i eta, eta = h/(2 pi), is [a + i b, beta; conj(beta), a - i b]
/// with b = eta |dh/dnu|, up to terms of eta^2: a^2 = |beta|^2 - b^2.
DampedTongue::Narrow DampedTongue::narrow(const Stretch& stretch) {
  const auto& value = undamped_.function().at(stretch.end->position);
  KnownTongue& tongue = undamped_.function().tongue();
  const TongueWidth in_mean = tongue.width(value.point.variation, value.edges, value.point.relative_error);
  const TongueEdge low = undamped_.edge(*stretch.begin, false, 0),
                   high = undamped_.edge(*stretch.end, true, 0);
  const TongueWidth whole = undamped_.width_of(*stretch.begin, *stretch.end, low, high);
  const double growth_high = tongue.growth(value.point.variation, value.edges, value.point.relative_error);
  double growth_low = growth_high;
  if (!equation_.one_variation()) {
    const auto& at_low = undamped_.function().at(stretch.begin->position);
    growth_low = tongue.growth(at_low.point.variation, at_low.edges, at_low.point.relative_error);
  }
  const double growth = std::midpoint(growth_low, growth_high);
  const double middle = std::midpoint(low.position, high.position);
  const double damping = equation_.half_damping(middle), ratio = damping / growth;
  const double uneven = std::abs(equation_.half_damping(low.position) / growth_low -
                                 equation_.half_damping(high.position) / growth_high) /
                        ratio;
  Narrow result{.middle = middle,
                .position_error = 0.0,
                .width = {0.0, 1.0},
                .growth = growth - damping,
                .uneven = uneven};
  if (!(ratio < 1.0)) return result;
  const double open = (1.0 - ratio) * (1.0 + ratio);
  const double along = whole.value / std::max(std::abs(middle), line_.to - line_.from);
  const double model =
      kCurvature * (in_mean.value * in_mean.value + along * along + uneven * uneven) + 16.0 * kUnit;
  const double relative = whole.relative_error + (model + in_mean.relative_error) / open;
  result.width = {whole.value * std::sqrt(open), std::min(1.0, relative)};
  result.position_error = std::max(low.error, high.error) * std::max(1.0, std::abs(middle)) +
                          whole.value * (in_mean.value + along + uneven);
  return result;
}

/// Whether damping closes a tongue on a stretch by far, whatever its width is below what double precision
/// leaves open.
bool DampedTongue::clearly_closed(const Stretch& stretch) {
  constexpr double kFar = 2.0;  // more than the growth of a narrow tongue changes between its edges
  for (const double position : {stretch.begin->position, stretch.end->position}) {
    const auto& value = undamped_.function().at(position);
    const double most = undamped_.function().tongue().growth_bound(value.point.variation, value.edges);
    if (!(equation_.half_damping(position) > kFar * most)) return false;
  }
  return true;
}

bool DampedTongue::add_narrow(const Stretch& stretch) {
  if (undamped_.function().order() == 0 || !stretch.begin || !stretch.end) return false;
  const auto& edges = undamped_.function().at(stretch.end->position).edges;
  if (!(edges.upper.value - edges.lower->value < kNarrowUndamped)) return false;
  if (equation_.half_damping(stretch.begin->position) == 0.0 &&
      equation_.half_damping(stretch.end->position) == 0.0)
    return false;
  if (clearly_closed(stretch)) return true;
  const Narrow left = narrow(stretch);
  if (!(left.uneven < kUneven)) return false;
  if (left.width.relative_error >= 1.0) return true;  // closed, or it cannot be said
  const double half = 0.5 * left.width.value;
  TongueEdge low = edge(left.middle - half, left.position_error + kUnit * std::abs(left.middle), false);
  TongueEdge high = edge(left.middle + half, left.position_error + kUnit * std::abs(left.middle), true);
  low.growth = high.growth = options_.growth ? left.growth : low.growth;
  low.growth_position = high.growth_position = options_.growth ? left.middle : low.growth_position;
  add_width(low, high, left);
  edges_.insert(edges_.end(), {low, high});
  ++crossing_;
  return true;
}

void DampedTongue::add_wide(const Stretch& stretch) {
  const double from = stretch.begin ? stretch.begin->position : line_.from;
  const double to = stretch.end ? stretch.end->position : line_.to;
  if (!(from < to)) return;
  const auto changes = changes_in(stretch, from, to);
  std::optional<Narrow> estimate;
  if (options_.widths && stretch.begin && stretch.end && undamped_.function().order() > 0) {
    const auto& edges = undamped_.function().at(to).edges;
    if (edges.upper.value - edges.lower->value < kEstimated) estimate = narrow(stretch);
  }
  for (std::size_t i = 0; i < changes.size(); ++i) {
    TongueEdge next = edge(changes[i].position, changes[i].error, !changes[i].begins);
    next.method = verdicts_.at(changes[i].unstable_at).method;
    edges_.push_back(next);
    if (changes[i].begins) continue;
    ++crossing_;
    if (i == 0 || undamped_.function().order() == 0) continue;
    TongueEdge &low = edges_[edges_.size() - 2], &high = edges_.back();
    add_width(low, high, estimate);
    if (options_.widths && low.outcome != Outcome::converged) sharpen_pair(low, high);
    if (options_.growth) add_growth(low, high);
  }
  if (!changes.empty() && changes.back().begins) ++crossing_;
  if (options_.widths) sharpen_rest(edges_.size() - changes.size());
}

std::vector<StabilityChange> DampedTongue::changes_in(const Stretch& stretch, double from, double to) {
  // at the edges of the undamped tongue |D| = 2
  const ChangeSearch search{.steps = kStepsOfMean,
                            .stable_from = stretch.begin.has_value(),
                            .stable_to = stretch.end.has_value(),
                            .resolution = options_.widths ? 0.0 : kFarBelow * options_.tolerance,
                            .cancel = options_.cancel};
  const bool whole = (stretch.begin && stretch.end) || undamped_.function().order() == 0;
  if (whole && only_mean_changes(from, to)) return stability_changes(verdicts_, from, to, search);
  const auto excess = [&](double p) {
    Margin result = log_excess(p);
    const bool edge = (p == from && stretch.begin) || (p == to && stretch.end);
    if (edge) result.value = -std::log(std::cosh(std::min(equation_.half_damping(p), 700.0)));
    return result;
  };
  return stability_changes(verdicts_, sign_pieces(excess, from, to, options_.cancel), search);
}

/// ln |D| - ln(2 cosh h), analytic in the tongue, as |D| >= 2 there.
Margin DampedTongue::log_excess(double position) {
  const auto& point = verdicts_.at(position);
  const double h = equation_.half_damping(position), total = point.growth + h;
  const Margin& margin = point.margin;
  if (std::abs(margin.value) < 0.5) return {std::log1p(-margin.value), margin.error / (1.0 - margin.value)};
  const auto log_two_cosh = [](double x) { return std::abs(x) + std::log1p(std::exp(-2.0 * std::abs(x))); };
  // far from zero, where the margin may be too close to 1 or beyond double
  return {log_two_cosh(total) - log_two_cosh(h), 1e-12 + 8.0 * kUnit * (std::abs(total) + h)};
}

/// |D| then has one maximum, and none in tongue 0, where it is monotone.
bool DampedTongue::only_mean_changes(double from, double to) {
  const LinePoint low = equation_.at(from), high = equation_.at(to);
  return change_between(low, high) == std::abs(low.mean - high.mean) &&
         low.damping_shift == high.damping_shift;
}

void DampedTongue::add_width(TongueEdge& low, TongueEdge& high, const std::optional<Narrow>& estimate) const {
  if (!options_.widths) return;
  const auto absolute = [](const TongueEdge& e) { return e.error * std::max(1.0, std::abs(e.position)); };
  const double difference = high.position - low.position;
  TongueWidth width{difference, std::min(1.0, (absolute(low) + absolute(high)) / difference + 2.0 * kUnit)};
  if (estimate && (!(difference > 0.0) || estimate->width.relative_error < width.relative_error))
    width = estimate->width;
  low.width = high.width = width.value;
  low.width_relative_error = high.width_relative_error = width.relative_error;
  if (width.relative_error > kWidthPromise) low.outcome = high.outcome = Outcome::tolerance_not_reached;
}

/// What the position leaves over of the edge, if that could be found in 50 digits.
std::optional<double> DampedTongue::sharpen(TongueEdge& edge) const {
  const double size = std::max(1.0, std::abs(edge.position));
  const auto zero = extended_.near(edge.position, edge.error * size);
  if (!zero) return std::nullopt;
  edge.position = zero->position;
  edge.error = (std::abs(zero->remainder) + kUnit * kUnit * std::abs(edge.position)) / size;
  edge.outcome = edge.error <= options_.tolerance ? Outcome::converged : Outcome::tolerance_not_reached;
  return zero->remainder;
}

/// Edges without a partner; any that turns out to lie beyond the end of the line is left out.
void DampedTongue::sharpen_rest(std::size_t first) {
  for (std::size_t i = first; i < edges_.size(); ++i)
    if (!(edges_[i].error <= options_.tolerance)) sharpen(edges_[i]);
  const auto outside = [this](const TongueEdge& e) {
    return e.position < line_.from || e.position > line_.to;
  };
  for (std::size_t i = first; i < edges_.size(); ++i) {
    if (!outside(edges_[i])) continue;
    for (TongueEdge& partner : edges_)
      if (partner.crossing == edges_[i].crossing)
        partner.width = partner.width_relative_error = partner.growth = partner.growth_position = kNaN;
  }
  std::erase_if(edges_, outside);
}

void DampedTongue::sharpen_pair(TongueEdge& low, TongueEdge& high) const {
  const auto beyond_low = sharpen(low), beyond_high = sharpen(high);
  if (beyond_low && beyond_high) {
    low.width = high.width = (high.position - low.position) + (*beyond_high - *beyond_low);
    low.width_relative_error = high.width_relative_error = 8.0 * kUnit;
  } else if (low.width_relative_error > kWidthPromise) {
    low.outcome = high.outcome = Outcome::tolerance_not_reached;
  }
}

void DampedTongue::add_growth(TongueEdge& low, TongueEdge& high) const {
  const GrowthPeak peak = largest_growth(verdicts_, low.position, high.position, kGrowthSteps);
  low.growth = high.growth = peak.growth;
  low.growth_position = high.growth_position = peak.position;
}

}  // namespace strutt
