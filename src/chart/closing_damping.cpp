#include "strutt/chart/closing_damping.hpp"

#include <cmath>
#include <string>

#include "base/bracketed_zero.hpp"
#include "base/constants.hpp"
#include "base/minimum.hpp"
#include "chart/unstable_intervals.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"

namespace strutt {
namespace {

constexpr double kNarrowTongue = 1e-9;  // relative to the position: below, the growth of the middle says it
constexpr double kNarrowError = 1e-7;   // of that, relative: at most about the width in the mean

std::string damping_path(const Scene& scene) {
  if (scene.mathieu) return "mathieu.damping";
  if (scene.hill) return "hill.damping";
  if (scene.pendulum) return "pendulum.damping";
  throw InvalidInput("the damping that closes a tongue", "[linear]", "[pendulum], [mathieu] or [hill]");
}

/// The scene with one parameter and the damping to be set.
class DampedLine {
 public:
  DampedLine(const Scene& scene, const std::string& path)
      : scene_(scene), value_(&parameter(scene_, path)), damping_(&parameter(scene_, damping_path(scene))) {
    require(value_ != damping_, path, *value_, "another parameter than the damping");
    *damping_ = 0.0;
  }
  DampedLine(const DampedLine&) = delete;

  const Scene& undamped() const { return scene_; }

  Stability at(double p, double damping) {
    *value_ = p;
    *damping_ = damping;
    const auto result = analyse(engine_, linear_model(scene_), sharpest(),
                                {.verdict = false, .winding = false, .matrix = false});
    *damping_ = 0.0;
    return result;
  }

  double rate_of(double growth, double p) {
    *value_ = p;
    return 2.0 * growth / std::get<HillEquation>(linear_model(scene_)).period();
  }

  /// The damping that makes a point marginal, 0 where it is stable without.
  double marginal(double p) {
    const Stability undamped = at(p, 0.0);
    if (!(undamped.margin < 0.0)) return 0.0;
    double high = rate_of(undamped.growth, p);  // damping also shifts the mean: a little more may be needed
    const auto margin = [&](double c) { return at(p, c).margin; };
    for (int doubling = 0; margin(high) < 0.0; ++doubling) {
      if (doubling == 60) return HUGE_VAL;
      high *= 1.5;
    }
    const double at_high = margin(high);
    if (at_high == 0.0) return high;
    return bracketed_zero(margin, 0.0, high, undamped.margin, at_high, are_close).middle();
  }

  /// What the error of the margin is in damping, relative.
  double error(double p, double damping) {
    const double step = 1e-4 * damping;
    const double slope = (at(p, damping + step).margin - at(p, damping - step).margin) / (2.0 * step);
    const Stability s = at(p, damping);
    return (std::abs(s.margin) + s.margin_error) / std::abs(slope) / damping + 4.0 * kUnit;
  }

 private:
  MonodromyEngine engine_;
  Scene scene_;
  double *value_, *damping_;
};

ClosingDamping wide(DampedLine& line, ClosingDamping result, double from, double to) {
  const auto [place, negative] = least_between([&](double x) { return -line.marginal(x); }, from, to, 28);
  result.position = place;
  result.damping = -negative;
  result.error =
      line.error(result.position, result.damping) + 0x1p-50;  // and what is left of the maximum: (2^-26)^2
  return result;
}

}  // namespace

std::vector<ClosingDamping> closing_damping(const Scene& scene, const TongueLine& line,
                                            const TongueOptions& options) {
  const DefaultFloatingPoint environment;
  DampedLine damped(scene, line.parameter);
  TongueOptions asked = options;
  asked.growth = true;
  std::vector<ClosingDamping> result;
  const auto edges = tongues(Scene(damped.undamped()), line, asked);
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const TongueEdge &low = edges[i], &high = edges[i + 1];
    const bool pair = low.order == high.order && low.crossing == high.crossing && !low.upper && high.upper;
    if (!pair || low.order == 0 || low.width == 0.0 || low.width_relative_error >= 1.0) continue;
    if (options.cancel != nullptr && *options.cancel) break;
    ClosingDamping row{.tongue = low.order, .crossing = low.crossing};
    const double size = std::max(std::abs(low.position), std::abs(high.position));
    if (low.width > kNarrowTongue * size) {
      row = wide(damped, row, low.position, high.position);
    } else {
      row.position = low.growth_position;
      row.damping = damped.rate_of(low.growth, row.position);
      row.error = low.width_relative_error + kNarrowError;
      row.method = Method::fourier;
    }
    if (!(row.error <= std::max(options.tolerance, kNarrowError)))
      row.outcome = Outcome::tolerance_not_reached;
    result.push_back(row);
  }
  return result;
}

}  // namespace strutt
