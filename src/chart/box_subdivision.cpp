#include "chart/box_subdivision.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include "base/constants.hpp"

namespace strutt {
namespace {

constexpr double kShareOfCells =
    0.25;                        // the nodes of all boxes, tried ones included, as a share of the cells
constexpr int kDeepestBox = 24;  // halvings from the whole chart to a box
constexpr std::size_t kMostBoxes = 4096;

double parameter_value(const Axis& axis, double coordinate) {
  return axis.scale == AxisScale::linear ? coordinate : std::copysign(std::exp(coordinate), axis.from);
}

double coordinate_error(const Axis& axis) {
  const double largest = std::max(std::abs(Surrogate::coordinate(axis, axis.from)),
                                  std::abs(Surrogate::coordinate(axis, axis.to)));
  return axis.scale == AxisScale::linear ? kUnit * largest : 4.0 * kUnit * (1.0 + largest);
}

std::array<SurrogateBox, 2> halves(const SurrogateBox& box, std::size_t axis) {
  SurrogateBox first, second;
  first.low = second.low = box.low;
  first.high = second.high = box.high;
  first.high[axis] = second.low[axis] = 0.5 * (box.low[axis] + box.high[axis]);
  return {first, second};
}

struct Pending {
  SurrogateBox box;
  int depth;
};

}  // namespace

SurrogateBox whole_box(const Axis& x, const Axis& y) {
  SurrogateBox whole;
  for (const std::size_t i : {0, 1}) {
    const Axis& axis = i == 0 ? x : y;
    const double from = Surrogate::coordinate(axis, axis.from), to = Surrogate::coordinate(axis, axis.to);
    whole.low[i] = std::min(from, to);
    whole.high[i] = std::max(from, to);
  }
  return whole;
}

std::array<double, 2> coordinate_errors(const Axis& x, const Axis& y) {
  return {coordinate_error(x), coordinate_error(y)};
}

std::vector<std::array<double, 2>> parameter_values(const Axis& x, const Axis& y,
                                                    const std::vector<std::array<double, 2>>& points) {
  std::vector<std::array<double, 2>> values;
  for (const auto& p : points) values.push_back({parameter_value(x, p[0]), parameter_value(y, p[1])});
  return values;
}

double cells_in(const SurrogateBox& box, const Axis& x, const Axis& y) {
  const auto whole = whole_box(x, y);
  const auto share = [&](std::size_t axis) {
    return (box.high[axis] - box.low[axis]) / (whole.high[axis] - whole.low[axis]);
  };
  return static_cast<double>(x.points) * share(0) * static_cast<double>(y.points) * share(1);
}

bool subdivide(const Axis& x, const Axis& y, const BoxAttempt& attempt, const BoxReceiver& receive) {
  const auto whole = whole_box(x, y);
  const double budget = kShareOfCells * cells_in(whole, x, y);
  double nodes = 0.0;
  std::size_t received = 0;
  std::deque<Pending> pending{{whole, 0}};
  while (!pending.empty()) {
    auto [box, depth] = std::move(pending.front());
    pending.pop_front();
    const auto build = attempt(box, std::min(cells_in(box, x, y), budget - nodes));
    nodes += static_cast<double>(build.nodes);
    if (build.outcome == BoxOutcome::cancelled) return false;
    const bool split = build.outcome == BoxOutcome::split_x || build.outcome == BoxOutcome::split_y;
    if (split && depth < kDeepestBox && received + pending.size() < kMostBoxes) {
      for (auto& half : halves(box, build.outcome == BoxOutcome::split_x ? 0 : 1))
        pending.push_back({std::move(half), depth + 1});
      continue;
    }
    ++received;
    receive(std::move(box), build.outcome);
  }
  return true;
}

}  // namespace strutt
