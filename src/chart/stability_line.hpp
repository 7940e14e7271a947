#pragma once

#include <atomic>
#include <complex>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "chart/evaluations.hpp"
#include "strutt/floquet/stability.hpp"

namespace strutt {

/// What the monodromy matrix says of a scene along a parameter.
class StabilityLine {
 public:
  struct Point {
    Margin margin;
    double growth = 0.0;
    std::complex<double> leading;  ///< multiplier of the largest modulus
    double gap =
        0.0;  ///< least -Re (a - b)^2/(a b) of two multipliers: negative where they have left the circle
    Method method = Method::automatic;

    bool unstable() const { return margin.value < -margin.error; }  ///< for certain
    bool stable() const { return margin.value > margin.error; }
  };

  /// `multipliers`: whether they are wanted. The engine keeps its plans from line to line. `evaluations`
  /// counts the points.
  StabilityLine(MonodromyEngine& engine, const Scene& scene, const std::string& path, bool multipliers,
                Evaluations* evaluations = nullptr);
  StabilityLine(const StabilityLine&) = delete;

  const Point& at(double parameter);

  /// The propagator over half a period of a system that is symmetric, even in time and undamped there;
  /// nothing for others.
  std::optional<BoundedMatrix> half_period(double parameter);

 private:
  MonodromyEngine& engine_;
  Scene scene_;
  double* value_;
  bool multipliers_;
  Evaluations* evaluations_;
  std::map<double, Point> known_;
};

/// Where a line enters or leaves what is unstable.
struct StabilityChange {
  double position = 0.0;
  double error = 0.0;        ///< on both sides, so far away, the verdicts are certain
  bool begins = false;       ///< unstable above
  double unstable_at = 0.0;  ///< the point beside it that is certainly unstable
};

struct ChangeSearch {
  int steps = 32;
  bool stable_from = false, stable_to = false;  ///< the ends are known to be stable
  double resolution =
      0.0;  ///< relative to max(1, |position|): positions and errors are good to that, no better
  const std::atomic<bool>* cancel = nullptr;
};

/// The changes between from and to that show among steps + 1 points at equal distances, or in a minimum of
/// the margin, of its negative or of the gap between multipliers that these points surround. No other is
/// looked for.
std::vector<StabilityChange> stability_changes(StabilityLine& line, double from, double to,
                                               const ChangeSearch& search);

/// The changes between neighbours of these points, at least two, in order. `steps` has no meaning here.
std::vector<StabilityChange> stability_changes(StabilityLine& line, const std::vector<double>& places,
                                               const ChangeSearch& search);

/// The largest growth in [from, to], and where: the best of so many points, and Brent's method about it.
struct GrowthPeak {
  double position, growth;
};
GrowthPeak largest_growth(StabilityLine& line, double from, double to, int steps);

}  // namespace strutt
