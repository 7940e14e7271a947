#pragma once

#include <array>

#include "strutt/free_pendulum/eigenfrequency.hpp"
#include "strutt/free_pendulum/period.hpp"

namespace strutt {

/// The approximate formulas of T/T0 as functions of the amplitude A, cheapest first:
///   normal_form     1/(1 - A^2/16), from the frequency alpha + beta r^2 with beta = -alpha/16 (paper, 22),
///   krylov          1/(1 - A^2/16), expansion of gamma (31): the same function by another way,
///   series          1 + A^2/16 + 11 A^4/3072 + ..., the exact series (frequency_series.hpp) up to A^12,
///   krylov_squared  1/sqrt(1 - A^2/8), expansion of gamma^2.
inline constexpr std::array<PeriodMethod, 4> kPeriodFormulas{
    PeriodMethod::normal_form, PeriodMethod::krylov, PeriodMethod::series, PeriodMethod::krylov_squared};

/// T/T0 by a formula alone, without its error: correct to 4 eps for an amplitude in
/// [0, 3.141592653589793] rad; NaN from krylov_limit on. Throws InvalidInput as formula_of_amplitude does.
double formula_ratio(PeriodMethod formula, double amplitude);

/// T/T0 by a formula, and how far that is from the true value of the pendulum.
struct FormulaError {
  double ratio = 1.0;           ///< T/T0 by the formula
  double relative_error = 0.0;  ///< ratio/exact - 1, signed
};

/// T/T0 by a formula and its true relative error ratio/exact - 1, signed, for the orbit told by amplitude,
/// from_top or separatrix excess (period.hpp; same ranges). The error is that of the formula in exact
/// arithmetic, good to 1e-13 relative, near its zero at 2.46309 rad to 1e-28 absolute: in twice the working
/// precision, and at small amplitudes from the series of frequency or period, whose first terms cancel
/// exactly. The rounding of `ratio` itself, up to 1e-15, is not in it. Both are NaN where the formula has no
/// meaning: on the separatrix, for rotations, and from krylov_limit on. Throws InvalidInput for an orbit out
/// of range or a method that is no formula.
FormulaError formula_of_amplitude(PeriodMethod formula, double amplitude);
FormulaError formula_of_from_top(PeriodMethod formula, double from_top);
FormulaError formula_of_excess(PeriodMethod formula, double separatrix_excess);

/// The largest amplitude A such that |relative error| <= tolerance on all of [0, A], in rad. The error of
/// (31) rises to 3.53e-3 at 2.126 rad, vanishes at 2.46309 rad and falls to -1 at pi: its first crossing
/// counts. Found on the true error with TOMS 748 (Alefeld, Potra and Shi, ACM TOMS 21 (1995) 327), relative
/// accuracy 1e-13 unless the tolerance is within 1e-6 of the maximum, relative (there
/// 1e-8). 3.141592653589793 if the formula never leaves the tolerance. Throws InvalidInput unless tolerance >
/// 0 and finite, and for a method that is no formula.
double largest_amplitude(PeriodMethod formula, double tolerance);

/// Periods by the cheapest formula that is good enough: the first of kPeriodFormulas whose error, rounding
/// included, is within the tolerance on all of [0, amplitude]; else the closed form. `error` bounds the true
/// relative error of ratio and period. A rounding of 1.23e-15 is counted for every formula, so that smaller
/// tolerances always get the closed form.
class CheapestPeriod {
 public:
  /// Throws InvalidInput unless tolerance > 0 and finite.
  explicit CheapestPeriod(double tolerance);

  /// `elliptic` if no formula suffices. Throws InvalidInput unless amplitude >= 0.
  PeriodMethod method(double amplitude) const;

  /// T/T0 alone, within the tolerance (the closed form: within its own error). Some ten nanoseconds, where
  /// the functions below pay 0.5 microseconds for the true error of a formula. Throws InvalidInput unless 0
  /// <= amplitude <= 3.141592653589793.
  double ratio(double amplitude) const;

  Period of_amplitude(double amplitude, const Eigenfrequency& alpha = {}) const;
  Period of_from_top(double from_top, const Eigenfrequency& alpha = {}) const;
  Period of_excess(double separatrix_excess, const Eigenfrequency& alpha = {}) const;

 private:
  std::array<double, kPeriodFormulas.size()> reach_{};  ///< largest amplitude of each formula; -1: none
};

}  // namespace strutt
