#pragma once

#include <optional>
#include <span>
#include <vector>

namespace strutt {

/// One term cosine * cos(order * theta) + sine * sin(order * theta), order >= 1.
struct Harmonic {
  int order = 1;
  double cosine = 0.0;
  double sine = 0.0;
};

/// A real function of the phase theta with period 2 pi, in one of two forms:
///   Fourier   f = mean + sum_k [a_k cos(k theta) + b_k sin(k theta)]
///   square    f = mean + amplitude * s_n(theta - shift), s_0 = sign(cos), s_n the n-th antiderivative of s_0
///   with
///             mean zero (n = 1 triangle, n = 2 parabolic arcs): Meissner's wave and the motion that produces
///             it.
/// Uniform samples are turned into the Fourier form (trigonometric interpolation), exact at the samples.
/// Values carry a rounding error of at most (3 n + 4 + k |theta|) 2^-53 bound(), with n harmonics up to order
/// k.
class PeriodicFunction {
 public:
  PeriodicFunction() = default;  ///< the zero function

  static PeriodicFunction constant(double mean);

  /// Orders >= 1, each at most once; terms that are zero are dropped. Throws InvalidInput.
  static PeriodicFunction fourier(double mean, std::vector<Harmonic> harmonics);

  /// mean + amplitude * s_n(theta - shift), n = antiderivative in {0, 1, 2}. Jumps of s_0 at shift +- pi/2.
  /// Throws InvalidInput.
  static PeriodicFunction square(double mean, double amplitude, double shift, int antiderivative = 0);

  /// Trigonometric interpolation of f(2 pi j / N), j = 0..N-1, N >= 1. For even N the highest term is the
  /// cosine.
  static PeriodicFunction samples(std::span<const double> values);

  double operator()(double theta) const;
  PeriodicFunction derivative() const;  ///< d/dtheta; of s_0 it throws InvalidInput (a sum of impulses)

  double mean() const { return mean_; }
  double deviation() const;         ///< an upper bound of |f - mean|, attained by a single wave
  double square_amplitude() const;  ///< the amplitude, with its sign, of the square form; 0 of the other
  double bound() const;             ///< an upper bound of |f|
  double lower_bound() const;       ///< a lower bound of f
  bool is_constant() const;         ///< no term besides the mean
  bool is_piecewise_constant() const;
  int highest_order() const;  ///< largest harmonic order, 0 if constant, 1 for a square wave
  std::span<const Harmonic> harmonics() const { return harmonics_; }

  /// theta0 in [0, pi] with f(theta0 + tau) = f(theta0 - tau) up to rounding of the coefficients, if there is
  /// one. (theta0 + pi is then another such point.)
  std::optional<double> even_centre() const;

  /// The largest sine part of a harmonic seen from theta0, relative to that harmonic: what centred() drops. 0
  /// for squares.
  double asymmetry(double theta0) const;

  PeriodicFunction shifted(double theta0) const;  ///< tau -> f(theta0 + tau)
  /// As shifted(theta0) for an even centre theta0, with the sine terms dropped (they are rounding).
  PeriodicFunction centred(double theta0) const;
  PeriodicFunction scaled(double factor) const;  ///< factor * f
  PeriodicFunction plus(double constant) const;  ///< f + constant

  /// Phases in (from, to), ascending, at which f jumps. Empty for smooth f and for antiderivatives of s_0.
  std::vector<double> breakpoints(double from, double to) const;

  /// The smooth function that equals f on the piece between jumps that contains `interior`.
  PeriodicFunction piece(double interior) const;

 private:
  enum class Form { fourier, square };
  Form form_ = Form::fourier;
  double mean_ = 0.0;
  std::vector<Harmonic> harmonics_;  // Fourier form, ascending order
  double amplitude_ = 0.0;           // square form
  double shift_ = 0.0;
  int antiderivative_ = 0;
};

}  // namespace strutt
