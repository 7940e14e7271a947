#include "chart/curve_slices.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "chart/system_tongues.hpp"
#include "chart/tongues_of_order.hpp"

namespace strutt {
namespace {

constexpr int kTipSteps = 60;
constexpr double kTipResolution = 0x1p-50;  // of the range, or so much of the tolerance:
constexpr double kFarBelowTolerance = 0x1p-10;
constexpr double kBesideTip = 0.02;  // of the way to it

/// Distance and middle of a pair.
struct TonguePair {
  double over, square, middle, error;  ///< error: of the distance

  TonguePair(const Slice& slice, std::size_t first, double resolution) : over(slice.over) {
    const double low = slice.edges[first].edge.position, high = slice.edges[first + 1].edge.position;
    square = (high - low) * (high - low);
    middle = std::midpoint(low, high);
    error = 2.0 * std::max(slice.edges[first].edge.error, slice.edges[first + 1].edge.error) *
                std::max(1.0, std::abs(middle)) +
            (slice.edges[first].edge.method == Method::propagator ? 0.0 : resolution);
  }
};

}  // namespace

bool same_pattern(const Slice& a, const Slice& b) {
  return std::ranges::equal(
      a.edges, b.edges, {}, [](const auto& e) { return e.edge.upper; },
      [](const auto& e) { return e.edge.upper; });
}

Slice without_pair(Slice slice, std::size_t first) {
  const auto begin = slice.edges.begin() + static_cast<std::ptrdiff_t>(first);
  slice.edges.erase(begin, begin + 2);
  return slice;
}

double SliceSource::thinnest() const {
  constexpr double kThinnest = 1e-6;  // of the line
  return std::max(kThinnest, options_.resolution) * (along_.to - along_.from);
}

Slice SliceSource::at(double over) {
  parameter(scene_, over_.parameter) = over;
  const TongueOptions options{.tolerance = options_.tolerance,
                              .system_steps = options_.system_steps,
                              .resolution = options_.resolution,
                              .widths = false,
                              .cancel = options_.cancel};
  const auto edges = order_ == kNoOrder
                         ? system_tongues(engine_, scene_, along_, options, &evaluations_)
                         : TonguesOfOrder(engine_, scene_, along_, options, &evaluations_).edges(tongue_);
  Slice slice{over, {}};
  for (const TongueEdge& edge : edges) {
    slice.edges.push_back({edge, false});
    const std::size_t last = slice.edges.size() - 1;
    if (order_ == kNoOrder && edge.upper && last > 0 &&
        edge.position - slice.edges[last - 1].edge.position < thinnest())
      slice = without_pair(std::move(slice), last - 1);
  }
  return slice;
}

CurveTip find_tip(SliceSource& source, double none, const Slice& with, std::size_t pair) {
  const double finest = source.resolution() * (source.along().to - source.along().from);
  TonguePair near(with, pair, finest);
  std::optional<TonguePair> far;
  const double resolution = std::max(kTipResolution * (source.over().to - source.over().from),
                                     kFarBelowTolerance * source.tolerance());
  bool inner = true;  // next on the side of the pair
  double tip = std::midpoint(none, near.over);
  for (int step = 0; step < kTipSteps && std::abs(near.over - none) > resolution && !source.cancelled();
       ++step) {
    double next = std::midpoint(none, near.over);
    if (far && far->square > near.square) {
      tip = near.over - near.square * (far->over - near.over) / (far->square - near.square);
      const double beside = tip + (inner ? kBesideTip : -kBesideTip) * (near.over - tip);
      if ((beside - none) * (near.over - beside) > 0.0) next = beside;
      inner = !inner;
    }
    const Slice slice = source.at(next);
    if (same_pattern(slice, with)) {
      far = near;
      near = TonguePair(slice, pair, finest);
    } else {
      none = next;
    }
  }
  tip = std::clamp(tip, std::min(none, near.over), std::max(none, near.over));
  const double slope =
      far && far->over != near.over ? (far->middle - near.middle) / (far->over - near.over) : 0.0;
  // a pair closer than the error of its edges does not show
  const double hidden =
      far ? near.error * near.error * std::abs((far->over - near.over) / (far->square - near.square)) : 0.0;
  return {near.middle + slope * (tip - near.over), tip, std::abs(near.over - none) + hidden};
}

}  // namespace strutt
