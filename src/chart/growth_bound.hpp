#pragma once

#include <string>
#include <vector>

#include "strutt/chart/worst_growth.hpp"
#include "strutt/floquet/stability.hpp"

namespace strutt {

/// A scene whose uncertain parameters are set together.
class BoxScene {
 public:
  BoxScene(const Scene& scene, const std::vector<ParameterRange>& box);
  BoxScene(const BoxScene&) = delete;

  const Scene& at(const std::vector<double>& values);
  LinearModel model(const std::vector<double>& values) { return linear_model(at(values)); }
  Stability stability(const std::vector<double>& values);
  MonodromyEngine& engine() { return engine_; }

 private:
  MonodromyEngine engine_;
  Scene scene_;
  std::vector<double*> values_;
};

/// A box around a centre, and what is known of the growth in it.
struct GrowthCell {
  std::vector<double> low, high;
  double found = 0.0;       ///< growth at the centre
  double bound = 0.0;       ///< of the growth anywhere
  std::size_t longest = 0;  ///< the parameter along which W changes most
  std::vector<double> centre() const;
};

/// Fills in found, bound, longest of a cell of a scene with an equation of second order.
void bound_growth(BoxScene& scene, GrowthCell& cell);

}  // namespace strutt
