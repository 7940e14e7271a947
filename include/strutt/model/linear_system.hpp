#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace strutt {

/// order, and the matrices of cos(order theta) and sin(order theta); an empty matrix stands for zero.
struct MatrixHarmonic {
  int order = 1;
  Eigen::MatrixXd cosine;
  Eigen::MatrixXd sine;
};

/// A square matrix that is periodic in the phase: mean + sum_k [cosine_k cos(k theta) + sine_k sin(k theta)].
struct PeriodicMatrix {
  Eigen::MatrixXd mean;
  std::vector<MatrixHarmonic> harmonics;

  void evaluate(double theta, Eigen::Ref<Eigen::MatrixXd> result) const;
  bool is_constant() const;
  bool is_zero() const;
  bool is_symmetric() const;  ///< exactly, every matrix of it
  double bound() const;       ///< bound of the largest absolute row sum over the period
};

/// M q'' + C(t) q' + K(t) q = 0 with d degrees of freedom (n = 2 d states, (q, q')), period T.
struct LinearPeriodicSystem {
  double period = 6.283185307179586;  ///< T > 0
  Eigen::MatrixXd mass;               ///< d x d, invertible
  PeriodicMatrix damping;             ///< C, d x d; mean empty when the scene has none
  PeriodicMatrix stiffness;           ///< K, d x d

  int degrees_of_freedom() const { return static_cast<int>(mass.rows()); }
  int states() const { return 2 * degrees_of_freedom(); }
  bool has_damping() const { return damping.mean.size() > 0 && !damping.is_zero(); }

  /// c with C(t) = c M exactly (0 without damping), or nothing.
  std::optional<double> proportional_damping() const;

  void validate() const;  ///< shapes, finiteness, invertible mass; throws InvalidInput
};

}  // namespace strutt
