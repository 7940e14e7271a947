#pragma once

#include <map>
#include <optional>

#include "strutt/chart/tongues.hpp"
#include "strutt/floquet/monodromy.hpp"

namespace strutt {

/// The equation on a line, X'' + (mean + V) X = 0 in canonical time.
struct LinePoint {
  double parameter = 0.0;
  double mean = 0.0;
  PeriodicFunction variation;   ///< V
  double error = 0.0;           ///< a bound of what rounding has changed of the mean and, in norm, of V
  double relative_error = 0.0;  ///< of each coefficient
};

/// What the mean and V differ by in norm, at most; additive along a line on which each coefficient is
/// monotone, as it is for every parameter of a scene.
double change_between(const LinePoint& a, const LinePoint& b);

/// The equations of a scene along a parameter.
class LineEquation {
 public:
  LineEquation(const Scene& scene, const TongueLine& line);
  LineEquation(const LineEquation&) = delete;

  LinePoint at(double parameter);
  double growth(double parameter);  ///< by the monodromy matrix

 private:
  MonodromyEngine engine_;
  Scene scene_;
  double* value_;
};

/// F(p) = mean(p) - edge(V(p)) of both edges of one tongue.
class EdgeFunction {
 public:
  EdgeFunction(LineEquation& line, int order) : line_(line), order_(order) {}

  struct Value {
    LinePoint point;
    TongueEdges edges;
    double below(bool upper) const;  ///< F: how far the mean is above the edge
    double error(bool upper) const;
  };
  const Value& at(double parameter);
  int order() const { return order_; }

  /// The mean of F' over [from, to], by Chebyshev interpolation in a window around it inside [least, most],
  /// and an estimate of its relative error. Nothing if the window would be too narrow.
  struct Slope {
    double value = 0.0;
    double relative_error = 0.0;
  };
  std::optional<Slope> slope(bool upper, double from, double to, const TongueLine& within);

 private:
  TongueEdges edges_of(const LinePoint& point);

  LineEquation& line_;
  int order_;
  std::map<double, Value> known_;
  std::optional<Value> last_;
};

}  // namespace strutt
