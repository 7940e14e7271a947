#include "strutt/free_pendulum/phase_portrait.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "free_pendulum/arc_length.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"

namespace strutt {
namespace {

using detail::ArcLength;
using std::numbers::pi;

/// A libration by its modulus k = sin(A/2) and k' = cos(A/2).
struct LibrationCurve {
  double modulus;
  double complementary_modulus;
  double excess;  // -4 k'^2
};

LibrationCurve libration_of_amplitude(double amplitude) {
  const double complementary = std::cos(amplitude / 2.0);
  return {std::sin(amplitude / 2.0), complementary, -4.0 * complementary * complementary};
}

LibrationCurve libration_of_excess(double excess) {
  return {std::sqrt(4.0 + excess) / 2.0, std::sqrt(-excess) / 2.0, excess};
}

/// cos(phi/2) of a libration whose auxiliary angle is `s` past the turning point.
double half_angle_cosine(const LibrationCurve& l, double sine) {
  return std::hypot(l.complementary_modulus, l.modulus * sine);
}

/// (phi, phi'/alpha) at the distance s in [0, pi/2] of the auxiliary angle from the turning point.
PhasePoint libration_point(const LibrationCurve& l, double s) {
  const double sine = std::sin(s), cosine = std::cos(s);
  return {2.0 * std::atan2(l.modulus * cosine, half_angle_cosine(l, sine)), 2.0 * l.modulus * sine};
}

/// Steps of a quarter of a closed curve, or of half a period of 2 pi: the latter has twice as many.
int quarter_steps(const PortraitOptions& options) { return (options.points + 2) / 4; }

/// Collects curves in the window. Points of a cell (a period of 2 pi) are computed once and moved.
class Window {
 public:
  explicit Window(const PortraitOptions& options) : options_(options), half_(options.cells) {}

  void add_equilibria();
  void add_separatrix();
  void add_libration(const LibrationCurve& libration);
  void add_rotation(double excess);
  std::vector<PhaseCurve> take() { return std::move(curves_); }

 private:
  PhasePoint moved(double half_turns, PhasePoint p) const {
    return {std::fma(half_turns, pi, p.angle), options_.alpha * p.velocity + 0.0};  // no -0
  }
  /// From the inverted position to the hanging one in steps of equal arc length: distance and phi'/alpha.
  template <typename Velocity, typename Slope>
  std::vector<PhasePoint> half_cell(Velocity velocity, Slope slope, double sharpness) const;
  void add_span(CurveKind kind, double excess, const std::vector<PhasePoint>& half, int from, int to);

  const PortraitOptions& options_;
  int half_;  // the window is |phi| <= half_ pi
  std::vector<PhaseCurve> curves_;
};

void Window::add_equilibria() {
  for (int k = -half_; k <= half_; ++k) {
    const double excess = k % 2 == 0 ? -4.0 : 0.0;
    curves_.push_back({CurveKind::equilibrium, excess, {moved(k, {0.0, 0.0})}});
  }
}

template <typename Velocity, typename Slope>
std::vector<PhasePoint> Window::half_cell(Velocity velocity, Slope slope, double sharpness) const {
  const ArcLength arc([&](double x) { return std::hypot(1.0, slope(x)); }, pi, sharpness);
  const int intervals = 2 * quarter_steps(options_);
  std::vector<PhasePoint> points;
  for (int j = 0; j <= intervals; ++j) {
    const double x = arc.parameter(arc.total() * j / intervals);
    points.push_back({x, velocity(x)});
  }
  return points;
}

/// Both directions, from `from` pi to `to` pi. `half`: distance from the inverted position and velocity.
void Window::add_span(CurveKind kind, double excess, const std::vector<PhasePoint>& half, int from, int to) {
  PhaseCurve forward{kind, excess, {}};
  for (int k = from; k < to; ++k) {
    // From an inverted position (odd k) up to a hanging one the distance grows; then it falls.
    const bool rising = k % 2 != 0;
    for (std::size_t j = k == from ? 0 : 1; j < half.size(); ++j) {
      const PhasePoint& p = rising ? half[j] : half[half.size() - 1 - j];
      forward.points.push_back(rising ? moved(k, p) : moved(k + 1, {-p.angle, p.velocity}));
    }
  }
  PhaseCurve backward{kind, excess, {forward.points.rbegin(), forward.points.rend()}};
  for (auto& p : backward.points) p.velocity = 0.0 - p.velocity;
  curves_.push_back(std::move(forward));
  curves_.push_back(std::move(backward));
}

void Window::add_separatrix() {
  const auto half = half_cell([](double x) { return 2.0 * std::sin(x / 2.0); },
                              [](double x) { return std::cos(x / 2.0); }, pi);
  for (int from = -half_; from < half_;) {
    const int to = std::min(from + (from % 2 != 0 ? 2 : 1), half_);
    add_span(CurveKind::separatrix, 0.0, half, from, to);
    from = to;
  }
}

void Window::add_rotation(double excess) {
  const double least = std::sqrt(excess);  // the velocity when inverted
  const auto velocity = [=](double x) { return std::hypot(least, 2.0 * std::sin(x / 2.0)); };
  const auto slope = [=](double x) { return std::sin(x) / velocity(x); };
  add_span(CurveKind::rotation, excess, half_cell(velocity, slope, least), -half_, half_);
}

void Window::add_libration(const LibrationCurve& l) {
  const auto speed = [&](double s) {  // of (phi, phi'/alpha) with the auxiliary angle
    const double sine = std::sin(s);
    return 2.0 * l.modulus * std::hypot(sine / half_angle_cosine(l, sine), std::cos(s));
  };
  const ArcLength quarter(speed, pi / 2.0, l.complementary_modulus / l.modulus);
  const int intervals = quarter_steps(options_);
  std::vector<PhasePoint> points;  // from the turning point down to the fastest one
  for (int j = 0; j <= intervals; ++j) {
    points.push_back(libration_point(l, quarter.parameter(quarter.total() * j / intervals)));
  }
  points.back().angle = 0.0;

  // Quarters 0 ... 3 in order of time, from the hanging position with positive velocity on.
  const auto add = [&](int centre, int first, int last) {
    PhaseCurve curve{CurveKind::libration, l.excess, {}};
    for (int q = first; q < last; ++q) {
      const double angle_sign = q < 2 ? 1.0 : -1.0, velocity_sign = q == 0 || q == 3 ? 1.0 : -1.0;
      for (std::size_t j = q == first ? 0 : 1; j < points.size(); ++j) {
        const PhasePoint& p = q % 2 == 0 ? points[points.size() - 1 - j] : points[j];
        curve.points.push_back(moved(centre, {angle_sign * p.angle, velocity_sign * p.velocity}));
      }
    }
    curves_.push_back(std::move(curve));
  };
  for (int centre = -half_ + half_ % 2; centre <= half_; centre += 2) {
    add(centre, centre == half_ ? 2 : 0, centre == -half_ ? 2 : 4);
  }
}

}  // namespace

std::string_view to_string(CurveKind kind) {
  switch (kind) {
    case CurveKind::libration:
      return "libration";
    case CurveKind::rotation:
      return "rotation";
    case CurveKind::separatrix:
      return "separatrix";
    case CurveKind::equilibrium:
      return "equilibrium";
    case CurveKind::section:
      break;
  }
  return "section";
}

std::vector<double> PortraitOptions::default_amplitudes() {
  std::vector<double> amplitudes;
  for (int j = 1; j < 8; ++j) amplitudes.push_back(j * pi / 8.0);
  return amplitudes;
}

std::vector<double> PortraitOptions::default_excesses() { return {0.25, 1.0, 2.25}; }

void PortraitOptions::validate() const {
  require(alpha > 0.0 && std::isfinite(alpha), "alpha", alpha, "finite and > 0");
  require(cells >= 1 && cells <= 1000, "cells", cells, "between 1 and 1000");
  require(points >= 9, "points", points, "at least 9");
  for (const double amplitude : amplitudes)
    require(amplitude > 0.0 && amplitude < pi, "amplitude", amplitude, "between 0 and pi, both excluded");
  for (const double excess : excesses) {
    require(excess > -4.0 && excess != 0.0 && std::isfinite(excess), "separatrix excess", excess,
            "finite, > -4 and not 0");
  }
}

std::vector<PhaseCurve> phase_portrait(const PortraitOptions& options) {
  const DefaultFloatingPoint environment;
  options.validate();
  std::vector<LibrationCurve> librations;
  std::vector<double> rotations;
  for (const double amplitude : options.amplitudes) librations.push_back(libration_of_amplitude(amplitude));
  for (const double excess : options.excesses) {
    if (excess < 0.0)
      librations.push_back(libration_of_excess(excess));
    else
      rotations.push_back(excess);
  }
  std::sort(librations.begin(), librations.end(),
            [](const auto& a, const auto& b) { return a.modulus < b.modulus; });
  std::sort(rotations.begin(), rotations.end());

  Window window(options);
  window.add_equilibria();
  window.add_separatrix();
  for (const auto& libration : librations) window.add_libration(libration);
  for (const double excess : rotations) window.add_rotation(excess);
  return window.take();
}

}  // namespace strutt
