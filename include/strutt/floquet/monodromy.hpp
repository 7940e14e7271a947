#pragma once

#include <Eigen/Core>
#include <atomic>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "strutt/base/bounded_matrix.hpp"
#include "strutt/base/method.hpp"
#include "strutt/base/outcome.hpp"
#include "strutt/integrate/integrator.hpp"
#include "strutt/model/hill_equation.hpp"
#include "strutt/model/linear_system.hpp"

namespace strutt {

/// What is wanted of a monodromy matrix.
struct MonodromyOptions {
  double tolerance = 1e-9;  ///< largest `error` wanted, 1e-13 <= tolerance <= 1e-2
  Method method =
      Method::automatic;  ///< automatic, exact (piecewise-constant Hill equations), propagator, arkode, cvode
  bool estimate_error = true;  ///< false: no second run; `error` then holds the rounding part only
  /// As small an error as the method can, whatever the tolerance; `outcome` still judges by that.
  bool sharpest = false;
  double max_seconds = std::numeric_limits<double>::infinity();  ///< per integration
  const std::atomic<bool>* cancel = nullptr;

  void validate() const;  ///< throws InvalidInput
};

/// The monodromy matrix M of a linear periodic system over one period from t = 0, in log form.
///
/// The state is scaled, (q, q'/kappa): entries are then dimensionless and comparable. With uniform damping
/// (q'' + c q' + ...) the equation of y = exp(ct/2) q is integrated, whose matrix N has determinant 1:
///   M = exp(-h) L N L^-1,   h = cT/2,   L = [I, 0; -(c/2 kappa) I, I].
template <typename Matrix>
struct BasicMonodromy {
  using Bounded = BasicBoundedMatrix<Matrix>;
  Bounded matrix;             ///< M, n x n, scaled state
  Bounded undamped;           ///< N (= M where no damping was split off)
  double half_damping = 0.0;  ///< h
  /// Hill's equation with an even coefficient about theta0: the propagator of y over [theta0, theta0 + pi],
  /// [u1, kappa u2; u1'/kappa, u2']. Then trace N - 2 = 4 u1' u2 and trace N + 2 = 4 u1 u2'.
  /// Symmetric systems with even coefficients and damping c M, by Method::propagator: that over [0, T/2].
  std::optional<Bounded> half;
  double kappa = 1.0;  ///< in the scene's unit of time

  /// Upper bound of the error of trace M and of every entry of `matrix`, divided by max(1, largest |entry|),
  /// the rounding of results to double included (docs/conventions.md). +inf when there is no result.
  double error = std::numeric_limits<double>::infinity();
  /// Largest |det - 1| of the integrated propagators of y, each divided by its squared norm (numerical
  /// extremes N3).
  double determinant_defect = 0.0;
  bool sharpest = false;              ///< MonodromyOptions::sharpest would not make it more accurate
  Method method = Method::automatic;  ///< the one used
  Outcome outcome = Outcome::failed;
  IntegrationCost cost;           ///< of the runs that gave the value
  IntegrationCost estimate_cost;  ///< of those that gave the error
};

using Monodromy = BasicMonodromy<Eigen::MatrixXd>;
using HillMonodromy = BasicMonodromy<Eigen::Matrix2d>;  ///< of a Hill equation

/// The same with matrices whose size the type does not say.
Monodromy widened(const HillMonodromy& monodromy);

/// The method that a computation begins with when `asked` for. Method::automatic: `exact` for a
/// piecewise-constant coefficient, `propagator` for everything else. Throws InvalidInput if the one asked for
/// does not fit: `exact` needs a piecewise-constant Hill equation.
Method method_for(const HillEquation& equation, Method asked);
Method method_for(const LinearPeriodicSystem& system, Method asked);

/// Computes monodromy matrices one after the other, reusing its integrators. Not thread-safe: one per thread.
/// Results do not depend on what was computed before.
class MonodromyEngine {
 public:
  MonodromyEngine();
  ~MonodromyEngine();
  MonodromyEngine(MonodromyEngine&&) noexcept;
  MonodromyEngine& operator=(MonodromyEngine&&) noexcept;

  /// Method::automatic: exact for a piecewise-constant coefficient, else the propagator, and arkode where it
  /// would take too many steps. The propagator is a power series in each of a fixed number of steps, of Hill
  /// equations by integrate/hill_family.hpp, of systems by integrate/taylor_propagator.hpp. The local
  /// tolerance of SUNDIALS starts at max(tolerance/100, 1e-14). All are tightened while the error bound is
  /// above the tolerance. Throws InvalidInput for a method that does not fit the equation; numerical trouble
  /// is in the result.
  HillMonodromy compute(const HillEquation& equation, const MonodromyOptions& options = {});
  /// Many at once, the propagator of smooth equations several to a processor register: the same bits as one
  /// by one, several times as fast.
  std::vector<HillMonodromy> compute(std::span<const HillEquation> equations,
                                     const MonodromyOptions& options = {});
  Monodromy compute(const LinearPeriodicSystem& system, const MonodromyOptions& options = {});

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace strutt
