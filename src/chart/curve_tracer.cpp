#include "chart/curve_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace strutt {
namespace {

constexpr int kMostHalvings = 18;  // halvings of a step for a chord
constexpr double kBroughtTogether =
    0x1p-12;                          // of the range: where two slices differ, they are brought so close
constexpr double kSteepSlope = 4.0;   // of the window
constexpr double kSteep = 0x1p-40;    // the same if an edge leaves the window steeply
constexpr double kSeveral = 0x1p-20;  // the same where several things happen at once: curves end there

/// The pair of neighbours of different kind without which `longer` looks like `shorter`, the closest of them.
std::optional<std::size_t> extra_pair(const Slice& longer, const Slice& shorter) {
  if (longer.edges.size() != shorter.edges.size() + 2) return std::nullopt;
  std::optional<std::size_t> best;
  const auto distance = [&](std::size_t i) {
    return std::abs(longer.edges[i + 1].edge.position - longer.edges[i].edge.position);
  };
  for (std::size_t i = 0; i + 1 < longer.edges.size(); ++i) {
    if (longer.edges[i].edge.upper == longer.edges[i + 1].edge.upper) continue;
    if (!same_pattern(without_pair(longer, i), shorter)) continue;
    if (!best || distance(i) < distance(*best)) best = i;
  }
  return best;
}

/// Whether `longer` without its first or last edge looks like `shorter`: 0, its size - 1, or nothing.
std::optional<std::size_t> extra_end(const Slice& longer, const Slice& shorter) {
  if (longer.edges.size() != shorter.edges.size() + 1) return std::nullopt;
  for (const std::size_t i : {std::size_t{0}, longer.edges.size() - 1}) {
    Slice rest = longer;
    rest.edges.erase(rest.edges.begin() + static_cast<std::ptrdiff_t>(i));
    if (same_pattern(rest, shorter)) return i;
  }
  return std::nullopt;
}

}  // namespace

CurvePoint point_of(const TongueEdge& edge, double over) {
  return {.kind = edge.upper ? CurvePoint::Kind::upper : CurvePoint::Kind::lower,
          .along = edge.position,
          .over = over,
          .error = edge.error,
          .mechanism = edge.mechanism,
          .method = edge.method,
          .outcome = edge.outcome};
}

std::vector<TongueCurve> CurveTracer::curves() {
  Slice previous = source_.at(source_.over().from);
  restart(previous);
  turn_at_rest(previous, true);
  for (int j = 1; j <= options_.slices; ++j) {
    if (options_.cancel != nullptr && *options_.cancel) break;
    Slice next = source_.at(source_.over_scale().at(static_cast<double>(j) / options_.slices));
    advance(previous, next, 0);
    previous = std::move(next);
  }
  turn_at_rest(previous, false);
  std::vector<TongueCurve> result;
  for (const bool ends_only : {true, false})  // closed curves have no free end to begin at
    for (std::size_t i = 0; i < strands_.size(); ++i) {
      const bool free = strands_[i].begin_link < 0 || strands_[i].end_link < 0;
      if (!strands_[i].taken && (free || !ends_only)) result.push_back(joined(static_cast<int>(i)));
    }
  std::erase_if(result, [](const TongueCurve& curve) { return curve.points.size() < 2; });
  return result;
}

int CurveTracer::open() {
  strands_.emplace_back();
  return static_cast<int>(strands_.size()) - 1;
}

/// New strands for all edges of a slice.
void CurveTracer::restart(const Slice& slice) {
  active_.clear();
  for (std::size_t i = 0; i < slice.edges.size(); ++i) active_.push_back(open());
  append(slice);
}

void CurveTracer::append(const Slice& slice) {
  for (std::size_t i = 0; i < slice.edges.size(); ++i)
    if (!slice.edges[i].interpolated)
      strands_[static_cast<std::size_t>(active_[i])].points.push_back(
          point_of(slice.edges[i].edge, slice.over));
}

Slice CurveTracer::between(const Slice& a, const Slice& b) {
  return source_.at(source_.over_scale().middle(a.over, b.over));
}

/// Whether an edge goes along much farther than over: what looks straight may hide a corner, where edges grow
/// like the root of the excitation.
bool CurveTracer::steep(const Slice& a, const Slice& b) const {
  const double y = source_.over_scale().share(a.over, b.over);
  for (std::size_t i = 0; i < a.edges.size(); ++i)
    if (std::abs(source_.along_scale().share(a.edges[i].edge.position, b.edges[i].edge.position)) >
        kSteepSlope * y)
      return true;
  return false;
}

/// Every edge in the middle is as close as wanted to the straight piece between its neighbours, in units of
/// the window; beyond an end of it the curve goes on to a corner.
bool CurveTracer::straight(const Slice& a, const Slice& middle, const Slice& b) const {
  if (!same_pattern(a, middle)) return false;
  const WindowScale &along = source_.along_scale(), &over = source_.over_scale();
  for (std::size_t i = 0; i < a.edges.size(); ++i) {
    const double x = along.share(a.edges[i].edge.position, b.edges[i].edge.position);
    const double y = over.share(a.over, b.over);
    const double u = along.share(a.edges[i].edge.position, middle.edges[i].edge.position);
    const double v = over.share(a.over, middle.over);
    const double way = std::clamp((u * x + v * y) / (x * x + y * y), 0.0, 1.0);
    if (!(std::hypot(u - way * x, v - way * y) <= options_.chord)) return false;
  }
  return true;
}

/// From slice a, where the active strands stand, to b.
void CurveTracer::advance(const Slice& a, const Slice& b, int depth) {
  const bool same = same_pattern(a, b);
  const double apart = source_.over_scale().share(a.over, b.over);
  if (!(apart > 0x1p-50)) return same ? append(b) : restart(b);
  if (options_.cancel != nullptr && *options_.cancel) return;
  if (!same && apart <= kBroughtTogether && may_bend(a, b, apart)) return bend(a, b);
  if (same && depth >= kMostHalvings) return append(b);
  const Slice middle = between(a, b);
  if (same && straight(a, middle, b)) {
    if (!steep(a, b)) {
      append(middle);
      return append(b);
    }
    const Slice first = between(a, middle), second = between(middle, b);
    if (straight(a, first, middle) && straight(middle, second, b)) {
      for (const Slice* slice : {&first, &middle, &second, &b}) append(*slice);
      return;
    }
  }
  advance(a, middle, depth + 1);
  advance(middle, b, depth + 1);
}

/// Whether what differs between two slices close together is understood, or they are as close as is worth it.
bool CurveTracer::may_bend(const Slice& a, const Slice& b, double apart) const {
  if (extra_pair(a, b) || extra_pair(b, a)) return true;
  const bool crosses = extra_end(a, b) || extra_end(b, a);
  if (crosses && std::max(border_distance(a), border_distance(b)) < options_.chord) return true;
  if (order_ == kNoOrder) return true;  // a slice of a system is dear
  return apart <= (crosses ? kSteep : kSeveral);
}

/// How far the outermost edges are from the ends of the line, the nearer of both, in units of the window.
double CurveTracer::border_distance(const Slice& slice) const {
  if (slice.edges.empty()) return 0.0;
  const WindowScale& along = source_.along_scale();
  return std::min(along.part(slice.edges.front().edge.position),
                  1.0 - along.part(slice.edges.back().edge.position));
}

/// Two slices close together with different edges: a tip, or an edge that crosses the border.
void CurveTracer::bend(const Slice& a, const Slice& b) {
  if (order_ == kNoOrder && change_thin_pairs(a, b)) return;
  if (const auto pair = extra_pair(b, a)) return turn(a, b, *pair);
  if (const auto pair = extra_pair(a, b)) return turn(a, b, *pair);
  if (const auto entering = extra_end(b, a)) {
    active_.insert(active_.begin() + static_cast<std::ptrdiff_t>(*entering), open());
    return append(b);
  }
  if (const auto leaving = extra_end(a, b)) {
    active_.erase(active_.begin() + static_cast<std::ptrdiff_t>(*leaving));
    return append(b);
  }
  restart(b);
}

/// A pair that is in one of the slices only: through the slice at its tip.
void CurveTracer::turn(const Slice& a, const Slice& b, std::size_t pair) {
  const bool begins = b.edges.size() > a.edges.size();
  const Slice& with = begins ? b : a;
  const CurveTip tip = find_tip(source_, begins ? a.over : b.over, with, pair);
  Slice at_tip = with;  // the other edges hardly move
  at_tip.over = tip.over;
  for (auto& edge : at_tip.edges) edge.interpolated = true;
  at_tip.edges[pair].edge.position = at_tip.edges[pair + 1].edge.position = tip.along;
  CurvePoint point = point_of(with.edges[pair].edge, tip.over);
  point.kind = CurvePoint::Kind::tip;
  point.along = tip.along;
  point.error = tip.error / std::max(1.0, std::abs(tip.over));
  point.outcome = point.error <= options_.tolerance ? Outcome::converged : Outcome::tolerance_not_reached;
  const auto place = active_.begin() + static_cast<std::ptrdiff_t>(pair);
  if (begins) {
    const int left = open(), right = open();
    strands_[static_cast<std::size_t>(left)].points = {point};
    strands_[static_cast<std::size_t>(left)].begin_link = right;
    strands_[static_cast<std::size_t>(right)].begin_link = left;
    active_.insert(place, {left, right});
    return advance(at_tip, b, 0);
  }
  advance(a, at_tip, 0);
  const int left = active_[pair], right = active_[pair + 1];
  strands_[static_cast<std::size_t>(left)].points.push_back(point);
  strands_[static_cast<std::size_t>(left)].end_link = right;
  strands_[static_cast<std::size_t>(right)].end_link = left;
  active_.erase(active_.begin() + static_cast<std::ptrdiff_t>(pair),
                active_.begin() + static_cast<std::ptrdiff_t>(pair) + 2);
  append(b);
}

/// From a free end of a strand to that of the last one joined to it.
TongueCurve CurveTracer::joined(int strand) {
  TongueCurve curve{order_, {}};
  bool forwards = strands_[static_cast<std::size_t>(strand)].begin_link < 0;
  while (strand >= 0 && !strands_[static_cast<std::size_t>(strand)].taken) {
    Strand& part = strands_[static_cast<std::size_t>(strand)];
    part.taken = true;
    if (forwards)
      curve.points.insert(curve.points.end(), part.points.begin(), part.points.end());
    else
      curve.points.insert(curve.points.end(), part.points.rbegin(), part.points.rend());
    strand = forwards ? part.end_link : part.begin_link;
    forwards = !forwards;
  }
  return curve;
}

}  // namespace strutt
