#pragma once

#include <map>
#include <optional>
#include <vector>

#include "chart/known_tongue.hpp"
#include "strutt/chart/tongues.hpp"
#include "strutt/floquet/monodromy.hpp"

namespace strutt {

/// The equation on a line in canonical time without its damping g: Y'' + (mean + V) Y = 0, Y = exp(g theta/2)
/// X.
struct LinePoint {
  double parameter = 0.0;
  double mean = 0.0;            ///< that of X less g^2/4
  PeriodicFunction variation;   ///< V, with finitely many harmonics or a square wave
  double damping_shift = 0.0;   ///< g^2/4
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

  /// The Hill equation of a scene, also of [linear] with one degree of freedom; nothing if it has none.
  static std::optional<HillEquation> hill_equation_of(const Scene& scene);

  LinePoint at(double parameter);
  /// The edges of a tongue of Mathieu's equation; many orders at once where V is the same all along the line.
  TongueEdges mathieu_tongue(double epsilon, int order);
  bool one_variation() const { return one_variation_; }  ///< V is the same all along the line
  double half_damping(double parameter);                 ///< cT/2
  double growth(double parameter);                       ///< by the monodromy matrix

 private:
  HillEquation equation(double parameter);

  MonodromyEngine engine_;
  Scene scene_;
  double* value_;
  bool one_variation_ = false;
  std::vector<TongueEdges> mathieu_;  ///< of the orders that were asked for last
  double mathieu_epsilon_ = 0.0;
};

/// F(p) = mean(p) - edge(V(p)) of both edges of one tongue.
class EdgeFunction {
 public:
  EdgeFunction(LineEquation& line, KnownTongue& tongue) : line_(line), tongue_(tongue) {}

  struct Value {
    LinePoint point;
    TongueEdges edges;
    double below(bool upper) const;  ///< F: how far the mean is above the edge
    double error(bool upper) const;
    const CharacteristicValue& edge(bool upper) const { return upper ? edges.upper : *edges.lower; }
  };
  const Value& at(double parameter);
  int order() const { return tongue_.order(); }
  KnownTongue& tongue() { return tongue_; }

  /// How far F is, between two places, from the straight line in A through its values there, at most. Nothing
  /// unless V = A s with one cosine or square wave s, A of one sign and one mean, or where edges of the same
  /// symmetry are too close together, for |edge''| <= 2 max(s)^2/(distance to the next of its symmetry); nor
  /// for square waves if the edges have changed places.
  std::optional<double> bend(const Value& a, const Value& b, bool upper);

  /// The mean of F' over [from, to], by Chebyshev interpolation in a window around it inside [least, most],
  /// and an estimate of its relative error. Nothing if the window would be too narrow.
  struct Slope {
    double value = 0.0;
    double relative_error = 0.0;
  };
  std::optional<Slope> slope(bool upper, double from, double to, const TongueLine& within);

 private:
  TongueEdges edges_of(const LinePoint& point, int order);
  /// From an edge to the next of its symmetry, at least.
  double gap(const Value& value, bool upper);

  LineEquation& line_;
  KnownTongue& tongue_;
  std::map<double, Value> known_;
};

}  // namespace strutt
