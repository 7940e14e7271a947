#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include "strutt/base/method.hpp"
#include "strutt/chart/tongues.hpp"
#include "strutt/floquet/stability.hpp"

namespace strutt {

inline constexpr int kNoTongue = -1;  ///< of systems, which have no winding number

/// Where stability ends or begins on a line.
struct LineEdge {
  double position = 0.0;
  double error = 0.0;  ///< bound of |position - true| / max(1, |position|)
  Method method = Method::fourier;
  Outcome outcome = Outcome::converged;
};

/// An unstable interval of a line; an end that is not between the ends of the line is missing.
struct UnstableInterval {
  int tongue = kNoTongue;
  std::optional<LineEdge> begin, end;
};

struct IntervalOptions {
  double tolerance = 1e-12;
  int samples = 32;  ///< of the line, where no proof is possible
  const std::atomic<bool>* cancel = nullptr;
};

/// The unstable intervals of a line, ascending. By tongues() where it knows the scene: complete, with proved
/// indices. Else by the sign of the margin at equidistant points and at the minima and maxima between them:
/// an interval narrower than that may be missed; the edges found are enclosed between certain verdicts on
/// both sides. Closed tongues are no intervals. Throws NumericalFailure for an undamped line that passes more
/// than kLargestTongue tongues.
std::vector<UnstableInterval> unstable_intervals(const Scene& scene, const TongueLine& line,
                                                 const IntervalOptions& options);

/// Verdict and winding of a scene along a parameter.
class MarginLine {
 public:
  MarginLine(const Scene& scene, const std::string& path) : scene_(scene), value_(&parameter(scene_, path)) {}
  MarginLine(const MarginLine&) = delete;

  Stability at(double p, bool winding = false);
  std::vector<Stability> at(const std::vector<double>& p);

 private:
  MonodromyEngine engine_;
  Scene scene_;
  double* value_;
};

/// Hill's equation without damping, with finitely many harmonics?
bool is_undamped_fourier(const LinearModel& model);

/// The margin of a scene as it stands, as sharp as it can be had.
MonodromyOptions sharpest();

}  // namespace strutt
