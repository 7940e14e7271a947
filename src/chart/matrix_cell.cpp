#include "chart/matrix_cell.hpp"

#include <algorithm>

#include "chart/cell_engine.hpp"
#include "chart/point_equation.hpp"
#include "chart/surrogate_scope.hpp"
#include "strutt/base/error.hpp"

namespace strutt {

MatrixCell::MatrixCell(const Scene& scene, const ChartRequest& request)
    : scene_(scene),
      x_(&parameter(scene_, request.x.parameter)),
      y_(&parameter(scene_, request.y.parameter)),
      tolerance_(request.tolerance),
      parts_(parts_of(request.layers)) {}

Stability MatrixCell::assess(double x, double y, const SurrogateBox& box, const Eigen::MatrixXd& value,
                             const Eigen::MatrixXd& error) {
  *x_ = x;
  *y_ = y;
  try {
    const auto model = linear_model(scene_);
    const auto scale = point_equation(model, std::nullopt);
    if (!scale) return {};
    const auto propagator = at_kappa(value, error, scale->sample.kappa / box.kappa);
    if (const auto equation = hill_equation_of(model)) {
      return strutt::assess(*equation,
                            hill_monodromy_of(SurrogateKind::period, propagator, box.exponent, scale->sample,
                                              scale->angular_frequency, tolerance_),
                            parts_);
    }
    return strutt::assess(
        std::get<LinearPeriodicSystem>(model),
        system_monodromy_of(propagator, box.exponent, scale->sample, scale->angular_frequency, tolerance_),
        parts_);
  } catch (const InvalidInput&) {
    return {};  // no model there
  }
}

}  // namespace strutt
