#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/constants.hpp"
#include "floquet/hill_sensitivity.hpp"

namespace strutt {
namespace {

/// C = cos(s L), S = sin(s L)/s and their derivatives in w = s^2; entire functions of w.
struct Waves {
  double c, s, dc, ds;
};

/// (x cos x - sin x)/x^3 for x^2 = square and its hyperbolic continuation, by its series: for small x.
double slope_series(double square) {
  double term = -1.0 / 3.0, sum = 0.0;
  for (int k = 1; k <= 12; ++k) {
    sum += term;
    term *= -square * (k + 1) / (k * (2.0 * k + 2.0) * (2.0 * k + 3.0));
  }
  return sum;
}

Waves waves(double w, double length) {
  const double root = std::sqrt(std::abs(w)), x = root * length, square = w * length * length;
  const double c = w < 0.0 ? std::cosh(x) : std::cos(x);
  const double s = x == 0.0 ? length : (w < 0.0 ? std::sinh(x) : std::sin(x)) / root;
  const double ds =
      std::abs(square) < 1.0 ? 0.5 * std::pow(length, 3) * slope_series(square) : 0.5 * (length * c - s) / w;
  return {c, s, -0.5 * length * s, ds};
}

HillVariation piece(double w, double dw, double length) {
  const Waves f = waves(w, length);
  HillVariation result;
  result.outcome = Outcome::converged;
  result.n << f.c, f.s, -w * f.s, f.c;
  result.dn << f.dc, f.ds, -f.s - w * f.ds, f.dc;
  result.dn *= dw;
  // the argument of the waves carries a few roundings, which count x times
  const double x = std::sqrt(std::abs(w)) * length, relative = (8.0 + 4.0 * x) * kUnit;
  const double most = result.n.cwiseAbs().maxCoeff(), most_derivative = result.dn.cwiseAbs().maxCoeff();
  result.n_error.setConstant(relative * most);
  result.dn_error.setConstant(relative * (most_derivative + std::abs(dw) * length * most));
  return result;
}

HillVariation product(const HillVariation& b, const HillVariation& a) {
  HillVariation r;
  r.outcome = Outcome::converged;
  r.n = b.n * a.n;
  r.dn = b.n * a.dn + b.dn * a.n;
  const Eigen::Matrix2d an = a.n.cwiseAbs(), adn = a.dn.cwiseAbs(), bn = b.n.cwiseAbs(),
                        bdn = b.dn.cwiseAbs();
  r.n_error = bn * a.n_error + b.n_error * an + 3.0 * kUnit * (bn * an);
  r.dn_error = bn * a.dn_error + b.n_error * adn + bdn * a.n_error + b.dn_error * an +
               4.0 * kUnit * (bn * adn + bdn * an);
  return r;
}

}  // namespace

HillVariation square_variation(const PeriodicFunction& w, const PeriodicFunction& dw) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  std::vector<double> ends{0.0, kTurn};
  for (const auto* f : {&w, &dw}) std::ranges::copy(f->breakpoints(0.0, kTurn), std::back_inserter(ends));
  std::ranges::sort(ends);
  HillVariation result = piece(0.0, 0.0, 0.0);
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const double length = ends[i] - ends[i - 1], middle = 0.5 * (ends[i] + ends[i - 1]);
    if (length < 1e-14) continue;  // both functions jump here
    result = product(piece(w.piece(middle).mean(), dw.piece(middle).mean(), length), result);
  }
  if (!result.n.allFinite() || !result.dn.allFinite()) result.outcome = Outcome::non_finite;
  return result;
}

}  // namespace strutt
