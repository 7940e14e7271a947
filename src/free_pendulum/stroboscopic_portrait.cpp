#include "strutt/free_pendulum/stroboscopic_portrait.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>

#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"
#include "strutt/base/parallel.hpp"
#include "strutt/free_pendulum/energy.hpp"

namespace strutt {
namespace {

using std::numbers::pi;

// A chaotic motion is found out over so many sections before it is followed over all of them in vain.
constexpr int kProbe = 64;

// Velocities of the starts reach beyond the separatrix, whose largest |phi'/alpha| is 2.
constexpr double kLargestVelocity = 2.75;

double section_period(const PhysicalPendulum& pendulum, const Excitation* support, const Excitation* moment) {
  if (support != nullptr) return 2.0 * pi / support->frequency;
  if (moment != nullptr && !moment->function.is_constant()) return 2.0 * pi / moment->frequency;
  return pendulum.period();
}

/// Counts what is done and tells it, one thread at a time.
class Tally {
 public:
  Tally(const StroboscopicOptions& options, std::size_t total) : options_(options), total_(total) {}

  void add_one() {
    if (!options_.progress) return;
    const std::lock_guard lock(mutex_);
    options_.progress(++done_, total_);
  }

 private:
  const StroboscopicOptions& options_;
  std::size_t done_ = 0, total_;
  std::mutex mutex_;
};

/// Into [-half, half).
double wrapped(double angle, double half) {
  const double result = std::remainder(angle, 2.0 * half);
  return result == half ? -half : result;
}

/// The system, and where the sections are.
struct Strobe {
  const PhysicalPendulum& pendulum;
  const Excitation* support;
  const Excitation* moment;
  const StroboscopicOptions& options;
  std::vector<double> times;

  Motion follow(const MotionStart& start, std::size_t sections) const {
    return integrate_motion(
        pendulum, support, moment, start, std::span(times).first(sections),
        {.tolerance = options.tolerance, .method = options.method, .cancel = options.cancel});
  }
};

bool all_converged(const Motion& motion) {
  return std::all_of(motion.points.begin(), motion.points.end(),
                     [](const auto& p) { return p.outcome == Outcome::converged; });
}

struct Followed {
  PhaseCurve curve;
  IntegrationCost cost;
};

Followed follow(const Strobe& strobe, const MotionStart& start) {
  const std::size_t probe = std::min<std::size_t>(kProbe, strobe.times.size());
  Motion motion = strobe.follow(start, probe);
  Followed result;
  result.cost += motion.cost;
  result.cost += motion.estimate_cost;
  if (probe < strobe.times.size() && all_converged(motion)) {
    motion = strobe.follow(start, strobe.times.size());
    result.cost += motion.cost;
    result.cost += motion.estimate_cost;
  }
  const double half = window_half_width(strobe.options.cells);
  const EnergyIntegral energy = energy_integral(start.angle, start.velocity / strobe.pendulum.alpha());
  result.curve = {CurveKind::section, energy.separatrix_excess, {}};
  result.curve.points.push_back({wrapped(start.angle, half), start.velocity});
  for (const MotionPoint& p : motion.points) {
    if (p.outcome != Outcome::converged) break;
    result.curve.points.push_back({wrapped(p.angle, half), p.velocity});
  }
  return result;
}

}  // namespace

void StroboscopicOptions::validate() const {
  require(cells >= 1 && cells <= 1000, "cells", cells, "between 1 and 1000");
  require(sections >= 1, "sections", sections, "at least 1");
  require(threads >= 0, "threads", threads, "at least 0");
  MotionOptions{.tolerance = tolerance, .method = method}.validate();
}

StroboscopicPortrait stroboscopic_portrait(const PhysicalPendulum& pendulum, const Excitation* support,
                                           const Excitation* moment, std::span<const MotionStart> starts,
                                           const StroboscopicOptions& options) {
  const DefaultFloatingPoint environment;
  options.validate();
  pendulum.validate();
  StroboscopicPortrait portrait;
  portrait.period = section_period(pendulum, support, moment);
  Strobe strobe{pendulum, support, moment, options, {}};
  for (int n = 1; n <= options.sections; ++n) strobe.times.push_back(n * portrait.period);

  std::vector<Followed> results(starts.size());
  Tally tally(options, starts.size());
  const bool all = parallel_for(starts.size(), {.threads = options.threads, .cancel = options.cancel},
                                [&](std::size_t index, int) {
                                  results[index] = follow(strobe, starts[index]);
                                  tally.add_one();
                                });
  portrait.cancelled = !all || (options.cancel != nullptr && options.cancel->load());
  const auto sections = static_cast<std::size_t>(options.sections);
  for (auto& result : results) {
    if (result.curve.points.empty()) continue;  // not begun
    const std::size_t reached = result.curve.points.size() - 1;
    portrait.asked += sections;
    portrait.reached += reached;
    portrait.ended_early += reached < sections;
    portrait.cost += result.cost;
    portrait.curves.push_back(std::move(result.curve));
  }
  return portrait;
}

std::vector<MotionStart> portrait_starts(double alpha, int cells, int count) {
  const DefaultFloatingPoint environment;
  require(alpha > 0.0 && std::isfinite(alpha), "alpha", alpha, "finite and > 0");
  require(cells >= 1 && cells <= 1000, "cells", cells, "between 1 and 1000");
  require(count >= 1, "count", count, "at least 1");
  // The R2 sequence: multiples of 1/p and 1/p^2 modulo 1, p the real root of p^3 = p + 1.
  constexpr double kFirst = 0.7548776662466927, kSecond = 0.5698402909980532;
  const double half = window_half_width(cells);
  std::vector<MotionStart> starts;
  for (int i = 1; i <= count; ++i) {  // number 0 would be the hanging position
    const double x = std::fmod(0.5 + i * kFirst, 1.0), y = std::fmod(0.5 + i * kSecond, 1.0);
    starts.push_back({half * (2.0 * x - 1.0), alpha * kLargestVelocity * (2.0 * y - 1.0)});
  }
  return starts;
}

}  // namespace strutt
