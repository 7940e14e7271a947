#pragma once

#include <Eigen/Core>
#include <array>
#include <atomic>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "strutt/chart/axis.hpp"
#include "strutt/floquet/monodromy.hpp"
#include "strutt/model/scene.hpp"

namespace strutt {

struct SurrogateOptions {
  double tolerance = 1e-9;  ///< largest Monodromy::error wanted, 1e-13 <= tolerance <= 1e-2
  int threads = 0;          ///< 0: all; the result does not depend on it
  const std::atomic<bool>* cancel = nullptr;
};

/// What building took, and how the check went.
struct SurrogateReport {
  std::size_t boxes = 0;  ///< interpolated
  std::size_t boxes_left_out =
      0;  ///< left to point by point: not worth it, too steep, or without a model somewhere
  std::size_t failed_checks = 0;  ///< left to point by point because the check failed
  std::size_t nodes = 0;          ///< points that were integrated to build
  std::size_t checks = 0;         ///< scattered points that were integrated to check
  double largest_check =
      0.0;  ///< largest |surrogate - engine| of a factor, divided by the sum of both bounds
  int highest_degree = 0;
  long right_hand_sides = 0;
};

/// What is interpolated, n x n, of the equation of y = exp(ct/2) x in the state (y, y'/kappa).
enum class SurrogateKind : signed char {
  half_period,  ///< Hill, even coefficient: the propagator over half a period from the even phase
  period,       ///< the propagator over a period from the phase 0 (n states: damping inside unless it is
                ///< proportional)
};

/// A box of the two axis coordinates (the parameter, or its logarithm on a logarithmic axis), and on it each
/// entry of the propagator f * 2^exponent as
///   f(x, y) = sum_ij c_ij T_i(s) T_j(t),   s, t in [-1, 1] across the box.
struct SurrogateBox {
  std::array<double, 2> low{}, high{};  ///< in axis coordinates
  bool interpolated = false;            ///< false: no surrogate here
  long exponent = 0;
  double kappa = 1.0;                         ///< canonical, of the coefficients; that of a point may differ
  std::vector<Eigen::MatrixXd> coefficients;  ///< row by row: each (degree_x + 1) x (degree_y + 1)
  std::vector<double> error;  ///< bounds of the entries' errors anywhere in the box, row by row
};

/// All that a surrogate is; what is saved to a file (io/surrogate_file.hpp).
struct SurrogateData {
  Scene scene;
  Axis x, y;
  double tolerance = 1e-9;
  SurrogateKind kind = SurrogateKind::half_period;
  std::optional<double> even_phase;  ///< theta0, kind half_period
  std::vector<SurrogateBox> boxes;   ///< disjoint, together the chart
  SurrogateReport report;
};

/// What is interpolated at a point, value * 2^exponent in the state (y, y'/kappa), n x n, and its derivatives
/// with respect to the two parameters: those of the polynomials, exact but for rounding.
struct SurrogateGradient {
  Eigen::MatrixXd value, by_x, by_y;
  long exponent = 0;
  double kappa = 1.0;
};

/// What is interpolated at many points, in the state (y, y'/kappa) and the unit 2^exponent of the box that
/// each lies in. |true - value| is at most the box's `error` and the rounding of the sum.
struct SurrogateEntries {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> box;  ///< index into boxes(); kNone where there is no surrogate
  std::vector<double>
      values;  ///< entry f, row by row, of point p at [f * points + p]; NaN where there is none
};

/// A Chebyshev surrogate of propagators over two parameters.
///
/// Propagators are analytic in the parameters, so their interpolants in Chebyshev points converge
/// geometrically. The degree is doubled in the direction whose last coefficients are larger until the scaled
/// error of M is below the tolerance at every node; a box whose degree would pass 64, or in which small
/// values drown in large ones, is cut in two. The error of a box is twice the sum of the last coefficients,
/// plus twice the error of the nodes, plus the rounding of coordinates, transform and sum. Every box is
/// checked at pseudo-random points (fixed seed) against the engine at a tighter tolerance; one that fails is
/// given up. Damping that is the same for all states shifts the mean of the coefficient and scales the
/// multipliers; what is interpolated is free of it.
class Surrogate {
 public:
  /// Why there can be no surrogate over these axes; empty if there can: smooth coefficients, the same kind of
  /// model everywhere, both axes with two points or more. The points of the axes matter only to what is worth
  /// a box: one with fewer cells than nodes is not.
  static std::string refusal(const Scene& scene, const Axis& x, const Axis& y);

  /// Throws InvalidInput with the refusal if there is one, or for a tolerance out of range.
  Surrogate(const Scene& scene, const Axis& x, const Axis& y, const SurrogateOptions& options = {});

  /// One that was built before. Throws InvalidInput if its parts do not fit together.
  explicit Surrogate(SurrogateData data);

  /// The monodromy at one point, nothing where there is no surrogate. Kind half_period: `half` is about the
  /// even phase theta0, `matrix` and `undamped` are those over [theta0, theta0 + 2 pi], similar to those from
  /// 0: trace, margin, growth and winding are the same. `error` is that of `matrix`; outcome
  /// tolerance_not_reached where it is above the tolerance.
  std::optional<Monodromy> monodromy(double x, double y) const;
  std::optional<HillMonodromy> hill_monodromy(double x,
                                              double y) const;  ///< nothing if it is no Hill equation

  /// The same at many points (x, y), several to a processor register: the bits of the calls one by one.
  std::vector<std::optional<Monodromy>> monodromies(std::span<const std::array<double, 2>> points) const;
  std::vector<std::optional<HillMonodromy>> hill_monodromies(
      std::span<const std::array<double, 2>> points) const;

  /// What is interpolated, alone.
  SurrogateEntries entries(std::span<const std::array<double, 2>> points) const;

  /// Nothing where there is no surrogate. With half-period factors the discriminant and its gradient are
  /// D = 2 (u1 u2' + u1' u2).
  std::optional<SurrogateGradient> gradient(double x, double y) const;

  const SurrogateData& data() const { return data_; }
  const std::vector<SurrogateBox>& boxes() const { return data_.boxes; }
  const SurrogateReport& report() const { return data_.report; }
  SurrogateKind kind() const { return data_.kind; }
  std::optional<double> even_phase() const { return data_.even_phase; }
  bool cancelled() const { return cancelled_; }  ///< then it must not be used

  /// The coordinate of a parameter value in which the boxes are given.
  static double coordinate(const Axis& axis, double value);

 private:
  std::size_t box_at(double x, double y) const;  // kNone: no surrogate

  SurrogateData data_;
  bool cancelled_ = false;
};

}  // namespace strutt
