#include "chart/nearest_point.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "base/bracketed_zero.hpp"
#include "base/constants.hpp"

namespace strutt {
namespace {

constexpr int kRaySteps = 24;
constexpr int kMostTurns = 200, kMostParts = 8;
constexpr double kParallel =
    1e-16;  // squared angle between ray and normal, below which r is right to rounding
constexpr double kHopeless = 30.0;     // times the squared angle: a ray becomes no shorter by more, of itself
constexpr int kDirections = 512;       // spread over the sphere,
constexpr std::size_t kDescents = 12;  // of which so many are followed
constexpr double kApartCosine = 0.9;   // if they are so far from each other
constexpr int kMostSphereTurns = 20;

double squared_angle(const SpherePoint& ray) {
  return ray.gradient.size() == 0 ? 1.0 : std::min(1.0, ray.gradient.squaredNorm() / (ray.value * ray.value));
}

/// Both ways along each axis, and pseudo-random directions: the generator's raw bits by Box and Muller's
/// formula, since distributions differ between libraries.
std::vector<Eigen::VectorXd> spread_directions(Eigen::Index size) {
  std::vector<Eigen::VectorXd> result;
  for (Eigen::Index i = 0; i < size; ++i)
    for (const double side : {-1.0, 1.0}) result.emplace_back(side * Eigen::VectorXd::Unit(size, i));
  std::mt19937_64 random(1);
  const auto uniform = [&random] { return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53; };
  for (int k = 0; k < kDirections; ++k) {
    Eigen::VectorXd direction(size);
    for (double& x : direction) {
      const double radius = std::sqrt(-2.0 * std::log(uniform()));
      x = radius * std::cos(2.0 * std::numbers::pi * uniform());
    }
    result.push_back(direction.normalized());
  }
  return result;
}

}  // namespace

double NearestPoint::error(const SpherePoint& ray) { return ray.error + ray.value * squared_angle(ray); }

std::optional<SpherePoint> NearestPoint::shortest(const Eigen::VectorXd& direction, double most,
                                                  double known) {
  const auto done = [&](const SpherePoint& best) {
    const double left = squared_angle(best);
    return left < kParallel || best.value * (1.0 - kHopeless * left) > known || cancelled();
  };
  std::optional<SpherePoint> result;
  auto ray = first(direction, most);
  for (int part = 0; part < kMostParts && ray && !cancelled(); ++part) {
    result = descend(
        *ray, 1.0 / ray->value, kMostTurns,
        [&](const Eigen::VectorXd& turned, const SpherePoint& best) { return next_to(turned, best); }, done);
    // the ray may have met another part of the surface before
    ray = first(result->direction, result->value - 2.0 * error(*result));
  }
  return result;
}

/// The first point of the surface on a ray, as far as some steps show.
std::optional<SpherePoint> NearestPoint::first(const Eigen::VectorXd& direction, double most) {
  if (!(most > 0.0)) return std::nullopt;
  double before = 0.0;
  for (int i = 1; i <= kRaySteps; ++i) {
    const double length = most * i / kRaySteps, f = value(direction, length);
    if (std::isnan(f)) break;  // no such scene from here on
    if (f <= 0.0) return solved(direction, before, length, most);
    before = length;
  }
  return std::nullopt;
}

/// Where a ray meets the surface next to the end of another one, from where its tangent plane does.
std::optional<SpherePoint> NearestPoint::next_to(const Eigen::VectorXd& direction, const SpherePoint& best) {
  const double slope = (best.direction - best.gradient / best.value).dot(direction);
  if (!(slope > 0.0)) return std::nullopt;
  const double most = 1.01 * best.value, guess = std::min(best.value / slope, most);
  const double at_guess = value(direction, guess);
  if (std::isnan(at_guess)) return std::nullopt;
  const bool inside = at_guess > 0.0;
  double here = guess, step = std::max(std::abs(guess - best.value), 1e-6 * best.value);
  for (; step < most; step *= 2.0) {
    const double there = std::clamp(inside ? guess + step : guess - step, 0.0, most);
    const double f = value(direction, there);
    if (std::isnan(f)) return std::nullopt;
    if ((f > 0.0) != inside)
      return solved(direction, std::min(here, there), std::max(here, there), best.value + best.error);
    if (there == here) return std::nullopt;
    here = there;
  }
  return std::nullopt;
}

std::optional<SpherePoint> NearestPoint::solved(const Eigen::VectorXd& direction, double low, double high,
                                                double most) {
  const auto f = [&](double length) { return value(direction, length); };
  const double at_low = f(low), at_high = f(high);
  ZeroBracket bracket{high, high};
  if (at_high < 0.0 && at_low > 0.0) bracket = bracketed_zero(f, low, high, at_low, at_high, are_close);
  SpherePoint ray{direction, bracket.middle(), 0.0, {}};
  if (!std::isfinite(ray.value)) return std::nullopt;  // there are no systems in between
  ray.error = uncertainty(direction, ray.value, bracket.high - bracket.low);
  if (ray.value > most + ray.error) return std::nullopt;
  const Eigen::VectorXd normal = surface_.normal(point(ray), direction);
  if (normal.size() > 0) ray.gradient = across(direction, -ray.value / normal.dot(direction) * normal);
  if (!ray.gradient.allFinite()) ray.gradient.resize(0);
  return ray;
}

/// What the error of F is in length.
double NearestPoint::uncertainty(const Eigen::VectorXd& direction, double length, double bracket) {
  const double step = 1e-5 * length;
  const double slope =
      std::abs(value(direction, length + step) - value(direction, length - step)) / (2.0 * step);
  const Margin f = surface_.at(centre_ + length * direction);
  const double by_value = slope > 0.0 ? (std::abs(f.value) + f.error) / slope : HUGE_VAL;
  return std::min(by_value, length) * (1.0 + 1e-3) + bracket + 4.0 * kUnit * length;
}

/// F and its gradient by differences.
SpherePoint NearestPoint::on_sphere(const Eigen::VectorXd& direction, double distance) {
  constexpr double kStep = 1e-6;
  SpherePoint result{direction, value(direction, distance), 0.0, direction};
  for (Eigen::Index i = 0; i < direction.size() && !cancelled(); ++i) {
    const Eigen::VectorXd beside =
        (direction + kStep * Eigen::VectorXd::Unit(direction.size(), i)).normalized();
    result.gradient[i] = (value(beside, distance) - result.value) / kStep;
  }
  result.gradient = across(direction, result.gradient);
  if (!result.gradient.allFinite()) result.gradient.resize(0);
  return result;
}

std::optional<Eigen::VectorXd> NearestPoint::outside(double distance) {
  struct Start {
    double value;
    Eigen::VectorXd direction;
  };
  std::vector<Start> starts;
  for (const auto& direction : spread_directions(centre_.size())) {
    if (cancelled()) return std::nullopt;
    const double f = value(direction, distance);
    if (f <= 0.0) return direction;
    if (!std::isnan(f)) starts.push_back({f, direction});
  }
  std::ranges::sort(starts, {}, &Start::value);
  std::vector<Eigen::VectorXd> followed;
  for (const Start& candidate : starts) {
    const auto near = [&](const Eigen::VectorXd& other) {
      return other.dot(candidate.direction) > kApartCosine;
    };
    if (followed.size() == kDescents || cancelled()) break;
    if (std::ranges::any_of(followed, near)) continue;
    followed.push_back(candidate.direction);
    const SpherePoint start = on_sphere(candidate.direction, distance);
    const double slope = start.gradient.norm();
    const SpherePoint least = descend(
        start, slope > 0.0 ? 0.2 / slope : 1.0, kMostSphereTurns,
        [&](const Eigen::VectorXd& turned, const SpherePoint&) {
          return std::optional(on_sphere(turned, distance));
        },
        [&](const SpherePoint& best) { return best.value <= 0.0 || cancelled(); });
    if (least.value <= 0.0) return least.direction;
  }
  return std::nullopt;
}

}  // namespace strutt
