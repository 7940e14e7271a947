#include "floquet/hill_sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/constants.hpp"
#include "floquet/propagators.hpp"
#include "strutt/floquet/stability.hpp"

namespace strutt {
namespace {

using std::numbers::pi;

constexpr double kLogOfLargeD = 200.0;

/// What a parameter does to Y'' + W Y = 0 and to h = cT/2.
struct UndampedDerivative {
  PeriodicFunction coefficient;
  double half_damping = 0.0;
};

UndampedDerivative undamped(const HillEquation& equation, const HillDerivative& by) {
  const double omega = equation.angular_frequency, c = equation.canonical_damping();
  const double slope = (by.damping - c * by.angular_frequency) / omega;  // of c/Omega
  return {by.coefficient.plus(-0.5 * c * slope), pi * slope};
}

PeriodicMatrix matrix_of(const PeriodicFunction& f) {
  const auto one = [](double x) { return Eigen::MatrixXd::Constant(1, 1, x); };
  PeriodicMatrix result{.mean = one(f.mean()), .harmonics = {}};
  for (const Harmonic& h : f.harmonics()) result.harmonics.push_back({h.order, one(h.cosine), one(h.sine)});
  return result;
}

/// The 2 x 2 blocks of rows and columns (i, i + 2) and (j, j + 2) of the augmented matrix.
Eigen::Matrix2d part(const Eigen::MatrixXd& m, int i, int j) {
  Eigen::Matrix2d result;
  result << m(i, j), m(i, j + 2), m(i + 2, j), m(i + 2, j + 2);
  return result;
}

HillVariation smooth_variation(MonodromyEngine& engine, const PeriodicFunction& w, const PeriodicFunction& dw,
                               const MonodromyOptions& options) {
  LinearPeriodicSystem system;
  system.period = 2.0 * pi;
  system.mass = Eigen::MatrixXd::Identity(1, 1);
  system.stiffness = matrix_of(w);
  SystemDerivative derivative;
  derivative.stiffness = matrix_of(dw);
  const Monodromy m = augmented_monodromy(engine, system, derivative, options);
  HillVariation result;
  result.outcome = m.outcome;
  if (m.outcome != Outcome::converged && m.outcome != Outcome::tolerance_not_reached) return result;
  const auto& a = m.undamped.value.mantissa;
  const auto& e = m.undamped.error;
  result.n = part(a, 0, 0);
  result.dn = part(a, 1, 0);
  result.n_error = part(e, 0, 0);
  result.dn_error = part(e, 1, 0);
  result.exponent = m.undamped.value.exponent;
  return result;
}

Eigen::Matrix2d inverse(const Eigen::Matrix2d& n) {
  Eigen::Matrix2d result;
  result << n(1, 1), -n(0, 1), -n(1, 0), n(0, 0);
  return result;
}

/// Everything that the slopes of Hill's equation are made of. Where W is even, theta = 0 is a centre.
class HillSlopes {
 public:
  HillSlopes(MonodromyEngine& engine, const HillEquation& equation, const HillDerivative& derivative,
             const MonodromyOptions& options)
      : equation_(equation), derivative_(derivative), by_(undamped(equation, derivative)) {
    const double c = equation.canonical_damping();
    PeriodicFunction w = equation.coefficient.plus(-0.25 * c * c);
    h_ = pi * c;
    const auto centre = w.even_centre();
    if (centre) {
      w = w.centred(*centre);
      by_.coefficient = by_.coefficient.shifted(*centre);
    }
    HillMonodromy m = engine.compute(HillEquation{1.0, 0.0, w, equation.coefficient_error}, options);
    outcome_ = m.outcome;
    if (!has_value()) return;
    kappa_ = m.kappa;
    gap_ = discriminant_gap(m);
    v_ = hill_variation(engine, w, by_.coefficient, options);
    outcome_ = v_.outcome;
    if (!has_value()) return;
    half_ = m.half;
    widen(w);
    set_discriminant_slope();
  }

  Sensitivity result() const {
    Sensitivity s;
    s.outcome = outcome_;
    if (!has_value()) return s;
    const double dh = by_.half_damping;
    s.growth = growth_slope();
    const double rate = equation_.angular_frequency / (2.0 * pi), growth = hill_growth(gap_, h_);
    s.growth_per_time = {
        s.growth.value * rate + growth * derivative_.angular_frequency / (2.0 * pi),
        s.growth.error * rate + 8.0 * kUnit * std::abs(growth * derivative_.angular_frequency)};
    s.winding = winding_slope();
    s.margin = margin_slope(dh);
    s.edge = edge_slope(dh);
    return s;
  }

 private:
  bool has_value() const {
    return outcome_ == Outcome::converged || outcome_ == Outcome::tolerance_not_reached;
  }

  /// The inputs' own roundings, to first order.
  void widen(const PeriodicFunction& w) {
    const double relative =
        (equation_.coefficient_error + 8.0 * kUnit) * (1.0 + 2.0 * pi * (1.0 + w.bound()));
    v_.dn_error.array() += relative * v_.dn.cwiseAbs().maxCoeff();
    v_.n_error.array() += relative * v_.n.cwiseAbs().maxCoeff();
  }

  /// dD/dp times 2^-exponent by the sharper of trace(dN) and trace((N -+ 1) N^-1 dN).
  void set_discriminant_slope() {
    slope_ = {v_.dn.trace(), v_.dn_error.trace() + 2.0 * kUnit * v_.dn.cwiseAbs().trace()};
    if (gap_.log_abs > 2.0 || v_.exponent > 30) return;
    const double size = std::ldexp(1.0, static_cast<int>(v_.exponent));
    const Eigen::Matrix2d n = size * v_.n, dn = size * v_.dn, n_error = size * v_.n_error,
                          dn_error = size * v_.dn_error;
    gram_ = inverse(n) * dn;
    gram_error_ = inverse(n).cwiseAbs() * dn_error + inverse(n_error).cwiseAbs() * dn.cwiseAbs() +
                  4.0 * kUnit * (inverse(n).cwiseAbs() * dn.cwiseAbs());
    Eigen::Matrix2d k, k_error;
    distance_from_identity(n, n_error, k, k_error);
    const double value = (k * gram_).trace(),
                 error = (k.cwiseAbs() * gram_error_ + k_error * (gram_.cwiseAbs() + gram_error_)).trace() +
                         8.0 * kUnit * (k.cwiseAbs() * gram_.cwiseAbs()).trace();
    const double scaled = error / size;
    if (scaled < slope_.error) slope_ = {value / size, scaled};
  }

  /// N - 1 (D > 0) or N + 1: products of half-period values where there are any, n11 -+ 1 = 2 u1' u2 or 2 u1
  /// u2'.
  void distance_from_identity(const Eigen::Matrix2d& n, const Eigen::Matrix2d& n_error, Eigen::Matrix2d& k,
                              Eigen::Matrix2d& k_error) const {
    if (!half_) {
      k = n - gap_.sign * Eigen::Matrix2d::Identity();
      k_error = n_error;
      return;
    }
    const double two = std::ldexp(2.0, static_cast<int>(2 * half_->value.exponent));
    const auto times = [&](int i, int j, int p, int q, double unit, double& value, double& error) {
      const auto &m = half_->value.mantissa, &e = half_->error;
      value = unit * two * m(i, j) * m(p, q);
      error = unit * two * (std::abs(m(i, j)) * e(p, q) + std::abs(m(p, q)) * e(i, j) + e(i, j) * e(p, q)) +
              4.0 * kUnit * std::abs(value);
    };
    if (gap_.sign > 0) {
      times(1, 0, 0, 1, 1.0, k(0, 0), k_error(0, 0));
    } else {
      times(0, 0, 1, 1, 1.0, k(0, 0), k_error(0, 0));
    }
    k(1, 1) = k(0, 0);
    k_error(1, 1) = k_error(0, 0);
    times(0, 1, 1, 1, 1.0 / kappa_, k(0, 1), k_error(0, 1));
    times(0, 0, 1, 0, kappa_, k(1, 0), k_error(1, 0));
  }

  /// sqrt|D^2 - 4| 2^-exponent.
  double root() const {
    if (gap_.log_abs > kLogOfLargeD) return std::abs(v_.n.trace());
    const double size = std::sqrt(std::abs(gap_.gap) * (2.0 + std::exp(gap_.log_abs)));
    return std::ldexp(size, -static_cast<int>(v_.exponent));
  }
  double relative_root_error() const { return 0.5 * gap_.gap_error / std::abs(gap_.gap) + 4.0 * kUnit; }

  Derivative growth_slope() const {
    const double dh = by_.half_damping, rounding = 8.0 * kUnit * std::abs(dh);
    if (gap_.gap > 0.0) return {0.0 - dh, rounding};
    const double rate = gap_.sign * slope_.value / root();
    return {rate - dh, slope_.error / root() + std::abs(rate) * relative_root_error() + rounding};
  }

  /// 4 pi sin(2 pi winding) = 2 pi sqrt(4 - D^2), with the sign of u2: positive where n12 > 0, as for small
  /// positive W.
  Derivative winding_slope() const {
    if (gap_.gap <= 0.0) return {0.0, 0.0};
    const double sine = std::copysign(2.0 * pi * root(), v_.n(0, 1));
    const double value = 0.0 - slope_.value / sine;  // not -0
    return {value, slope_.error / std::abs(sine) + std::abs(value) * relative_root_error()};
  }

  Derivative margin_slope(double dh) const {
    const double cosh_h = std::cosh(h_),
                 size = std::ldexp(1.0, static_cast<int>(std::min(v_.exponent, 5000L)));
    const double by_damping = std::exp(gap_.log_abs) * std::tanh(h_) / (2.0 * cosh_h) * dh;
    return {by_damping - gap_.sign * size * slope_.value / (2.0 * cosh_h),
            size * slope_.error / (2.0 * cosh_h) + 8.0 * kUnit * std::abs(by_damping)};
  }

  Derivative edge_slope(double dh) const {
    if (half_ && h_ == 0.0 && gram_.allFinite()) {
      // the factor that vanishes on the edge says which of u1, u2 is periodic
      const Eigen::Matrix2d m = half_->value.mantissa.cwiseAbs();
      const bool first =
          m.col(0).minCoeff() / m.col(0).maxCoeff() < m.col(1).minCoeff() / m.col(1).maxCoeff();
      return first ? Derivative{-gram_(1, 0), gram_error_(1, 0)} : Derivative{gram_(0, 1), gram_error_(0, 1)};
    }
    const double size = std::ldexp(1.0, static_cast<int>(std::min(v_.exponent, 5000L)));
    const double allowed = 2.0 * std::sinh(h_) * dh;
    return {allowed - gap_.sign * size * slope_.value, size * slope_.error + 8.0 * kUnit * std::abs(allowed)};
  }

  const HillEquation& equation_;
  const HillDerivative& derivative_;
  UndampedDerivative by_;
  double h_ = 0.0;  // cT/2
  double kappa_ = 1.0;
  Outcome outcome_ = Outcome::failed;
  DiscriminantGap gap_;
  HillVariation v_;
  std::optional<BoundedMatrix2> half_;
  Derivative slope_;  // of D, times 2^-exponent
  Eigen::Matrix2d gram_ = Eigen::Matrix2d::Constant(NAN),
                  gram_error_ = gram_;  // N^-1 dN: [g12, g22; -g11, -g12]
};

}  // namespace

HillVariation hill_variation(MonodromyEngine& engine, const PeriodicFunction& w, const PeriodicFunction& dw,
                             const MonodromyOptions& options) {
  const bool steps = w.is_piecewise_constant() && dw.is_piecewise_constant();
  const bool smooth = w.is_constant() && dw.is_constant();
  return steps && !smooth ? square_variation(w, dw) : smooth_variation(engine, w, dw, options);
}

Sensitivity hill_sensitivity(MonodromyEngine& engine, const HillEquation& equation,
                             const HillDerivative& derivative, const MonodromyOptions& options) {
  return HillSlopes(engine, equation, derivative, options).result();
}

}  // namespace strutt
