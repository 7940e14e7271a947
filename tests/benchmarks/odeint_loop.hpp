#pragma once

#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>

#include "sundials_loop.hpp"

namespace benchmarks {

/// Boost.odeint as its users call it, with controlled steps: Stepper is runge_kutta_fehlberg78 or
/// runge_kutta_dopri5.
template <template <typename...> typename Stepper>
class OdeintLoop {
 public:
  explicit OdeintLoop(Span span) : span_(span) {}
  void set_tolerance(double tolerance) { tolerance_ = tolerance; }

  Matrix compute(const Point& point, long& right_hand_sides) {
    namespace odeint = boost::numeric::odeint;
    using State = std::array<double, 4>;
    State y{1.0, 0.0, 0.0, 1.0};
    const auto f = [&](const State& x, State& dxdt, double t) {
      ++right_hand_sides;
      const double stiffness = -(point.delta + point.epsilon * std::cos(t)) / point.kappa;
      dxdt = {point.kappa * x[1], stiffness * x[0], point.kappa * x[3], stiffness * x[2]};
    };
    auto stepper = odeint::make_controlled(tolerance_, tolerance_, Stepper<State>());
    odeint::integrate_adaptive(stepper, f, y, 0.0, length(span_), 0.1);
    return monodromy(span_, y.data());
  }

 private:
  Span span_;
  double tolerance_ = 1e-9;
};

}  // namespace benchmarks
