#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "floquet/half_period_factors.hpp"

namespace strutt {

/// What damping does to the cells of a row: functions of h = cT/2.
struct DampingRow {
  const double* h;
  const double* decay;           ///< exp(-h)
  const double* half_sinh;       ///< sinh(h/2)
  const double* sinh;            ///< sinh(h)
  const double* cosh;            ///< cosh(h)
  const double* half_over_cosh;  ///< 1/(2 cosh(h))
};

/// The quadrant of the angle of (u2', u2), whole turns counted, followed from cell to cell by the signs.
struct Turns {
  double quadrant = 0.0;
  int pattern = 0;  ///< sign_quadrant of the cell
  int doubts =
      0;  ///< how often the signs left a choice: two quadrants forwards, which is taken, or backwards

  void follow(double u2, double du2) {
    const int here = sign_quadrant(u2, du2), step = (here - pattern + 5) % 4 - 1;  // -1, 0, 1 or 2
    doubts += step == 2 ? 1 : 0;
    quadrant += step;
    pattern = here;
  }
};

/// Cells of one row of a chart in one box: from half-period factors to layers.
struct CellRow {
  std::size_t count = 0;
  std::array<const double*, 4> factors{};  ///< u1, kappa u2, u1'/kappa, u2' with the box's kappa and exponent
  /// Instead of the factors: D, of cells between which it does not come to +-2, so that `turns` is the same
  /// in all of them; its error, as Monodromy::error, and a bound of what D itself may be off.
  const double* discriminant = nullptr;
  double discriminant_error = 0.0, discriminant_bound = 0.0;
  std::array<double, 4> factor_error{};
  long exponent = 0;
  double box_kappa = 1.0;
  bool shifted = false;           ///< see FactorScale
  const double* kappa = nullptr;  ///< per cell, canonical
  const double* inverse_kappa = nullptr;
  DampingRow damping{};
  bool damped = true;  ///< false: h = 0 in all cells

  /// For the winding: the angle of (u2', u2) in quarter turns, to less than two of them. Without it, those of
  /// the cell before the first, which become those of the last.
  const double* quarter_turns = nullptr;
  Turns turns;

  /// Results per cell; those without a place are left out. error: Monodromy::error. `verdict` as the
  /// enumerator's value.
  double *error = nullptr, *verdict = nullptr, *margin = nullptr, *growth = nullptr, *winding = nullptr,
         *trace = nullptr;

  /// The largest error of all cells, NaN if one is; if `error` has no place, a bound of them made of what
  /// neighbouring cells have in common.
  double largest_error = 0.0;
  bool all_resolved = false;  ///< no verdict is `unresolved`, which without `error` are some more
};

/// Growth, in ln|D| and h, that `plain_cells` takes.
inline constexpr double kMostPlainLog = 190.0;

/// As Monodromy and floquet/verdict do it, one cell after the other; any growth and damping.
void cells_in_log_form(CellRow& row);

/// The same in vector code, for |D| and h up to kMostPlainLog. Inputs must be readable up to the next
/// multiple of 8 cells. Products near the edge of their bounds count as unresolved.
void plain_cells(CellRow& row);

/// Where D is in some cells: near 2 or -2 in one of them, or in none and on one side in all.
enum class TraceSide { near, between, above, below };

/// Of each block of `block` cells, a multiple of 8; the last may be shorter. Near: within `least_gap`.
void trace_sides(const double* trace, std::size_t count, std::size_t block, double least_gap,
                 TraceSide* result);

}  // namespace strutt
