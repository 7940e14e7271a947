#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

namespace strutt {

/// A function of the direction from a point: its value in one direction, and its gradient across it.
struct SpherePoint {
  Eigen::VectorXd direction;
  double value = HUGE_VAL;
  double error = 0.0;        ///< of the value
  Eigen::VectorXd gradient;  ///< empty where there is none
};

/// The part of a vector that turns a direction.
inline Eigen::VectorXd across(const Eigen::VectorXd& direction, const Eigen::VectorXd& v) {
  return v - v.dot(direction) * direction;
}

/// The inverse of a Hessian, learnt from gradients (Broyden, Fletcher, Goldfarb and Shanno; Nocedal and
/// Wright, Numerical Optimization, section 6.1).
class InverseHessian {
 public:
  /// Begins, and begins again, with that of a sphere.
  InverseHessian(Eigen::Index size, double scale) : start_(scale * Eigen::MatrixXd::Identity(size, size)) {
    forget();
  }

  void forget() {
    matrix_ = start_;
    learnt_ = false;
  }
  bool learnt() const { return learnt_; }

  /// Newton's, of at most 1.
  Eigen::VectorXd step(const SpherePoint& from) const {
    const Eigen::VectorXd whole = across(from.direction, -(matrix_ * from.gradient));
    return whole / std::max(1.0, whole.norm());
  }

  void learn(const SpherePoint& from, const SpherePoint& to) {
    const Eigen::VectorXd s = across(to.direction, -from.direction),
                          y = to.gradient - across(to.direction, from.gradient);
    const double curvature = s.dot(y);
    if (!(curvature > 1e-12 * s.norm() * y.norm())) return;
    const Eigen::MatrixXd share =
        Eigen::MatrixXd::Identity(s.size(), s.size()) - s * y.transpose() / curvature;
    matrix_ = share * matrix_ * share.transpose() + s * s.transpose() / curvature;
    learnt_ = true;
  }

 private:
  Eigen::MatrixXd start_, matrix_;
  bool learnt_ = false;
};

/// Turns a direction while the value becomes smaller; as small within the errors: while the gradient does.
/// at(direction, best) gives the function next to `best`, or nothing; no more is wanted once done(best).
/// `scale`: of the inverse Hessian.
template <typename Function, typename Done>
SpherePoint descend(SpherePoint best, double scale, int most, const Function& at, const Done& done) {
  InverseHessian inverse(best.direction.size(), scale);
  const auto better = [&best](const SpherePoint& next) {
    const double noise = best.error + next.error;
    return next.value < best.value - noise ||
           (next.value < best.value + noise && next.gradient.size() > 0 &&
            next.gradient.squaredNorm() < 0.5 * best.gradient.squaredNorm());
  };
  for (int turn = 0; turn < most && best.gradient.size() > 0 && !done(best); ++turn) {
    const Eigen::VectorXd step = inverse.step(best);
    std::optional<SpherePoint> next;
    for (double share = 1.0; share > 1e-8 && !next; share *= 0.25) {
      next = at((best.direction + share * step).normalized(), best);
      if (next && !better(*next)) next.reset();
    }
    if (!next && !inverse.learnt()) break;
    if (!next) {
      inverse.forget();
      continue;
    }
    if (next->gradient.size() > 0) inverse.learn(best, *next);
    best = *next;
  }
  return best;
}

}  // namespace strutt
