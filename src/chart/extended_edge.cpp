#include "chart/extended_edge.hpp"

#include <algorithm>
#include <cmath>

#include "base/constants.hpp"
#include "chart/reference_monodromy.hpp"

namespace strutt {
namespace {

constexpr int kSteps = 5;
constexpr double kLargest = 1e4;  // of the coefficients in canonical time: about 0.1 s

double largest_coefficient(const judge::Equation& equation) {
  double largest = 0.0;
  for (const auto& piece : equation.pieces)
    for (const auto& term : piece.stiffness)
      for (const auto* part : {&term.cosine, &term.sine})
        for (const auto& x : part->entries) largest = std::max(largest, std::abs(static_cast<double>(x)));
  return largest;
}

}  // namespace

std::optional<judge::Real> ExtendedEdges::excess(double parameter) {
  *value_ = parameter;
  const auto equation = judge::equation_of(scene_);
  if (equation.degrees_of_freedom != 1 || !(largest_coefficient(equation) < kLargest)) return std::nullopt;
  const auto monodromy = judge::monodromy(equation, cancel_);
  if (!monodromy) return std::nullopt;
  const auto& m = monodromy->matrix;
  const judge::Real determinant = m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0), trace = m(0, 0) + m(1, 1);
  return judge::Real(abs(trace) - 1 - determinant);
}

/// Newton's method; its slopes are differences between two doubles, which leaves 15 digits of them.
std::optional<ExtendedEdges::Zero> ExtendedEdges::near(double place, double reach) {
  using judge::Real;
  const double apart = 4.0 * kUnit * std::abs(place) + 1e-300;
  double p = place;
  for (int step = 0; step < kSteps && std::abs(p - place) <= reach + apart; ++step) {
    const double low = p - apart, high = p + apart;
    const auto at_low = excess(low), at_high = excess(high);
    if (!at_low || !at_high || *at_low == *at_high) return std::nullopt;
    const Real zero = low + (Real(high) - low) * *at_low / (*at_low - *at_high);
    p = static_cast<double>(zero);
    if ((*at_low < 0) != (*at_high < 0)) return Zero{p, static_cast<double>(Real(zero - p))};
  }
  return std::nullopt;
}

}  // namespace strutt
