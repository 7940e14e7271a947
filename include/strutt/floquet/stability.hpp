#pragma once

#include <Eigen/Core>
#include <complex>
#include <limits>
#include <span>
#include <vector>

#include "strutt/floquet/multipliers.hpp"
#include "strutt/model/scene.hpp"

namespace strutt {

/// Everything Strutt says about one linear periodic system; the columns of `strutt stability`
/// (docs/files.md).
struct Stability {
  Verdict verdict = Verdict::unresolved;
  double margin = std::numeric_limits<double>::quiet_NaN();
  double margin_error = std::numeric_limits<double>::infinity();
  double growth = std::numeric_limits<double>::quiet_NaN();  ///< ln of the spectral radius per period
  double growth_per_time = std::numeric_limits<double>::quiet_NaN();  ///< growth/T
  double winding =
      std::numeric_limits<double>::quiet_NaN();  ///< NaN for more than 2 states, or unless asked for
  double discriminant = std::numeric_limits<double>::quiet_NaN();  ///< trace of M / exp(log_scale)
  Eigen::MatrixXd
      matrix;  ///< M / exp(log_scale), scene's units, state (q, q'), n x n; empty when there is none
  double log_scale = 0.0;  ///< 0 unless an entry, the trace or a multiplier would pass 1e300
  std::vector<std::complex<double>>
      multipliers;  ///< / exp(log_scale); by falling modulus, positive imaginary part first
  double error = std::numeric_limits<double>::infinity();  ///< of trace and M, see Monodromy::error
  Method method = Method::automatic;
  Outcome outcome = Outcome::failed;
  IntegrationCost cost;           ///< of the runs that gave the value
  IntegrationCost estimate_cost;  ///< of those that gave the error
};

/// Which parts to compute beyond margin, growth and error, and the verdict that follows from these.
struct StabilityParts {
  bool verdict = true;  ///< a verdict is wanted: where it is open, `analyse` looks again
  bool winding = true;
  bool matrix = true;  ///< matrix, discriminant, log_scale, multipliers
};

/// From a monodromy matrix to everything else. Never throws for numerical reasons.
Stability assess(const HillEquation& equation, const HillMonodromy& monodromy,
                 const StabilityParts& parts = {});
Stability assess(const LinearPeriodicSystem& system, const Monodromy& monodromy,
                 const StabilityParts& parts = {});

/// compute + assess. A system with one degree of freedom and constant c >= 0 is treated as the Hill equation
/// it is. Where the verdict is open at the tolerance asked for, and the method can be more accurate, the
/// point is computed once more as accurately as that method can (MonodromyOptions::sharpest), and the result
/// with the smaller margin_error counts, at the cost of both: only then is it `unresolved`. All other points
/// are as they would be without. Without StabilityParts::verdict, or estimate_error, nothing is computed
/// again.
Stability analyse(MonodromyEngine& engine, const LinearModel& model, const MonodromyOptions& options = {},
                  const StabilityParts& parts = {});

/// The same for many models, Hill equations side by side; the same bits as one by one.
std::vector<Stability> analyse(MonodromyEngine& engine, std::span<const LinearModel> models,
                               const MonodromyOptions& options = {}, const StabilityParts& parts = {});

/// The method that `analyse` begins with when `asked` for; throws InvalidInput if it does not fit
/// (monodromy.hpp).
Method method_for(const LinearModel& model, Method asked);

/// The Hill equation that a system with one degree of freedom, constant damping c >= 0 is, with the kappa of
/// a system, 2 pi/T; nothing otherwise.
std::optional<HillEquation> as_hill_equation(const LinearPeriodicSystem& system);

}  // namespace strutt
