#pragma once

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <cmath>
#include <memory>

#include "sundials_loop.hpp"

namespace benchmarks {

/// GSL's rk8pd (Prince and Dormand, 8(9)) with the driver of its manual.
class GslLoop {
 public:
  explicit GslLoop(Span span) : span_(span) { gsl_set_error_handler_off(); }
  GslLoop(const GslLoop&) = delete;
  GslLoop& operator=(const GslLoop&) = delete;

  void set_tolerance(double tolerance) {
    driver_.reset(gsl_odeiv2_driver_alloc_y_new(&system_, gsl_odeiv2_step_rk8pd, 0.1, tolerance, tolerance));
  }

  Matrix compute(const Point& point, long& right_hand_sides) {
    problem_ = {point.delta, point.epsilon, point.kappa, 0};
    gsl_odeiv2_driver_reset_hstart(driver_.get(), 0.1);
    double y[4] = {1.0, 0.0, 0.0, 1.0}, t = 0.0;
    if (gsl_odeiv2_driver_apply(driver_.get(), &t, length(span_), y) != GSL_SUCCESS) y[0] = std::nan("");
    right_hand_sides += problem_.calls;
    return monodromy(span_, y);
  }

 private:
  static int right_hand_side(double t, const double* y, double* dydt, void* data) {
    auto& p = *static_cast<Mathieu*>(data);
    ++p.calls;
    const double stiffness = -(p.delta + p.epsilon * std::cos(t)) / p.kappa;
    dydt[0] = p.kappa * y[1];
    dydt[1] = stiffness * y[0];
    dydt[2] = p.kappa * y[3];
    dydt[3] = stiffness * y[2];
    return GSL_SUCCESS;
  }

  struct Free {
    void operator()(gsl_odeiv2_driver* driver) const { gsl_odeiv2_driver_free(driver); }
  };

  Span span_;
  Mathieu problem_{};
  gsl_odeiv2_system system_{right_hand_side, nullptr, 4, &problem_};
  std::unique_ptr<gsl_odeiv2_driver, Free> driver_;
};

}  // namespace benchmarks
