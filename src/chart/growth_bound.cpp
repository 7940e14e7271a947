#include "chart/growth_bound.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "chart/unstable_intervals.hpp"
#include "floquet/hill_sensitivity.hpp"

namespace strutt {
namespace {

using std::numbers::pi;

HillEquation equation_of(BoxScene& scene, const std::vector<double>& values) {
  return std::get<HillEquation>(scene.model(values));
}

/// (c/Omega)^2/4, which the mean of W loses.
double shift(const HillEquation& e) { return 0.25 * e.canonical_damping() * e.canonical_damping(); }

/// A bound of |W - W'| without damping, for functions of one form that differ in their coefficients.
double change(const HillEquation& a, const HillEquation& b) {
  const PeriodicFunction &x = a.coefficient, &y = b.coefficient;
  double sum = std::abs(x.mean() - y.mean()) + std::abs(shift(a) - shift(b));
  if (x.harmonics().empty() && y.harmonics().empty()) {  // square waves: halves of one sign agree or oppose
    const double at =
        x.breakpoints(0.0, 2.0 * pi).empty() ? 0.0 : x.breakpoints(0.0, 2.0 * pi).front() + 1e-3;
    return sum + std::abs((x(at) - x.mean()) - (y(at) - y.mean()));
  }
  auto i = x.harmonics().begin(), j = y.harmonics().begin();
  while (i != x.harmonics().end() || j != y.harmonics().end()) {
    const bool one = j == y.harmonics().end() || (i != x.harmonics().end() && i->order < j->order);
    const bool two = i == x.harmonics().end() || (j != y.harmonics().end() && j->order < i->order);
    const Harmonic p = two ? Harmonic{} : *i, q = one ? Harmonic{} : *j;
    sum += std::hypot(p.cosine - q.cosine, p.sine - q.sine);
    if (!two) ++i;
    if (!one) ++j;
  }
  return sum;
}

/// The root of the mean square of W - mean.
double deviation(const PeriodicFunction& w) {
  if (w.harmonics().empty()) return w.deviation();
  double sum = 0.0;
  for (const Harmonic& h : w.harmonics()) sum += 0.5 * (h.cosine * h.cosine + h.sine * h.sine);
  return std::sqrt(sum);
}

/// Integral of |n12| over the period for the monodromy matrix from each phase; infinite where it cannot be
/// told.
double slope_bound(MonodromyEngine& engine, const PeriodicFunction& w) {
  const HillVariation v = hill_variation(engine, w, PeriodicFunction::constant(1.0), {.tolerance = 1e-12});
  const bool known = v.outcome == Outcome::converged || v.outcome == Outcome::tolerance_not_reached;
  if (!known || std::abs(v.exponent) > 40 || v.n.cwiseAbs().maxCoeff() > 1e6) return HUGE_VAL;
  const double size = std::ldexp(1.0, static_cast<int>(v.exponent));
  const Eigen::Matrix2d n = size * v.n, dn = size * v.dn;
  Eigen::Matrix2d inverse;
  inverse << n(1, 1), -n(0, 1), -n(1, 0), n(0, 0);
  const Eigen::Matrix2d gram = inverse * dn;  // [g12, g22; -g11, -g12], g_ij the integrals of u_i u_j
  const double g11 = std::abs(gram(1, 0)), g22 = std::abs(gram(0, 1));
  return std::abs(n(0, 1)) * g11 + std::abs(n(1, 1) - n(0, 0)) * std::sqrt(g11 * g22) +
         std::abs(n(1, 0)) * g22;
}

/// A bound of the growth of Y'' + W' Y = 0 with |W' - W| <= r, D = D(W).
double undamped_bound(double mean, double rms, double log_d, double slope, double r) {
  double best = HUGE_VAL;
  for (const double square : {mean, rms, mean + rms, std::abs(mean) + 0.5 * rms, std::abs(mean), 1.0}) {
    if (!(square > 1e-6)) continue;
    const double kappa = std::sqrt(square), x = 2.0 * pi * r / kappa;
    const double e = pi * (std::abs(square - mean) + rms) / kappa;
    best = std::min(best, e + 0.5 * x);
    if (e > 600.0 || x > 30.0 || log_d > 600.0) continue;
    const double crude = std::exp(e) * std::expm1(x);
    const double sharp = r * slope + std::exp(e) * (x < 1e-4 ? 0.5 * x * x * (1.0 + x) : std::expm1(x) - x);
    const double half = 0.5 * (std::exp(log_d) + std::min(crude, sharp)) * (1.0 + 1e-12);
    best = std::min(best, half <= 1.0 ? 0.0 : std::acosh(half));
  }
  return best;
}

/// Calls body(corner) for every corner of the cell.
template <typename Body>
void for_each_corner(const GrowthCell& cell, const Body& body) {
  const std::size_t d = cell.low.size();
  std::vector<double> corner(d);
  for (std::size_t mask = 0; mask < (std::size_t{1} << d); ++mask) {
    for (std::size_t i = 0; i < d; ++i) corner[i] = (mask >> i & 1) != 0 ? cell.high[i] : cell.low[i];
    body(corner);
  }
}

}  // namespace

std::vector<double> GrowthCell::centre() const {
  std::vector<double> result(low.size());
  for (std::size_t i = 0; i < low.size(); ++i) result[i] = 0.5 * low[i] + 0.5 * high[i];
  return result;
}

BoxScene::BoxScene(const Scene& scene, const std::vector<ParameterRange>& box) : scene_(scene) {
  for (const auto& range : box) values_.push_back(&parameter(scene_, range.parameter));
}

const Scene& BoxScene::at(const std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) *values_[i] = values[i];
  return scene_;
}

Stability BoxScene::stability(const std::vector<double>& values) {
  return analyse(engine_, model(values), {.tolerance = 1e-12},
                 {.verdict = false, .winding = false, .matrix = false});
}

void bound_growth(BoxScene& scene, GrowthCell& cell) {
  const auto centre = cell.centre();
  const HillEquation equation = equation_of(scene, centre);
  double r = 0.0, least_half_damping =
                      HUGE_VAL;  // every coefficient is monotone in each parameter: extreme at corners
  for_each_corner(cell, [&](const std::vector<double>& corner) {
    const HillEquation other = equation_of(scene, corner);
    r = std::max(r, change(equation, other));
    least_half_damping = std::min(least_half_damping, pi * other.canonical_damping());
  });
  double most = -1.0;
  for (std::size_t i = 0; i < centre.size(); ++i) {
    auto end = centre;
    end[i] = cell.high[i];
    const double moved = change(equation, equation_of(scene, end));
    if (moved > most) cell.longest = i;
    most = std::max(most, moved);
  }
  const PeriodicFunction w = equation.coefficient.plus(-shift(equation));
  const HillMonodromy m = scene.engine().compute(equation, {.tolerance = 1e-12});
  const Stability s = assess(equation, m, {.winding = false, .matrix = false});
  cell.found = s.growth;
  const double log_d = discriminant_gap(m).log_abs;
  cell.bound =
      undamped_bound(w.mean(), deviation(w), log_d, slope_bound(scene.engine(), w), r) - least_half_damping;
  if (std::isnan(cell.bound)) cell.bound = HUGE_VAL;
}

}  // namespace strutt
