#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/constants.hpp"
#include "strutt/integrate/taylor_propagator.hpp"

namespace strutt {

class TaylorPropagator::Steps {
 public:
  virtual ~Steps() = default;
  /// Over one step, state (Q, Q').
  virtual BoundedMatrix step(int index, bool with_truncation) = 0;
  virtual long products() const = 0;
};

namespace detail {

/// The Taylor coefficients of a periodic matrix of size D (or Eigen::Dynamic) about points of the period.
template <int D>
class TaylorCoefficients {
 public:
  using Square = Eigen::Matrix<double, D, D>;

  /// Of factor * matrix, in powers of (theta - centre)/tau.
  TaylorCoefficients(const PeriodicMatrix& matrix, double factor, double tau, int order)
      : mean_(factor * matrix.mean) {
    int terms = 1;
    const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(matrix.mean.rows(), matrix.mean.cols());
    for (const auto& h : matrix.harmonics) {
      const double radians = h.order * tau;
      Wave wave{h.order,
                factor * (h.cosine.size() > 0 ? h.cosine : zero),
                factor * (h.sine.size() > 0 ? h.sine : zero),
                {}};
      double scale = 1.0;
      for (int j = 0; j < order && (scale > kNegligible || j < radians); ++j) {
        wave.scales.push_back(scale);
        scale *= radians / (j + 1);
      }
      terms = std::max(terms, static_cast<int>(wave.scales.size()));
      waves_.push_back(std::move(wave));
    }
    values_.assign(static_cast<std::size_t>(terms), Square(mean_));
  }

  int terms() const { return static_cast<int>(values_.size()); }
  const Square& operator[](int j) const { return values_[static_cast<std::size_t>(j)]; }

  /// About the centre pi numerator/denominator.
  void expand(long numerator, long denominator) {
    values_.front() = mean_;
    for (std::size_t j = 1; j < values_.size(); ++j) values_[j].setZero();
    for (const auto& wave : waves_) {
      // The phase reduced in integers: only the angle in the circle is rounded.
      const auto turns = static_cast<double>(wave.order * numerator % (2 * denominator));
      const double angle = std::numbers::pi * turns / static_cast<double>(denominator);
      const double c = std::cos(angle), s = std::sin(angle);
      const std::array cosine{c, -s, -c, s}, sine{s, c, -s, -c};
      for (std::size_t j = 0; j < wave.scales.size(); ++j) {
        values_[j] += wave.scales[j] * (cosine[j % 4] * wave.cosine + sine[j % 4] * wave.sine);
      }
    }
  }

 private:
  static constexpr double kNegligible = 0x1p-64;
  struct Wave {
    long order;
    Square cosine, sine;
    std::vector<double> scales;  // (order tau)^j/j!
  };
  Square mean_;
  std::vector<Wave> waves_;
  std::vector<Square> values_;
};

/// The steps of systems with D degrees of freedom (or Eigen::Dynamic).
template <int D>
class TaylorSteps : public TaylorPropagator::Steps {
 public:
  static constexpr int N = D == Eigen::Dynamic ? Eigen::Dynamic : 2 * D;
  using Square = Eigen::Matrix<double, D, D>;
  using Block = Eigen::Matrix<double, D, N>;  // the rows of Q or of Q' of a fundamental matrix
  using Full = Eigen::Matrix<double, N, N>;

  TaylorSteps(const TaylorEquation& equation, const TaylorStepPlan& plan, int half_periods)
      : order_(plan.order),
        steps_(plan.steps),
        half_periods_(half_periods),
        decay_(plan.decay),
        tau_(half_periods * std::numbers::pi / (2.0 * plan.steps)),
        exponent_(std::ilogb(tau_)),
        relative_error_(kSeriesRounding * kUnit + equation.error_rate * tau_),
        stiffness_(equation.stiffness, tau_ * scale(), tau_, plan.order),
        damped_(equation.damping.mean.size() > 0),
        damping_(damped_ ? equation.damping : PeriodicMatrix{0.0 * equation.stiffness.mean, {}}, tau_, tau_,
                 plan.order) {
    const auto d = equation.stiffness.mean.rows();
    q_.assign(static_cast<std::size_t>(order_) + 1, Block::Zero(d, 2 * d));
    v_ = q_;
    q_[0].leftCols(d).setIdentity();
    v_[0].rightCols(d).setIdentity();
  }

  BoundedMatrix step(int index, bool with_truncation) override {
    const long numerator = static_cast<long>(half_periods_) * (2L * index + 1), denominator = 2L * steps_;
    stiffness_.expand(numerator, denominator);
    if (damped_) damping_.expand(numerator, denominator);
    expand_solutions();
    return centred_step(with_truncation);
  }

  long products() const override {
    long result = 0;
    for (int k = 0; k < order_; ++k) result += std::min(k + 1, stiffness_.terms());
    return result;
  }

 private:
  // Of the terms of a series, in units of 2^-53: twice what the worst of 700 random systems needed, since
  // roundings add up like a random walk. The worst case would be several times more.
  static constexpr double kSeriesRounding = 1.0;

  /// The state is (Q, scale Q'), a power of two near tau: what is said of one holds for the other exactly.
  double scale() const { return std::ldexp(1.0, exponent_); }

  void expand_solutions() {
    const double ratio = tau_ / scale();
    for (int k = 0; k < order_; ++k) {
      const auto next = static_cast<std::size_t>(k) + 1;
      sum_.setZero(q_[0].rows(), q_[0].cols());
      for (int j = std::min(k, stiffness_.terms() - 1); j >= 0; --j)
        sum_.noalias() -= stiffness_[j] * q_[static_cast<std::size_t>(k - j)];
      for (int j = std::min(k, damped_ ? damping_.terms() - 1 : -1); j >= 0; --j)
        sum_.noalias() -= damping_[j] * v_[static_cast<std::size_t>(k - j)];
      q_[next] = (ratio / (k + 1)) * v_[next - 1];
      v_[next] = sum_ / static_cast<double>(k + 1);
    }
  }

  Full stacked(std::size_t k) const {
    Full result(2 * q_[k].rows(), q_[k].cols());
    result << q_[k], v_[k];
    return result;
  }

  /// Phi(m + tau) Phi(m - tau)^-1 from the expansion.
  BoundedMatrix centred_step(bool with_truncation) const {
    const auto p = static_cast<std::size_t>(order_);
    const Full last = stacked(p), before = stacked(p - 1);
    Full even = last, odd = before, size = last.cwiseAbs() + before.cwiseAbs();
    for (std::size_t k = p - 1; k-- > 0;) {
      const Full term = stacked(k);
      (k % 2 == 0 ? even : odd) += term;
      size += term.cwiseAbs();
    }
    const Full forward = even + odd, inverse = Full(even - odd).partialPivLu().inverse();
    const Full step = forward * inverse;
    Full error = relative_error_ * ((step.cwiseAbs() * size + size) * inverse.cwiseAbs());
    if (with_truncation) error.array() += truncation(step, inverse);
    BoundedMatrix result;
    result.value.mantissa = unscaled(step);
    result.error = unscaled(error);
    result.normalise();
    return result;
  }

  /// Bound of the truncation of a step F B^-1, for every entry.
  double truncation(const Full& step, const Full& inverse) const {
    const auto p = static_cast<std::size_t>(order_);
    const auto pair = [this](std::size_t k) { return std::max(size_of_term(k), size_of_term(k - 1)); };
    const double before = pair(p - 2), ratio = std::max({pair(p) / before, before / pair(p - 4), decay_});
    // The step without the last two terms, to first order in them.
    const Full last = stacked(p), odd = stacked(p - 1);
    const Full difference = ((last + odd) - step * (last - odd)) * inverse;
    return std::min(kTaylorTruncationSafety * ratio, 1.0) * difference.cwiseAbs().maxCoeff();
  }

  double size_of_term(std::size_t k) const {
    return std::max(q_[k].cwiseAbs().maxCoeff(), v_[k].cwiseAbs().maxCoeff());
  }

  /// From (Q, scale Q') to (Q, Q').
  Eigen::MatrixXd unscaled(Full matrix) const {
    const auto d = matrix.rows() / 2;
    matrix.topRightCorner(d, d) *= scale();
    matrix.bottomLeftCorner(d, d) /= scale();
    return matrix;
  }

  int order_, steps_, half_periods_;
  double decay_, tau_;
  int exponent_;
  double relative_error_;  // of the terms of the series
  TaylorCoefficients<D> stiffness_;
  bool damped_;
  TaylorCoefficients<D> damping_;
  std::vector<Block> q_, v_;  // Q_k and scale Q'_k
  Block sum_;
};

}  // namespace detail
}  // namespace strutt
