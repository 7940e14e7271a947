#pragma once

#include <memory>
#include <vector>

#include "integrate/sundials.hpp"

namespace strutt::detail {

/// Turns the roots SUNDIALS saw within a step into events. Those of ARKODE, whose interpolant is much less
/// accurate than its steps, are located again by integrating from the start of the step.
class EventLocator {
 public:
  EventLocator(const Stepper& stepper, const IntegratorOptions& options)
      : stepper_(stepper), options_(options) {}

  /// The events within the last step, in order of time.
  std::vector<Event> locate(const RightHandSide& f, const EventRequest& request);
  void configure(const IntegratorOptions& options);
  /// What locating has cost since the last call of this function.
  long take_right_hand_sides();

 private:
  Event refine(const RightHandSide& f, const EventRequest& request, const Root& root);
  const Eigen::VectorXd& state_at(const RightHandSide& f, double t);

  const Stepper& stepper_;
  IntegratorOptions options_;
  std::unique_ptr<Stepper> refiner_;  // made when first needed
  Eigen::VectorXd state_;
  Eigen::VectorXd values_;
  long right_hand_sides_ = 0;
};

}  // namespace strutt::detail
