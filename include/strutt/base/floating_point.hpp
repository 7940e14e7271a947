#pragma once

#include <cfenv>

namespace strutt {

/// The floating-point environment that error bounds are proved for, as long as this lives: rounding to
/// nearest, subnormal numbers kept (one library built with -ffast-math can switch them off for its whole
/// process), no traps. The caller's environment comes back afterwards. The entry points of Floquet theory,
/// charts, motions and the free pendulum begin with one; it costs a few nanoseconds where nothing is to be
/// changed.
class DefaultFloatingPoint {
 public:
  DefaultFloatingPoint();
  ~DefaultFloatingPoint();
  DefaultFloatingPoint(const DefaultFloatingPoint&) = delete;
  DefaultFloatingPoint& operator=(const DefaultFloatingPoint&) = delete;

 private:
  bool changed_;
  std::fenv_t before_;
};

}  // namespace strutt
