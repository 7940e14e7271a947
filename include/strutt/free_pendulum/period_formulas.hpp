#pragma once

#include <span>
#include <vector>

#include "strutt/free_pendulum/period.hpp"

namespace strutt {

// Approximate formulas of T/T0 of a libration of amplitude A, and what they are worth (paper, Fig. 3):
//   normal_form      1/(1 - A^2/16)        (22) with beta = -alpha/16, A < 4
//   krylov           1/(1 - A^2/16)        (31), the same function of the amplitude
//   krylov_squared   1/sqrt(1 - A^2/8)     the remark after (31), A < sqrt(8)
//   series           1 + A^2/16 + 11 A^4/3072 + ... + c_12 A^12 (frequency_series.hpp)

/// All of them, those of least cost first.
std::span<const PeriodMethod> period_formulas();

/// T/T0 by a formula, and how far that is from the true value of the pendulum.
struct FormulaError {
  double ratio = 1.0;           ///< T/T0 by the formula
  double relative_error = 0.0;  ///< ratio/exact - 1, signed
};
/// What rounding may add to a relative error: of formula and exact value, and of an amplitude formed from
/// from_top or an excess.
inline constexpr double kFormulaRounding = 2e-15;

/// Where a formula loses its meaning: min(pi, its pole).
double formula_limit(PeriodMethod formula);

/// T/T0 by a formula, correct to 4 eps, and its true relative error, to kFormulaRounding absolute. Throws
/// InvalidInput unless 0 <= amplitude <= formula_limit, the pole itself excluded, and for methods that are no
/// approximation.
FormulaError formula_error(PeriodMethod formula, double amplitude);

/// The largest A such that |relative error| + kFormulaRounding <= tolerance on all of [0, A], by root finding
/// on the exact error; 0 if there is none. The error of (31) is not monotone: it grows to 3.5e-3 at 2.08 rad
/// and vanishes at 2.46309 rad, beyond which it is negative, so it is the first crossing that counts.
/// Relative error of A below 1e-9 for tolerances from 1e-12 on. Throws InvalidInput unless tolerance > 0.
double formula_reach(PeriodMethod formula, double tolerance);

/// The cheapest way to T/T0 that is good enough: the first of period_formulas() within whose reach the
/// amplitude is, else the closed form.
class CheapestPeriod {
 public:
  /// Finds the reaches, once. Throws InvalidInput unless tolerance > 0.
  explicit CheapestPeriod(double tolerance);

  PeriodMethod method(double amplitude) const;  ///< elliptic if no formula is good enough, and for NaN

  /// The libration `exact` of this amplitude by the formula chosen; `error` bounds the true relative error.
  /// What is no libration (amplitude NaN or pi) comes back as it is.
  Period replace(const Period& exact, double amplitude, const Eigenfrequency& alpha = {}) const;

 private:
  struct Reach {
    PeriodMethod formula;
    double amplitude;
  };
  std::vector<Reach> reaches_;
};

}  // namespace strutt
