#include "chart/damped_line.hpp"

#include <cmath>
#include <variant>

#include "base/constants.hpp"
#include "chart/unstable_intervals.hpp"
#include "strutt/base/error.hpp"

namespace strutt {
namespace {

std::string damping_path(const Scene& scene) {
  if (scene.mathieu) return "mathieu.damping";
  if (scene.hill) return "hill.damping";
  if (scene.pendulum) return "pendulum.damping";
  throw InvalidInput("the damping that closes a tongue", "[linear]", "[pendulum], [mathieu] or [hill]");
}

}  // namespace

DampedLine::DampedLine(const Scene& scene, const std::string& path)
    : scene_(scene), value_(&parameter(scene_, path)), damping_(&parameter(scene_, damping_path(scene))) {
  require(value_ != damping_, path, *value_, "another parameter than the damping");
  *damping_ = 0.0;
}

Stability DampedLine::at(double p, double damping) {
  *value_ = p;
  *damping_ = damping;
  const auto result = analyse(engine_, linear_model(scene_), sharpest(), {.verdict = false});
  *damping_ = 0.0;
  return result;
}

double DampedLine::rate_of(double growth, double p) {
  *value_ = p;
  return 2.0 * growth / std::get<HillEquation>(linear_model(scene_)).period();
}

double DampedLine::error(double p, double damping) {
  const double step = 1e-4 * damping;
  const double slope = (at(p, damping + step).margin - at(p, damping - step).margin) / (2.0 * step);
  const Stability s = at(p, damping);
  return (std::abs(s.margin) + s.margin_error) / std::abs(slope) / damping + 4.0 * kUnit;
}

}  // namespace strutt
