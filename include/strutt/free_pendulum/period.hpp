#pragma once

#include <span>
#include <string_view>

#include "strutt/free_pendulum/eigenfrequency.hpp"

namespace strutt {

// Periods of the free pendulum phi'' + alpha^2 sin(phi) = 0, T0 = 2 pi/alpha, in closed form (10):
//   libration: T/T0 = 1/AGM(1, k'), k' = cos(amplitude/2) = sin(from_top/2) = sqrt(-E)/2,
//   rotation:  T/T0 = 1/AGM(sqrt(4 + E), sqrt(E)), T the time of one full turn of 2 pi,
// with E the separatrix excess (energy.hpp). From 1e-300 away from rest to 1e-300 away from the separatrix;
// the last double below pi is an ordinary amplitude (T/T0 = 24.65). Inputs are taken as exact.

/// A positive number and a bound of its relative error, the rounding of the number itself included (also
/// where it falls below the normal doubles: above 1 where it is rounded to 0).
struct BoundedNumber {
  double value = 0.0;
  double error = 0.0;
};

/// T/T0 of a libration. Error <= 0.8 ulp for every argument. Amplitude 0 gives 1; from_top 0 (the separatrix)
/// gives +inf. Amplitude in [0, 3.141592653589793], from_top in [0, 3.141592653589793]: outside, and for NaN,
/// the result is NaN (these two and their batches are the only functions here that do not throw).
double period_ratio(double amplitude);
double period_ratio_from_top(double from_top);

/// The same, element by element and to the same bits, for any length: 2 to 4 ns each. Which instruction set
/// runs is chosen at run time (base/instruction_set.hpp); all give the same bits. `ratio` may be the input
/// itself. Throws InvalidInput unless both have the same size.
void period_ratios(std::span<const double> amplitude, std::span<double> ratio);
void period_ratios_from_top(std::span<const double> from_top, std::span<double> ratio);

/// How a period was found.
enum class PeriodMethod : signed char {
  elliptic,     ///< the closed form
  separatrix,   ///< infinite
  normal_form,  ///< this and the following: period_formulas.hpp
  krylov,
  krylov_squared,
  series,
};
/// As written to files: the enumerator.
std::string_view to_string(PeriodMethod method);

/// A period. `error` bounds the relative errors of all three.
struct Period {
  double ratio = 1.0;    ///< T/T0
  double period = 0.0;   ///< T, s for alpha in rad/s
  double quarter = 0.0;  ///< T/4; in a libration the time from the bottom to the turning point
  /// <= 3.5e-16 (more where T/4 is below 1e-307, above 1 where it is rounded to 0); 0 on the
  /// separatrix, where ratio and period are +inf.
  double error = 0.0;
  PeriodMethod method = PeriodMethod::elliptic;
};

/// Throws InvalidInput for an argument outside the ranges above (E >= -4 and finite: -4 is rest, ratio 1; 0
/// the separatrix).
Period period_of_amplitude(double amplitude, const Eigenfrequency& alpha = {});
Period period_of_from_top(double from_top, const Eigenfrequency& alpha = {});
Period period_of_excess(double separatrix_excess, const Eigenfrequency& alpha = {});

/// d(T/T0)/dE > 0 for librations, -d(T/T0)/dE > 0 for rotations (both grow towards the separatrix). With E(k)
/// the complete integral of the second kind and w = sqrt(4 + E):
///   libration: (E(k) - k'^2 K)/(4 pi k^2 k'^2), k' = sqrt(-E)/2;   rotation: -E(k)/(pi w E), k = 2/w.
/// Throws InvalidInput unless E >= -4, finite and not 0.
BoundedNumber period_ratio_slope_magnitude(double separatrix_excess);

/// The libration that has a given period: T/T0 = ratio, 1 <= ratio <= 440 (else InvalidInput). `error` bounds
/// the relative error of both.
struct LibrationOfPeriod {
  double amplitude = 0.0;
  double from_top = 0.0;  ///< pi - amplitude without cancellation
  double error = 0.0;
};
LibrationOfPeriod libration_of_period_ratio(double ratio);

/// Time from the bottom to `angle`, F(psi, k)/alpha with sin(psi) = sin(angle/2)/sin(amplitude/2), 0 <= angle
/// <= amplitude
/// <= 3.141592653589793; a quarter period for angle = amplitude.
BoundedNumber libration_time_of_flight(double amplitude, double angle, const Eigenfrequency& alpha = {});

/// The same for a rotation, psi = angle/2 and 2/(w alpha) F(psi, k), 0 <= angle <= 1e9, E > 0 and finite.
BoundedNumber rotation_time_of_flight(double separatrix_excess, double angle,
                                      const Eigenfrequency& alpha = {});

}  // namespace strutt
