#pragma once

#include "floquet/propagators.hpp"
#include "strutt/floquet/monodromy.hpp"

namespace strutt {

/// y'' + C(theta) y' + K(theta) y = 0 in canonical time (period 2 pi), y = exp(ct/2) q, from M q'' + C q' + K
/// q = 0: multiplied by M^-1, and the proportional part c >= 0 of the damping split off.
struct UndampedSystem {
  explicit UndampedSystem(const LinearPeriodicSystem& system);

  /// The monodromy matrix, with its error, from propagators whose product, in order, covers the period, or
  /// half of it.
  Monodromy assembled(const Propagators<Eigen::MatrixXd>& found, bool half) const;

  double unit;                        ///< of canonical time
  double c = 0.0;                     ///< in canonical time
  PeriodicMatrix damping, stiffness;  ///< the former with an empty mean where nothing is left
  int highest_order = 1;              ///< of the harmonics
  double rate;                        ///< upper bound of how fast a solution turns or grows
  double coefficient_error;           ///< bound of the relative error of `damping` and `stiffness`
  /// Without damping, K(-theta) = K(theta), and M K symmetric: half the period is enough.
  bool even_symmetric;
  Eigen::MatrixXd mass, inverse_mass;

 private:
  Monodromy put_together(const std::vector<BoundedMatrix>& factors, bool half) const;
  /// The propagator over an interval mirrored about 0 from that over the interval, `even_symmetric` given: J
  /// P^-1 J with J = diag(I, -I), the inverse of P = [A, B; C, D] being symplectic: [D*, B*; C*, A*], X* =
  /// M^-1 X^T M.
  BoundedMatrix mirrored(const BoundedMatrix& propagator) const;
};

/// By Method::propagator: Taylor series.
Monodromy taylor_monodromy(const UndampedSystem& system, const MonodromyOptions& options);

}  // namespace strutt
