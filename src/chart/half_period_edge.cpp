#include "chart/half_period_edge.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/constants.hpp"
#include "chart/certain_zero.hpp"

namespace strutt {
namespace {

struct Block {
  bool lower, right;  // of the propagator
};

/// sign(det) sigma_min of a block, and its error: sigma_min moves by no more than the norm of what is added.
std::optional<Margin> signed_distance(StabilityLine& line, double p, Block block) {
  const auto half = line.half_period(p);
  if (!half) return std::nullopt;
  const Eigen::Index d = half->value.mantissa.rows() / 2;
  const Eigen::Index row = block.lower ? d : 0, column = block.right ? d : 0;
  const Eigen::MatrixXd matrix = half->value.mantissa.block(row, column, d, d);
  const double distance = Eigen::JacobiSVD<Eigen::MatrixXd>(matrix).singularValues()[d - 1];
  const double rounding = 16.0 * static_cast<double>(d) * kUnit * matrix.norm();
  return Margin{std::copysign(distance, matrix.determinant()),
                half->error.block(row, column, d, d).norm() + rounding};
}

/// The zero in a bracket whose ends have certain and opposite signs.
std::optional<StabilityChange> simple_zero(StabilityLine& line, double low, double high, Block block) {
  const auto value = [&](double p) { return signed_distance(line, p, block).value_or(Margin{}); };
  const auto found = certain_zero(value, low, high);
  if (!found) return std::nullopt;
  StabilityChange zero;
  zero.position = found->position;
  zero.error = found->error;
  return zero;
}

}  // namespace

void sharpen(StabilityLine& line, StabilityChange& change, Mechanism mechanism) {
  if (mechanism == Mechanism::complex_pair || !line.half_period(change.position)) return;
  const bool diagonal = mechanism == Mechanism::minus_one;  // A and D, else B and C
  std::optional<StabilityChange> found;
  for (const bool lower : {false, true}) {
    const auto zero = simple_zero(line, change.position - change.error, change.position + change.error,
                                  {.lower = lower, .right = lower == diagonal});
    if (zero && found) return;  // both edges of a tongue
    if (zero) found = zero;
  }
  if (!found || !(found->error < change.error)) return;
  change.position = found->position;
  change.error = found->error;
}

}  // namespace strutt
