#pragma once

#include <optional>
#include <vector>

#include "chart/edge_function.hpp"
#include "chart/edge_zeros.hpp"

namespace strutt {

/// The relative error of a width that is promised.
inline constexpr double kWidthPromise = 1e-10;

/// A stretch of the line inside a tongue; an end that is not on the line is missing.
struct Stretch {
  std::optional<EdgeZero> begin, end;
};

/// Tongue n of the undamped equation on a line.
class TongueOnLine {
 public:
  TongueOnLine(LineEquation& equation, KnownTongue& tongue, const TongueLine& line,
               const TongueOptions& options)
      : line_equation_(equation), function_(equation, tongue), line_(line), options_(options) {}

  EdgeFunction& function() { return function_; }

  std::vector<Stretch> stretches();
  std::vector<TongueEdge> edges();  ///< see tongues()

  TongueEdge edge(const EdgeZero& zero, bool upper, int crossing);

  /// Of a stretch with both ends; see tongues().
  TongueWidth width_of(const EdgeZero& begin, const EdgeZero& end, const TongueEdge& low,
                       const TongueEdge& high);
  TongueWidth width_by_slope(const EdgeZero& begin, const EdgeZero& end);

 private:
  bool inside(double position);
  double secant(const EdgeZero& zero);
  /// How far from a zero F is, on both sides, certainly not zero, or the line ends.
  double certain_distance_from(const EdgeZero& zero);
  void add_width(const Stretch& stretch, std::vector<TongueEdge>& edges, std::size_t first);
  void add_growth(const EdgeZero& end, TongueEdge& low, TongueEdge& high);

  LineEquation& line_equation_;
  EdgeFunction function_;
  const TongueLine& line_;
  const TongueOptions& options_;
};

}  // namespace strutt
