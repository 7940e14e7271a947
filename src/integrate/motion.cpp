#include "strutt/integrate/motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "base/constants.hpp"
#include "integrate/motion_equation.hpp"
#include "integrate/motion_pass.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"

namespace strutt {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

constexpr double kTightest = 1e-14;
constexpr double kLoosest = 1e-4;
constexpr int kPasses = 6;

/// The local tolerance for the next pass, 0 when another one is of no use.
double tightened(double local, double tolerance, const std::vector<MotionPoint>& points) {
  double worst = 0.0;
  for (const auto& point : points) {
    if (std::isfinite(point.error)) worst = std::max(worst, point.error);
  }
  const bool all_finite =
      std::all_of(points.begin(), points.end(), [](const auto& p) { return std::isfinite(p.error); });
  if ((all_finite && worst <= tolerance) || local <= kTightest) return 0.0;
  const double factor = worst > tolerance ? 0.3 * tolerance / worst : 1e-3;
  return std::max(local * std::clamp(factor, 1e-4, 0.3), kTightest);
}

}  // namespace

void MotionOptions::validate() const {
  require(tolerance >= 1e-13 && tolerance <= 1e-2, "tolerance", tolerance, "between 1e-13 and 1e-2");
  require(max_steps >= 1, "max_steps", static_cast<double>(max_steps), "at least 1");
  if (method != Method::automatic && method != Method::arkode && method != Method::cvode) {
    throw InvalidInput("method", to_string(method), "one of auto, arkode, cvode for a motion");
  }
}

Motion integrate_motion(const PhysicalPendulum& pendulum, const Excitation* support, const Excitation* moment,
                        const MotionStart& start, std::span<const double> times,
                        const MotionOptions& options) {
  const DefaultFloatingPoint environment;
  options.validate();
  require(std::abs(start.angle) <= 1e9, "angle", start.angle, "between -1e9 and 1e9 rad");
  require(std::isfinite(start.velocity), "velocity", start.velocity, "finite");
  for (const double t : times) require(t >= 0.0 && std::isfinite(t), "t", t, "a finite number >= 0");

  const detail::MotionEquation equation(pendulum, support, moment, options.linear);
  Motion motion;
  motion.method = options.method == Method::cvode ? Method::cvode : Method::arkode;
  motion.points.reserve(times.size());
  for (const double t : times) motion.points.push_back({t, kNan, kNan, kNan, kInfinity, Outcome::failed});
  std::vector<std::size_t> order(times.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return times[a] < times[b]; });

  double local = std::clamp(options.tolerance / 100.0, kTightest * 10.0, kLoosest);
  for (int pass = 0; pass < kPasses && local > 0.0; ++pass) {
    detail::MotionPass run(equation, options, pendulum.alpha(), local);
    const long left = options.max_steps - motion.cost.steps - motion.estimate_cost.steps;
    const Outcome outcome = run.run(start, order, motion.points, left);
    motion.cost += run.cost();
    motion.estimate_cost += run.estimate_cost();
    if (outcome != Outcome::converged) {
      for (auto& point : motion.points) {
        if (std::isnan(point.angle)) point.outcome = outcome;
      }
      motion.cancelled = outcome == Outcome::cancelled;
      break;
    }
    local = tightened(local, options.tolerance, motion.points);
  }
  return motion;
}

}  // namespace strutt
