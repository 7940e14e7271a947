#include "floquet/square_wave.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/bracketed_zero.hpp"
#include "base/constants.hpp"
#include "strutt/base/bounded_matrix.hpp"
#include "strutt/floquet/constant_propagator.hpp"

namespace strutt {
namespace {

using std::numbers::pi;

/// Pruefer's angle psi, X = r sin psi, X' = r cos psi, after a quarter of the period with the coefficient w.
double turned(double psi, double w) {
  constexpr double kLength = 0.5 * pi;
  const auto unwrapped = [](double y, double v, double near) {
    const double angle = std::atan2(y, v);
    return angle + 2.0 * pi * std::round((near - angle) / (2.0 * pi));
  };
  const double y = std::sin(psi), v = std::cos(psi), s = std::sqrt(std::abs(w));
  if (w > 0.0) {  // the angle of (s X, X') turns evenly
    const double after = unwrapped(s * y, v, psi) + s * kLength;
    return unwrapped(std::sin(after) / s, std::cos(after), after);
  }
  // between the two solutions exp(+-s theta), which do not turn: by less than half a turn
  const double t = s > 0.0 ? std::tanh(s * kLength) / s : kLength;
  return unwrapped(y + v * t, v - w * t * y, psi);
}

/// A factor of the propagator over half a period, entry (row, column), and the angle at which it is zero.
struct EdgeCondition {
  int row, column;
  double start, target;
};

class SquareWaveEdge {
 public:
  SquareWaveEdge(double amplitude, const EdgeCondition& condition)
      : amplitude_(amplitude), condition_(condition) {}

  /// |edge - n^2/4| <= A.
  CharacteristicValue value(int order) const {
    const double square = 0.25 * order * order, reach = amplitude_ + 1e-9 * (1.0 + square);
    const double low = square - reach, high = square + reach;
    const double x = bracketed_zero([this](double mean) { return beyond(mean); }, low, high, beyond(low),
                                    beyond(high), are_neighbours, 200)
                         .middle();
    const double size = std::abs(x) + amplitude_;
    for (double distance = 2.0 * kUnit * size; distance < size; distance *= 2.0) {
      const int below = sign(x - distance), above = sign(x + distance);
      if (below * above < 0) return {x, distance * (1.0 + 4.0 * kUnit)};
    }
    return {x, amplitude_};
  }

 private:
  double beyond(double mean) const {
    return turned(turned(condition_.start, mean + amplitude_), mean - amplitude_) - condition_.target;
  }

  /// Of the factor, 0 where its bound does not tell.
  int sign(double mean) const {
    const auto piece = [](double w) { return constant_propagator(w, 0.5, 1.0, kUnit * std::abs(w)); };
    const auto half =
        ordered_product<Eigen::Matrix2d>({piece(mean + amplitude_), piece(mean - amplitude_)}, 2);
    const double value = half.value.mantissa(condition_.row, condition_.column);
    if (!(std::abs(value) > half.error(condition_.row, condition_.column))) return 0;
    return value > 0.0 ? 1 : -1;
  }

  double amplitude_;
  EdgeCondition condition_;
};

/// With a solution that is even about the middle of the first piece; n even: with the period of the wave.
CharacteristicValue even_edge(double amplitude, int order) {
  const int half = order / 2;
  const EdgeCondition condition = order % 2 == 0 ? EdgeCondition{1, 0, 0.5 * pi, 0.5 * pi + half * pi}
                                                 : EdgeCondition{0, 0, 0.5 * pi, (half + 1) * pi};
  return SquareWaveEdge(amplitude, condition).value(order);
}

CharacteristicValue odd_edge(double amplitude, int order) {
  const int half = order / 2;
  const EdgeCondition condition =
      order % 2 == 0 ? EdgeCondition{0, 1, 0.0, half * pi} : EdgeCondition{1, 1, 0.0, 0.5 * pi + half * pi};
  return SquareWaveEdge(amplitude, condition).value(order);
}

/// What the closed form of an edge is made of, with s1, s2 > 0.
struct Phases {
  double s1, s2, difference, kappa;

  Phases(double mean, double amplitude)
      : s1(std::sqrt(mean + amplitude)),
        s2(std::sqrt(mean - amplitude)),
        difference(pi * amplitude / (s1 + s2)),
        kappa(2.0 * amplitude / ((s1 + s2) * (s1 + s2))) {}
  double wave(bool even) const { return even ? std::sin(difference) : std::cos(difference); }
  double wave_slope(bool even) const { return even ? std::cos(difference) : std::sin(difference); }
};

/// arcsin(kappa wave) with the error from those of the mean and the amplitude and from rounding.
CharacteristicValue phase_to_edge(const Phases& p, bool even, double error, double amplitude_error) {
  const double sine = p.kappa * p.wave(even), product = p.s1 * p.s2;
  // d(s1 + s2)/dA = (s2 - s1)/(2 s1 s2), in units of (s1 + s2)/A at most (s1/s2)^2
  const double by_amplitude = amplitude_error * (1.0 + p.s1 * p.s1 / (p.s2 * p.s2));
  const double shift =
      p.difference * (0.5 * error / product + 4.0 * kUnit + by_amplitude);  // of the difference
  const double change = p.kappa * std::abs(p.wave_slope(even)) * shift +
                        std::abs(sine) * (error / product + 8.0 * kUnit + 2.0 * by_amplitude) +
                        kUnit * shift * p.kappa;
  return {std::asin(sine), change / std::sqrt(1.0 - sine * sine) + 4.0 * kUnit * std::abs(sine)};
}

TongueWidth from_interval(double value, double error) {
  if (value > error) return {value, error / value};
  return {0.5 * (std::max(value, 0.0) + error), 1.0};
}

}  // namespace

bool is_square_wave(const PeriodicFunction& v) { return v.is_piecewise_constant() && !v.is_constant(); }

TongueEdges square_wave_tongue(double amplitude, int order) {
  const CharacteristicValue even = even_edge(amplitude, order);
  if (order == 0) return {order, std::nullopt, even};
  const CharacteristicValue odd = odd_edge(amplitude, order);
  if (even.value < odd.value) return {order, even, odd};
  return {order, odd, even};
}

std::optional<bool> square_wave_upper_is_even(double amplitude, const TongueEdges& edges) {
  if (!edges.lower) return true;
  if (edges.lower->value == edges.upper.value) return std::nullopt;
  return even_edge(amplitude, edges.order).value == edges.upper.value;
}

TongueWidth square_wave_width(double amplitude, const TongueEdges& edges, double amplitude_error) {
  const auto &low = *edges.lower, &high = edges.upper;
  const double difference = high.value - low.value;
  const TongueWidth direct = from_interval(
      difference, low.error + high.error + 2.0 * amplitude_error * amplitude + kUnit * std::abs(difference));
  if (!(low.value - amplitude > 1e-3 * amplitude + 1e6 * low.error)) return direct;
  const bool even = edges.order % 2 == 0;
  const Phases below(low.value, amplitude), above(high.value, amplitude);
  const auto one = phase_to_edge(below, even, low.error, amplitude_error),
             two = phase_to_edge(above, even, high.error, amplitude_error);
  const double slope = 0.5 * pi * (1.0 / (below.s1 + above.s1) + 1.0 / (below.s2 + above.s2));
  const double width = std::abs(one.value + two.value) / slope;
  const double relative = 8.0 * kUnit + (low.error + high.error + 2.0 * amplitude_error * amplitude) /
                                            (below.s2 * below.s2);  // of the slope
  const TongueWidth own = from_interval(width, (one.error + two.error) / slope + relative * width);
  return own.relative_error <= direct.relative_error ? own : direct;
}

double square_wave_growth(double amplitude, const TongueEdges& edges) {
  const Phases middle(std::midpoint(edges.lower->value, edges.upper.value), amplitude);
  const double wave = std::abs(middle.wave(edges.order % 2 == 0));
  return 2.0 * std::asinh(amplitude * wave / ((middle.s1 + middle.s2) * std::sqrt(middle.s1 * middle.s2)));
}

}  // namespace strutt
