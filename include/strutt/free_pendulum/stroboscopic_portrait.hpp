#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "strutt/free_pendulum/phase_portrait.hpp"
#include "strutt/integrate/motion.hpp"

namespace strutt {

/// What is wanted of a stroboscopic portrait.
struct StroboscopicOptions {
  int cells = 1;       ///< angles are wrapped into [-cells pi, cells pi), 1 <= cells <= 1000
  int sections = 300;  ///< of every start, besides the start itself, >= 1
  double tolerance =
      1e-6;  ///< a curve ends where the error bound of the angle exceeds it, rad, 1e-13 to 1e-2
  Method method = Method::automatic;  ///< automatic (= arkode), arkode, cvode
  int threads = 0;                    ///< 0: all
  const std::atomic<bool>* cancel = nullptr;
  /// Told after every curve how many of all are done; on any thread, but never on two at a time.
  std::function<void(std::size_t done, std::size_t total)> progress = {};

  void validate() const;  ///< throws InvalidInput
};

/// Sections of many motions, and what became of them.
struct StroboscopicPortrait {
  double period = 0.0;             ///< s, between sections
  std::vector<PhaseCurve> curves;  ///< one a start, in the order of the starts
  std::size_t asked = 0;           ///< sections asked for, without the starts
  std::size_t reached = 0;         ///< of them, within the tolerance
  std::size_t ended_early = 0;     ///< curves that have fewer sections than asked for
  IntegrationCost cost;            ///< of all runs, those for the error bounds included
  bool cancelled = false;
};

/// Poincare (stroboscopic) portrait of (7): the states at t = 0, T, 2 T, ... of the motion from every start,
/// with T the period of the support, else that of a varying moment, else T0 = 2 pi/alpha. `separatrix_excess`
/// is that of the start.
///
/// A point stands in the portrait only if the error bound of its angle is within the tolerance
/// (integrate_motion). In a chaotic region errors grow exponentially from one section to the next, so such a
/// curve ends after some tens of sections, whatever the method; more starts show more of the region. Wrapping
/// adds at most 3 ulp of the unwrapped angle. Bit-identical for any number of threads. Throws InvalidInput.
StroboscopicPortrait stroboscopic_portrait(const PhysicalPendulum& pendulum, const Excitation* support,
                                           const Excitation* moment, std::span<const MotionStart> starts,
                                           const StroboscopicOptions& options = {});

/// `count` >= 1 starts spread over |phi| <= cells pi, |phi'/alpha| <= 2.75 without rows or columns (a lattice
/// of golden ratio type), the same for the same arguments.
std::vector<MotionStart> portrait_starts(double alpha, int cells, int count);

}  // namespace strutt
