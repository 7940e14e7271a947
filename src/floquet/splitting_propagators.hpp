#pragma once

#include <map>
#include <vector>

#include "floquet/segments.hpp"
#include "strutt/base/bounded_matrix.hpp"
#include "strutt/integrate/hill_propagator.hpp"
#include "strutt/integrate/integrator.hpp"

namespace strutt {

/// The propagator of one smooth piece by a splitting, and the same with half the steps.
struct SplittingPropagation {
  BoundedMatrix2 matrix;  ///< state (Y, Y'/kappa); `error` bounds its rounding only
  ScaledMatrix2 check;
  double truncation_share = 0.0;     ///< bound of the truncation as a share of |matrix - check|
  IntegrationCost cost, check_cost;  ///< no steps: the tolerance needs too many
};

/// Propagates one equation after the other; the tables of cosines are kept, since the cells of a chart share
/// them.
class SplittingPropagators {
 public:
  /// Y'' + W Y = 0 over a piece on which W is smooth, to a truncation of about `tolerance`.
  /// `coefficient_error`: bound of the relative error of W. Without `with_check` the second run is left out.
  SplittingPropagation propagate(const PeriodicFunction& w, const Segment& piece, double kappa,
                                 double tolerance, double coefficient_error, bool with_check);

 private:
  /// Order, steps, ends, and the harmonics: positive the order of a cosine, negative that of a sine.
  struct Key {
    int order, steps;
    double from, to;
    std::vector<int> harmonics;
    auto operator<=>(const Key&) const = default;
  };

  const HillPropagator& table(Key key);

  std::map<Key, HillPropagator> tables_;
};

}  // namespace strutt
