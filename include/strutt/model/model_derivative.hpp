#pragma once

#include <string_view>
#include <variant>

#include "strutt/model/scene.hpp"

namespace strutt {

/// How a Hill equation X'' + (c/Omega) X' + W(theta) X = 0 changes with a parameter p, at fixed canonical
/// time.
struct HillDerivative {
  double angular_frequency = 0.0;  ///< dOmega/dp
  double damping = 0.0;            ///< dc/dp
  PeriodicFunction coefficient;    ///< dW/dp
};

/// How M q'' + C(t) q' + K(t) q = 0 changes with a parameter, at a fixed phase. Empty matrices stand for
/// zero.
struct SystemDerivative {
  double period = 0.0;
  Eigen::MatrixXd mass;
  PeriodicMatrix damping;
  PeriodicMatrix stiffness;
};

using ModelDerivative = std::variant<HillDerivative, SystemDerivative>;

/// The derivative of linear_model(scene) with respect to the parameter that `path` names: a closed form, good
/// to a few roundings. A shift of time alone changes no exponent: support.phase counts as without effect, as
/// do the parameters of [moment] and the mass of a rod or point mass. Throws InvalidInput for an unknown
/// path.
ModelDerivative model_derivative(const Scene& scene, std::string_view path);

/// False if no value of this parameter changes the stability.
bool moves_stability(const Scene& scene, std::string_view path);

}  // namespace strutt
