#pragma once

#include <benchmark/benchmark.h>

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mathieu_points.hpp"

/// What is compared, and the search for the tolerance at which it is compared.
namespace benchmarks {

/// The matrices of all points, and what they cost.
struct Answers {
  std::vector<Matrix> matrices;
  long right_hand_sides = 0;
};

/// A method with one knob: computes the matrices of all points with this tolerance.
struct Contestant {
  std::string name;
  std::function<void(double tolerance, Answers&)> compute;
};

inline double largest_error(const Answers& answers, const std::vector<Point>& points) {
  double largest = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double error = scaled_error(answers.matrices[k], points[k].exact);
    if (!(error <= largest)) largest = error;
  }
  return largest;
}

/// The contestant for an integrator with set_tolerance(T) and compute(point, right_hand_sides).
template <typename Loop, typename... Arguments>
Contestant contestant(std::string name, const std::vector<Point>& points, Arguments&&... arguments) {
  auto loop = std::make_shared<Loop>(std::forward<Arguments>(arguments)...);
  return {std::move(name), [loop, &points](double tolerance, Answers& answers) {
            loop->set_tolerance(tolerance);
            answers.right_hand_sides = 0;
            answers.matrices.resize(points.size());
            for (std::size_t k = 0; k < points.size(); ++k) {
              answers.matrices[k] = loop->compute(points[k], answers.right_hand_sides);
            }
          }};
}

using LargestError = double (*)(const Answers&, const std::vector<Point>&);

/// The tolerance that reaches the target with the fewest right-hand sides; empty: none does.
inline std::optional<double> tuned_tolerance(const Contestant& c, const std::vector<Point>& points,
                                             double target, LargestError error_of = largest_error) {
  constexpr int kPerDecade = 8;
  std::optional<double> best;
  long fewest = std::numeric_limits<long>::max();
  Answers answers;
  for (int k = -1 * kPerDecade; k >= -15 * kPerDecade; --k) {
    const double tolerance = std::pow(10.0, static_cast<double>(k) / kPerDecade);
    c.compute(tolerance, answers);
    if (best && answers.right_hand_sides > fewest + fewest / 2) break;  // from here on they only grow
    if (!(error_of(answers, points) <= target) || answers.right_hand_sides >= fewest) continue;
    best = tolerance;
    fewest = answers.right_hand_sides;
  }
  return best;
}

}  // namespace benchmarks
