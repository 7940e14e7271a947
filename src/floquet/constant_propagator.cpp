#include "strutt/floquet/constant_propagator.hpp"

#include <cmath>
#include <numbers>

#include "base/constants.hpp"

namespace strutt {
namespace {

using std::numbers::pi;

// Roundings of one entry: argument, function value, two products and a quotient; generously.
constexpr double kEntryError = 12.0 * kUnit;

// Non-zero entries below this may be lost to underflow on the way to a margin: nothing is proved by them.
constexpr double kTiny = 1e-290;

struct CosSin {
  double cosine, sine;
};

/// cos and sin of pi s half_turns with s = sqrt(w): the quarter turns are removed from s half_turns as an
/// unevaluated sum.
CosSin cos_sin(double w, double s, double half_turns) {
  const double s_tail = std::fma(-s, s, w) / (2.0 * s);  // sqrt(w) = s + s_tail to twice the precision
  const double quarters = std::round(2.0 * s * half_turns);
  const double rest = std::fma(s, half_turns, -0.5 * quarters) + s_tail * half_turns;
  const double c = std::cos(pi * rest), z = std::sin(pi * rest);
  switch (static_cast<int>(std::fmod(quarters, 4.0))) {
    case 0:
      return {c, z};
    case 1:
      return {-z, c};
    case 2:
      return {-c, -z};
    default:
      return {z, -c};
  }
}

BoundedMatrix2 oscillating(double w, double half_turns, double kappa) {
  const double s = std::sqrt(w);
  const auto [c, z] = cos_sin(w, s, half_turns);
  BoundedMatrix2 result = BoundedMatrix2::identity(2);
  result.value.mantissa << c, kappa * z / s, -s * z / kappa, c;
  return result;
}

/// e^x = factor * 2^exponent with factor near 1; the exponent takes out all but ln 2 of x.
BoundedMatrix2 growing(double w, double half_turns, double kappa) {
  const double s = std::sqrt(-w);
  const double x = s * pi * half_turns;
  const double decay = std::exp(-2.0 * x);
  BoundedMatrix2 result = BoundedMatrix2::identity(2);
  const double exponent = std::floor(x / std::numbers::ln2);
  const double factor = std::exp(x - exponent * std::numbers::ln2);
  const double c = 0.5 * factor * (1.0 + decay), z = -0.5 * factor * std::expm1(-2.0 * x);
  result.value.mantissa << c, kappa * z / s, s * z / kappa, c;
  result.value.exponent = static_cast<long>(exponent);
  result.error = (3.0 * kUnit * x) * result.value.mantissa.cwiseAbs();  // of x itself, and of its reduction
  return result;
}

/// Adds the effect of an error of w: dPhi/dw = -integral Phi(L, t) [0 0; 1/kappa 0] Phi(t, 0) dt, bounded
/// entry by entry.
void add_coefficient_error(BoundedMatrix2& result, double w, double length, double kappa,
                           double absolute_error) {
  if (absolute_error == 0.0) return;
  const double s = std::sqrt(std::abs(w));
  const double reach = s * length > 1.0 ? 1.0 / s : length;  // the size of Y started with slope 1
  const double phase = absolute_error * reach * length;
  const auto& m = result.value.mantissa;
  const double size = m.cwiseAbs().maxCoeff();
  Eigen::Matrix2d effect;
  effect << 1.0, kappa * reach, std::max(s, 1.0 / length) / kappa, 1.0;
  const bool grows = w < 0.0;
  result.error += phase * (grows ? Eigen::Matrix2d(Eigen::Matrix2d::Constant(size)) : effect);
}

}  // namespace

BoundedMatrix2 constant_propagator(double w, double half_turns, double kappa, double coefficient_error) {
  const double length = pi * half_turns;
  BoundedMatrix2 result = BoundedMatrix2::identity(2);
  if (w > 0.0) {
    result = oscillating(w, half_turns, kappa);
  } else if (w < 0.0) {
    result = growing(w, half_turns, kappa);
  } else {
    result.value.mantissa(0, 1) = kappa * length;
  }
  result.error += result.value.mantissa.unaryExpr(
      [](double x) { return kEntryError * std::abs(x) + (x != 0.0 && std::abs(x) < kTiny ? kTiny : 0.0); });
  if (w == 0.0) result.error(0, 0) = result.error(1, 1) = 0.0;
  add_coefficient_error(result, w, length, kappa, coefficient_error);
  result.normalise();
  return result;
}

}  // namespace strutt
