#pragma once

#include <array>
#include <memory>

namespace strutt {

/// A function of two variables known by its Taylor coefficients to third order: the number type to write a
/// right-hand side with when its coefficients are wanted (taylor_expansion). Arithmetic and the functions
/// below are those of a library for automatic differentiation; each is exact up to rounding. Outside the
/// domain of a function (sqrt or log of what is not positive, division by zero) coefficients are NaN or
/// infinite.
class Jet {
 public:
  Jet(double constant);  // NOLINT(google-explicit-constructor): constants mix with Jets in formulas
  static Jet first_variable(double at);
  static Jet second_variable(double at);

  /// Coefficient of (x1 - at1)^j (x2 - at2)^k, no factorials, j + k <= 3. Throws InvalidInput for other j, k.
  double coefficient(int j, int k) const;

  Jet operator-() const;
  friend Jet operator+(const Jet& a, const Jet& b);
  friend Jet operator-(const Jet& a, const Jet& b);
  friend Jet operator*(const Jet& a, const Jet& b);
  friend Jet operator/(const Jet& a, const Jet& b);
  Jet& operator+=(const Jet& other) { return *this = *this + other; }
  Jet& operator-=(const Jet& other) { return *this = *this - other; }
  Jet& operator*=(const Jet& other) { return *this = *this * other; }
  Jet& operator/=(const Jet& other) { return *this = *this / other; }

  friend Jet sin(const Jet& x);
  friend Jet cos(const Jet& x);
  friend Jet tan(const Jet& x);
  friend Jet atan(const Jet& x);
  friend Jet exp(const Jet& x);
  friend Jet log(const Jet& x);
  friend Jet sqrt(const Jet& x);
  friend Jet sinh(const Jet& x);
  friend Jet cosh(const Jet& x);
  friend Jet tanh(const Jet& x);
  friend Jet pow(const Jet& x, double exponent);

 private:
  struct Value;
  template <typename Function>
  static Jet make(const Function& f);
  std::shared_ptr<const Value> value_;
};

/// The two components of a planar field.
using JetPair = std::array<Jet, 2>;

}  // namespace strutt
