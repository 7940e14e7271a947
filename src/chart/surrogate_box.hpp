#pragma once

#include <functional>
#include <vector>

#include "chart/half_period_model.hpp"
#include "strutt/chart/surrogate.hpp"

namespace strutt {

/// The scaled state's factors at a point: those of the box brought to the kappa of the point, with their
/// bounds.
struct PointFactors {
  std::array<double, 4> value{};
  std::array<double, 4> error{};
};
PointFactors at_kappa(const std::array<double, 4>& value, const std::array<double, 4>& error, double ratio);

/// Integrates many points: fills result[i] at (x[i], y[i]), axis coordinates. False: cancelled.
using Sampling = std::function<bool(const std::vector<std::array<double, 2>>& points,
                                    std::vector<HalfPeriodSample>& result)>;

/// What to do with a box.
enum class BoxOutcome { interpolated, split_x, split_y, given_up, cancelled };

struct BoxBuild {
  BoxOutcome outcome = BoxOutcome::given_up;
  std::size_t nodes = 0;
  long right_hand_sides = 0;
};

/// Raises the degree of `box` (its ends are given) until the error fits, and fills it; or says how to split
/// it. `coordinate_error`: bound of the absolute rounding of a coordinate, per axis. Where nodes would be
/// more than `affordable` the box is given up.
BoxBuild build_box(SurrogateBox& box, const Sampling& sampling, const std::array<double, 2>& coordinate_error,
                   double tolerance, double affordable);

/// The four factors at a point in axis coordinates.
std::array<double, 4> evaluate(const SurrogateBox& box, double x, double y);

}  // namespace strutt
