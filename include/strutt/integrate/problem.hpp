#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace strutt {

using StateView = Eigen::Ref<const Eigen::VectorXd>;
using StateOut = Eigen::Ref<Eigen::VectorXd>;

/// Right-hand side of y' = f(t, y): writes y' (same size as y). May throw; the exception reaches the caller
/// of the integrator unchanged and never crosses foreign frames.
using RightHandSide = std::function<void(double t, StateView y, StateOut dydt)>;

/// Event functions g(t, y): writes `count` values; an event is a sign change of one of them.
using EventFunction = std::function<void(double t, StateView y, StateOut g)>;

/// Which sign changes count, for one event function: from negative to positive, or back, as the run meets
/// them (a run towards smaller times meets the changes in reverse).
enum class Crossing { rising, falling, both };

/// The events to look for while integrating. `terminal`: stop at the first one. A zero exactly at the start
/// is not an event; two changes of one function within a step are missed (bound the step, if they could be).
struct EventRequest {
  EventFunction function;
  std::vector<Crossing> crossings;  ///< one per value of g
  bool terminal = true;
};

/// A located event: g[index] = 0 at time t up to the accuracy of the integration.
struct Event {
  int index = 0;
  double t = 0.0;
  Eigen::VectorXd state;
};

}  // namespace strutt
