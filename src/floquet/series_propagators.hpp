#pragma once

#include <compare>
#include <map>
#include <span>
#include <vector>

#include "floquet/segments.hpp"
#include "strutt/base/bounded_matrix.hpp"
#include "strutt/integrate/hill_family.hpp"
#include "strutt/integrate/integrator.hpp"

namespace strutt {

/// Y'' + W Y = 0 over a piece on which W is smooth.
struct SeriesJob {
  PeriodicFunction w;
  Segment piece;
  double kappa = 1.0;
  double coefficient_error = 0.0;  ///< bound of the relative error of W
};

/// The propagator of one smooth piece by power series, state (Y, Y'/kappa), with all its errors.
struct SeriesPropagation {
  BoundedMatrix2 matrix;
  IntegrationCost cost;  ///< `right_hand_sides`: coefficients of W; no steps: it would need too many
};

/// Propagates equations, those with the same harmonics over the same piece in one HillFamily. The families
/// are kept, since the cells of a chart share them. A result does not depend on the other jobs.
class SeriesPropagators {
 public:
  /// One result for each job, with a truncation of about `tolerance`.
  std::vector<SeriesPropagation> propagate(std::span<const SeriesJob> jobs, double tolerance);

 private:
  /// What the equations of a family have in common. The harmonics: positive the order of a cosine, negative
  /// that of a sine.
  struct Key {
    double from = 0.0, to = 0.0, tolerance = 0.0;
    std::vector<int> harmonics;
    auto operator<=>(const Key&) const = default;
  };

  HillFamily& family(const Key& key);

  std::map<Key, HillFamily> families_;
};

}  // namespace strutt
