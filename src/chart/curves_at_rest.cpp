// Where the curves of tongues begin and end for want of excitation.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "chart/curve_tracer.hpp"
#include "chart/edge_function.hpp"
#include "chart/resting_resonance.hpp"

namespace strutt {
namespace {

constexpr double kThin = 32.0;  // of the thinnest pairs: a pair so thin vanishes there, not at a tip
constexpr double kShift =
    4.0;  // chords between a thin pair and its resonance at rest: a parabola's sag is a fourth

/// Closest pairs, lower edge first, without which `longer` looks like `shorter`: each by its place in what is
/// left when the earlier ones are taken out.
std::optional<std::vector<std::size_t>> thin_pairs(Slice longer, const Slice& shorter, double thin) {
  std::vector<std::size_t> pairs;
  while (longer.edges.size() > shorter.edges.size()) {
    std::optional<std::size_t> best;
    double least = thin;
    for (std::size_t i = 0; i + 1 < longer.edges.size(); ++i) {
      const TongueEdge &low = longer.edges[i].edge, &high = longer.edges[i + 1].edge;
      if (low.upper || !high.upper || !(high.position - low.position < least)) continue;
      best = i;
      least = high.position - low.position;
    }
    if (!best) return std::nullopt;
    pairs.push_back(*best);
    longer = without_pair(std::move(longer), *best);
  }
  if (pairs.empty() || !same_pattern(longer, shorter)) return std::nullopt;
  return pairs;
}

}  // namespace

/// Is nothing excited there? Both edges of a tongue are then the same number.
bool CurveTracer::at_rest(const TongueEdge& edge, double over) const {
  Scene scene = source_.scene();
  parameter(scene, source_.along().parameter) = edge.position;
  parameter(scene, source_.over().parameter) = over;
  const auto equation = LineEquation::hill_equation_of(scene);
  return equation && equation->coefficient.is_constant();
}

/// The first or the last slice, the active strands on it: a tongue that closes there for want of excitation
/// turns back.
void CurveTracer::turn_at_rest(const Slice& slice, bool begins) {
  if (order_ == kNoOrder) return;
  for (std::size_t i = 0; i + 1 < slice.edges.size(); ++i) {
    const TongueEdge &low = slice.edges[i].edge, &high = slice.edges[i + 1].edge;
    if (low.upper || !high.upper || low.position != high.position || !at_rest(low, slice.over)) continue;
    const int left = active_[i], right = active_[i + 1];
    Strand &first = strands_[static_cast<std::size_t>(left)],
           &second = strands_[static_cast<std::size_t>(right)];
    (begins ? first.points.front() : first.points.back()).kind = CurvePoint::Kind::tip;
    if (begins) {
      second.points.erase(second.points.begin());
      first.begin_link = right;
      second.begin_link = left;
    } else {
      second.points.pop_back();
      first.end_link = right;
      second.end_link = left;
    }
  }
}

/// Pairs of a system that are in one of the slices only as they are too thin to show in the other.
bool CurveTracer::change_thin_pairs(const Slice& a, const Slice& b) {
  const TongueLine &along = source_.along(), &over = source_.over();
  const bool from_rest = a.over == over.from && !source_.scene().linear->has_damping();
  const double thin = from_rest ? options_.chord * (along.to - along.from) : kThin * source_.thinnest();
  if (const auto pairs = thin_pairs(a, b, thin)) {
    for (const std::size_t pair : *pairs) {
      const auto place = active_.begin() + static_cast<std::ptrdiff_t>(pair);
      active_.erase(place, place + 2);
    }
    append(b);
    return true;
  }
  const auto pairs = thin_pairs(b, a, thin);
  if (!pairs) return false;
  std::vector<Slice> without{b};  // b as each pair is taken out
  for (const std::size_t pair : *pairs) without.push_back(without_pair(without.back(), pair));
  for (std::size_t i = pairs->size(); i-- > 0;) begin_thin_pair(without[i], (*pairs)[i]);
  append(b);
  return true;
}

/// New strands for a pair, from its resonance at the beginning of the window if there is no excitation there.
void CurveTracer::begin_thin_pair(const Slice& b, std::size_t pair) {
  const TongueLine &along = source_.along(), &over = source_.over();
  const TongueEdge& low = b.edges[pair].edge;
  const int left = open(), right = open();
  active_.insert(active_.begin() + static_cast<std::ptrdiff_t>(pair), {left, right});
  Scene rest = source_.scene();
  parameter(rest, over.parameter) = over.from;
  const auto at = resting_resonance(rest, along, low.mechanism,
                                    std::midpoint(low.position, b.edges[pair + 1].edge.position),
                                    kShift * options_.chord * (along.to - along.from));
  if (!at) return;
  CurvePoint tip = point_of(b.edges[pair].edge, over.from);
  tip.kind = CurvePoint::Kind::tip;
  tip.along = at->position;
  tip.error = at->error / std::max(1.0, std::abs(at->position));
  tip.outcome = tip.error <= options_.tolerance ? Outcome::converged : Outcome::tolerance_not_reached;
  Strand &first = strands_[static_cast<std::size_t>(left)],
         &second = strands_[static_cast<std::size_t>(right)];
  first.points = {tip};
  first.begin_link = right;
  second.begin_link = left;
}

}  // namespace strutt
