#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>

namespace strutt {

/// A complex number in the precision of `Real`.
template <typename Real>
struct WideComplex {
  Real re = 0, im = 0;

  WideComplex() = default;
  WideComplex(Real real) : re(std::move(real)) {}
  WideComplex(Real real, Real imaginary) : re(std::move(real)), im(std::move(imaginary)) {}
  friend WideComplex operator+(const WideComplex& a, const WideComplex& b) {
    return {a.re + b.re, a.im + b.im};
  }
  friend WideComplex operator-(const WideComplex& a, const WideComplex& b) {
    return {a.re - b.re, a.im - b.im};
  }
  friend WideComplex operator*(const WideComplex& a, const WideComplex& b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
};

/// The midpoint of a ball: what differs between real and complex numbers. `magnitude` is right to 1e-18.
template <typename Real>
struct MidpointTraits {
  using Scalar = Real;
  static long double magnitude(const Real& x) { return std::abs(x.template convert_to<long double>()); }
  static Real conjugate(const Real& x) { return x; }
  static Real real(const Real& x) { return x; }
  static Real absolute(const Real& x) { return abs(x); }
};

template <typename Real>
struct MidpointTraits<WideComplex<Real>> {
  using Scalar = Real;
  static long double magnitude(const WideComplex<Real>& x) {
    return std::hypot(x.re.template convert_to<long double>(), x.im.template convert_to<long double>());
  }
  static WideComplex<Real> conjugate(const WideComplex<Real>& x) { return {x.re, -x.im}; }
  static Real real(const WideComplex<Real>& x) { return x.re; }
  static Real absolute(const WideComplex<Real>& x) { return sqrt(Real(x.re * x.re + x.im * x.im)); }
};

/// All numbers within `radius` of `middle`. Every operation returns a ball that holds all exact results: the
/// radius carries what the operands may be off, and the rounding of the midpoint.
template <typename Value>
struct Ball {
  using Traits = MidpointTraits<Value>;
  using Scalar = typename Traits::Scalar;

  Value middle = Value(Scalar(0));
  long double radius = 0;

  /// Covers the roundings of the radius and of magnitude().
  static constexpr long double kUp = 1.0L + 0x1p-50L;
  /// Several roundings of the midpoint in one operation.
  static long double unit() {
    static const long double u =
        8 * std::numeric_limits<Scalar>::epsilon().template convert_to<long double>();
    return u;
  }

  long double size() const { return Traits::magnitude(middle) * kUp; }
  long double upper() const { return (size() + radius) * kUp; }              ///< no |x| in it is larger
  long double lower() const { return size() / (kUp * kUp) - radius * kUp; }  ///< none is smaller
  bool finite() const { return std::isfinite(radius); }
  Ball conjugate() const { return {Traits::conjugate(middle), radius}; }

  friend Ball operator+(const Ball& a, const Ball& b) {
    return rounded(a.middle + b.middle, a.radius + b.radius);
  }
  friend Ball operator-(const Ball& a, const Ball& b) {
    return rounded(a.middle - b.middle, a.radius + b.radius);
  }
  friend Ball operator*(const Ball& a, const Ball& b) {
    const long double x = a.size(), y = b.size();
    return {Value(a.middle * b.middle), (x * b.radius + (y + b.radius) * a.radius + unit() * x * y) * kUp};
  }

 private:
  static Ball rounded(Value middle, long double radius) {
    Ball result{std::move(middle), radius};
    result.radius = (result.radius + unit() * result.size()) * kUp;
    return result;
  }
};

/// 1/x for a ball of real numbers; of infinite radius if 0 may be among them.
template <typename Value>
Ball<Value> real_inverse(const Ball<Value>& x) {
  using Traits = MidpointTraits<Value>;
  using Scalar = typename Traits::Scalar;
  const long double nearest = x.lower(), size = x.size();
  if (!(nearest > 0)) return {Value(Scalar(1)), std::numeric_limits<long double>::infinity()};
  const Value inverse(Scalar(1 / Traits::real(x.middle)));
  return {inverse, (x.radius / nearest / size + Ball<Value>::unit() / size) * Ball<Value>::kUp};
}

/// A ball of real numbers as a ball of `Value`.
template <typename Value, typename Real>
Ball<Value> widened(const Ball<Real>& x) {
  return {Value(x.middle), x.radius};
}

}  // namespace strutt
