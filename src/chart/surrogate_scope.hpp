#pragma once

#include <optional>
#include <string>
#include <vector>

#include "strutt/chart/surrogate.hpp"
#include "strutt/floquet/stability.hpp"

namespace strutt {

/// What a surrogate over two axes interpolates, judged at the corners, in the middles of the edges and in the
/// centre.
struct SurrogateScope {
  SurrogateKind kind = SurrogateKind::period;
  std::optional<double> even_phase;  ///< kind half_period: about which the coefficient is even everywhere
  bool is_system = false;            ///< not a Hill equation
  bool splits_damping = false;       ///< systems: some have proportional damping, which is split off
  std::string refusal;               ///< empty: there can be one
};
SurrogateScope surrogate_scope(const Scene& scene, const Axis& x, const Axis& y);

/// The models there, the centre first; nothing if there is none somewhere.
std::optional<std::vector<LinearModel>> sampled_models(const Scene& scene, const Axis& x, const Axis& y);

/// The Hill equation that a model is, if it is one.
std::optional<HillEquation> hill_equation_of(const LinearModel& model);

/// Jumps or kinks in the coefficient?
bool is_square(const PeriodicFunction& w);

/// As in PeriodicFunction::even_centre: what is left of the sines is rounding.
bool is_even_about(const PeriodicFunction& w, double phase);

/// How the engine treats the damping of a system: none, split off from y = exp(ct/2) q, or part of the
/// matrix.
enum class SystemDamping { none, split_off, inside };
SystemDamping damping_of(const LinearPeriodicSystem& system);

}  // namespace strutt
