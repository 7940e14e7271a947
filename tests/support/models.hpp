#pragma once

#include <string>
#include <vector>

#include "strutt/model/scene.hpp"

/// The models on which the law suite runs.
namespace strutt::test {

struct ModelCase {
  std::string name;
  LinearModel model;
  /// The system is Hamiltonian up to damping c M: M and K(t) symmetric, C skew and constant. Then the
  /// multipliers of N come in pairs (lambda, 1/lambda).
  bool reciprocal;
};

/// Hill equations and systems of four states of every kind: with and without symmetry and damping, jumping,
/// random (from fixed seeds), constant, and with tiny coefficients.
std::vector<ModelCase> every_model();

bool is_constant(const LinearModel& model);

/// The same equation, declared with twice its period. Hill's equation in Fourier form only.
HillEquation over_two_periods(const HillEquation& equation);
LinearPeriodicSystem over_two_periods(LinearPeriodicSystem system);

/// The same equation with t = 0 at the phase `phase`.
HillEquation shifted(HillEquation equation, double phase);
LinearPeriodicSystem shifted(LinearPeriodicSystem system, double phase);

}  // namespace strutt::test
