#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "strutt/floquet/sensitivity.hpp"
#include "strutt/floquet/stability.hpp"

namespace strutt {

/// A surface F = 0 in the space of the relative parameters x, p_i = value_i x_i, that bounds the region of
/// the design x = (1, ..., 1), where F > 0.
class EdgeSurface {
 public:
  /// The edge of a tongue of an undamped equation with finitely many harmonics.
  struct Edge {
    int tongue = 0;
    bool upper = false;
    double sign = 1.0;  ///< of mean - edge at the design
  };

  EdgeSurface(const Scene& scene, const std::vector<std::string>& parameters, std::optional<Edge> edge,
              double margin_sign);
  EdgeSurface(const EdgeSurface&) = delete;

  /// F with its error; NaN where there is no such scene.
  Margin at(const Eigen::VectorXd& x);

  /// The unit normal at a point of the surface, to the side on which F < 0 as seen along `ray`. Empty if it
  /// has none.
  Eigen::VectorXd normal(const Eigen::VectorXd& x, const Eigen::VectorXd& ray);

  std::vector<double> values(const Eigen::VectorXd& x) const;
  /// At a point of the surface where the tongue is closed, so that nothing ends there: the edge behind it.
  std::optional<Edge> behind_closed(const Eigen::VectorXd& x);
  std::optional<int> tongue(const Eigen::VectorXd& x);
  Method method() const { return method_; }

 private:
  void set(const Eigen::VectorXd& x);
  Eigen::VectorXd exact_gradient();
  Eigen::VectorXd difference_gradient(const Eigen::VectorXd& x, const Eigen::VectorXd& ray);

  Scene scene_;
  const std::vector<std::string>& parameters_;
  std::vector<double*> pointers_;
  Eigen::VectorXd value_;
  std::optional<Edge> edge_;
  double margin_sign_;
  MonodromyEngine engine_;
  Method method_ = Method::fourier;
};

/// The surfaces that bound the region of a design; none if it is no undamped equation with finitely many
/// harmonics. Throws NumericalFailure beyond kLargestTongue.
std::vector<EdgeSurface::Edge> bounding_edges(const Scene& scene, bool stable);

}  // namespace strutt
