#pragma once

#include <Eigen/Core>
#include <vector>

#include "strutt/chart/surrogate.hpp"

namespace strutt {

/// The bounds of a box that is evaluated by panels are larger by this at most.
inline constexpr double kPanelGrowth = 1.0 + 0x1p-6;

/// The functions of a box on a part [low, high] of its first axis (in its own coordinate, -1 to 1), where
/// polynomials of lower degree do. As in the box, coefficients[f](k, l) belongs to T_k T_l.
struct BoxPanel {
  double low = -1.0, high = 1.0;
  std::vector<Eigen::MatrixXd> coefficients;
  std::vector<double> error;  ///< what this adds to the bounds of the functions
};

/// A panel whose errors stay below (kPanelGrowth - 1) times those of the box; if that saves no quarter of the
/// terms, one with the functions as they are: the whole box.
BoxPanel panel_of(const SurrogateBox& box, double low, double high);

}  // namespace strutt
