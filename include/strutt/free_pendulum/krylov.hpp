#pragma once

namespace strutt {

/// Which series Krylov's technique expands in the amplitude mu (paper, eqs. 23-31 and the remark after them).
enum class KrylovVariant {
  frequency,  ///< gamma = alpha + mu^2 h2 (26): gamma/alpha = 1 - mu^2/16, T/T0 = 1/(1 - mu^2/16) (31)
  frequency_squared,  ///< gamma^2 = alpha^2 + mu^2 h2: gamma/alpha = sqrt(1 - mu^2/8), T/T0 = 1/sqrt(1 -
                      ///< mu^2/8)
};

/// Amplitude where the frequency of the variant reaches zero, in rad: 4 or sqrt(8). The formula has no
/// meaning beyond; neither has it for the pendulum beyond pi.
double krylov_limit(KrylovVariant variant);

/// Krylov's approximation of phi'' + alpha^2 sin(phi) = 0, phi(0) = mu, phi'(0) = 0:
///
///     phi(t) = mu cos(gamma t) + mu^3 phi3(t),   phi3'' + gamma^2 phi3 = (alpha^2/24) cos(3 gamma t),
///     phi3(0) = phi3'(0) = 0 (25),   so   phi3 = alpha^2/(192 gamma^2) (cos(gamma t) - cos(3 gamma t)).
///
/// phi(0) = mu is exact. The error of the waveform over one period is of order mu^5; over time it grows by
/// the error of the frequency, t (gamma - true frequency) mu.
class KrylovMotion {
 public:
  /// alpha > 0 in rad/s, |amplitude| below krylov_limit, in rad. Throws InvalidInput otherwise.
  KrylovMotion(KrylovVariant variant, double alpha, double amplitude);

  double frequency() const { return frequency_; }            ///< gamma, rad/s
  double period() const;                                     ///< 2 pi/gamma, s
  double third_harmonic() const { return third_harmonic_; }  ///< mu^3 alpha^2/(192 gamma^2), rad
  double angle(double time) const;                           ///< phi, rad
  double velocity(double time) const;                        ///< phi', rad/s

 private:
  double amplitude_, frequency_, third_harmonic_;
};

/// gamma/alpha and its inverse T/T0 of a variant, correct to 4 eps. Throws InvalidInput unless |amplitude| is
/// below krylov_limit.
double krylov_frequency_ratio(KrylovVariant variant, double amplitude);
double krylov_period_ratio(KrylovVariant variant, double amplitude);

/// Separatrix of the cubic truncation (11), sqrt(6) rad.
double cubic_separatrix();

/// Exact T/T0 of the cubic truncation phi'' + alpha^2 phi = alpha^2 phi^3/6 (11), a Duffing oscillator that
/// softens:
///
///     T/T0 = 1/AGM(sqrt(1 - A^2/12), sqrt(1 - A^2/6)),   0 <= A < sqrt(6),
///
/// from phi = A sin(theta) in its energy integral (docs/normal-form.md). Relative error <= 4 eps for the A
/// given; sqrt(6) - A is formed without cancellation. Throws InvalidInput outside the range.
double cubic_period_ratio(double amplitude);

/// r of z from general initial conditions as the paper takes it, r^2 = phi0^2 + (phi0'/alpha)^2 (below eq.
/// 21). It is the amplitude of the linear motion. The true amplitude A obeys sin^2(A/2) = sin^2(phi0/2) +
/// (phi0'/(2 alpha))^2; from phi0 = 0 r = A - A^3/24 + ..., which makes the period in (22) wrong by -A^4/192
/// relative, 16 times the error A^4/3072 that (22) has with A itself. Throws InvalidInput unless alpha > 0
/// and all are finite.
double linear_amplitude(double alpha, double angle, double velocity);

}  // namespace strutt
