#pragma once

#include <array>
#include <cstddef>

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

/// Cells of one row of a chart in one box: from half-period factors to layers.
struct CellRow {
  static constexpr std::size_t kMost = 512;

  std::size_t count = 0;
  std::array<const double*, 4> factors{};  ///< u1, kappa u2, u1'/kappa, u2' with the box's kappa and exponent
  const double* quarter_turns = nullptr;   ///< the angle of (u2', u2), to less than two of them
  std::array<double, 4> factor_error{};
  long exponent = 0;
  double box_kappa = 1.0;
  bool shifted = false;           ///< see FactorScale
  const double* kappa = nullptr;  ///< per cell, canonical
  const double* inverse_kappa = nullptr;
  DampingRow damping{};
  bool with_growth = false, with_winding = false;

  /// Results. error: Monodromy::error. `verdict` as the enumerator's value.
  alignas(64) double error[kMost], verdict[kMost], margin[kMost], growth[kMost], winding[kMost], trace[kMost];
};

/// Growth, in ln|D| and h, that `plain_cells` takes.
inline constexpr double kMostPlainLog = 190.0;

/// As Monodromy and floquet/verdict do it, one cell after the other; any growth and damping.
void cells_in_log_form(CellRow& row);

/// The same in vector code, for |D| and h up to kMostPlainLog. Inputs must be readable, and
/// results are written, up to the next multiple of 16 cells. Products near the edge of their bounds count as
/// unresolved.
void plain_cells(CellRow& row);

}  // namespace strutt
