#include "strutt/free_pendulum/jet.hpp"

#include <boost/math/differentiation/autodiff.hpp>

#include "strutt/base/error.hpp"

namespace strutt {
namespace {

using boost::math::differentiation::make_fvar;

constexpr int kOrder = 3;

}  // namespace

struct Jet::Value {
  boost::math::differentiation::autodiff_fvar<double, kOrder, kOrder> f;
};

template <typename Function>
Jet Jet::make(const Function& f) {
  Jet jet(0.0);
  jet.value_ = std::make_shared<const Value>(Value{f});
  return jet;
}

Jet::Jet(double constant) { value_ = std::make_shared<const Value>(Value{decltype(Value::f)(constant)}); }

// The sum with zero has both variables in its type.
Jet Jet::first_variable(double at) { return make(Jet(0.0).value_->f + make_fvar<double, kOrder>(at)); }
Jet Jet::second_variable(double at) { return make(Jet(0.0).value_->f + make_fvar<double, 0, kOrder>(at)); }

double Jet::coefficient(int j, int k) const {
  require(j >= 0 && k >= 0 && j + k <= kOrder, "degree of a coefficient", j + k, "0 to 3, both powers >= 0");
  return value_->f.at(static_cast<std::size_t>(j), static_cast<std::size_t>(k));
}

Jet Jet::operator-() const { return make(-value_->f); }
Jet operator+(const Jet& a, const Jet& b) { return Jet::make(a.value_->f + b.value_->f); }
Jet operator-(const Jet& a, const Jet& b) { return Jet::make(a.value_->f - b.value_->f); }
Jet operator*(const Jet& a, const Jet& b) { return Jet::make(a.value_->f * b.value_->f); }
Jet operator/(const Jet& a, const Jet& b) { return Jet::make(a.value_->f / b.value_->f); }

Jet sin(const Jet& x) { return Jet::make(sin(x.value_->f)); }
Jet cos(const Jet& x) { return Jet::make(cos(x.value_->f)); }
Jet tan(const Jet& x) { return Jet::make(tan(x.value_->f)); }
Jet atan(const Jet& x) { return Jet::make(atan(x.value_->f)); }
Jet exp(const Jet& x) { return Jet::make(exp(x.value_->f)); }
Jet log(const Jet& x) { return Jet::make(log(x.value_->f)); }
Jet sqrt(const Jet& x) { return Jet::make(sqrt(x.value_->f)); }
Jet sinh(const Jet& x) { return Jet::make(sinh(x.value_->f)); }
Jet cosh(const Jet& x) { return Jet::make(cosh(x.value_->f)); }
Jet tanh(const Jet& x) { return Jet::make(tanh(x.value_->f)); }
Jet pow(const Jet& x, double exponent) { return Jet::make(pow(x.value_->f, exponent)); }

}  // namespace strutt
