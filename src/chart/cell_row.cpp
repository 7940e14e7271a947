#include "chart/cell_row.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/constants.hpp"
#include "chart/cell_engine.hpp"
#include "chart/factor_error.hpp"
#include "floquet/half_period_factors.hpp"

namespace strutt {
namespace {

/// trace M = exp(-h) 2 (u1 u2' + u1' u2) 2^(2 exponent).
double trace_of(const HalfPeriodFactors& f, double half_damping) {
  const double half_trace = f.value[0] * f.value[3] + f.value[1] * f.value[2];
  const double shift = std::floor(-half_damping / std::numbers::ln2);
  const double decay = half_damping == 0.0 ? 1.0 : std::exp(-half_damping - shift * std::numbers::ln2);
  const double exponent = std::clamp(2.0 * static_cast<double>(f.exponent) + shift, -5000.0, 5000.0);
  return std::ldexp(2.0 * decay * half_trace, static_cast<int>(exponent));
}

void put(double* results, std::size_t c, double value) {
  if (results != nullptr) results[c] = value;
}

}  // namespace

void cells_in_log_form(CellRow& row) {
  row.largest_error = 0.0;
  row.all_resolved = true;
  for (std::size_t c = 0; c < row.count; ++c) {
    const double h = row.damping.h[c], kappa = row.kappa[c];
    HalfPeriodFactors factors{{}, row.factor_error, row.exponent};
    for (std::size_t f = 0; f < 4; ++f) factors.value[f] = row.factors[f][c];
    const double ratio = kappa / row.box_kappa;
    std::array<double, 4> value = factors.value, bounds = factors.error;
    for (const auto& [f, factor] : {std::pair<std::size_t, double>{1, ratio}, {2, 1.0 / ratio}}) {
      value[f] *= factor;
      bounds[f] = bounds[f] * factor + 2.0 * kUnit * std::abs(value[f]);
    }
    const double error = monodromy_error(value, bounds, {row.exponent, h, kappa, row.shifted});
    const auto gap = discriminant_gap(factors);
    const Margin margin = hill_margin(gap, h);
    const Verdict verdict = verdict_of(margin);
    if (!(error <= row.largest_error)) row.largest_error = error;
    row.all_resolved = row.all_resolved && verdict != Verdict::unresolved;
    put(row.error, c, error);
    put(row.margin, c, margin.value);
    put(row.verdict, c, static_cast<double>(verdict));
    put(row.growth, c, hill_growth(gap, h));
    put(row.trace, c, written_trace(trace_of(factors, h)));
    if (row.winding == nullptr) continue;
    if (row.quarter_turns == nullptr) row.turns.follow(factors.value[1], factors.value[3]);
    const double turns =
        row.quarter_turns == nullptr ? row.turns.quadrant : quadrant(factors, row.quarter_turns[c]);
    row.winding[c] = winding_number(factors, gap, turns);
  }
}

}  // namespace strutt
