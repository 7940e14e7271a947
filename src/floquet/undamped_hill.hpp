#pragma once

#include <optional>
#include <vector>

#include "floquet/propagators.hpp"
#include "floquet/segments.hpp"
#include "strutt/floquet/monodromy.hpp"

namespace strutt {

/// The equation of y = exp(ct/2) x over half a period from a symmetric point, or over a whole one if there is
/// none.
struct UndampedHill {
  explicit UndampedHill(const HillEquation& equation);

  /// The monodromy matrix from the propagators of the segments that the pieces were cut into, with its error;
  /// without value where these were not finished.
  HillMonodromy assembled(const Propagators<Eigen::Matrix2d>& found,
                          const std::vector<Segment>& segments) const;

  std::optional<double> centre;
  PeriodicFunction w;
  double kappa;
  double angular_frequency, damping;  ///< Omega, and c in canonical time
  /// Bound of the relative error of the coefficients of W.
  double coefficient_error;
  std::vector<Segment> pieces;  ///< on which W is smooth; 0 and the centre are ends of pieces

 private:
  HillMonodromy put_together(const std::vector<BoundedMatrix2>& factors,
                             const std::vector<Segment>& segments) const;
};

}  // namespace strutt
