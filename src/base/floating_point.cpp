#include "strutt/base/floating_point.hpp"

#include <cfloat>
#include <limits>

#ifdef __SSE2__
#include <immintrin.h>
#endif

#ifdef __FAST_MATH__
#error "Strutt must not be compiled with -ffast-math or -Ofast: its error bounds would not hold"
#endif
static_assert(FLT_EVAL_METHOD == 0, "a double must be rounded to a double by every operation");
static_assert(std::numeric_limits<double>::is_iec559);

namespace strutt {
namespace {

bool is_default() {
#ifdef __SSE2__
  // rounding to nearest, every exception masked, subnormal numbers kept as operands and as results
  constexpr unsigned kControl = 0xffc0, kDefault = 0x1f80;
  if ((_mm_getcsr() & kControl) != kDefault) return false;
#endif
  return std::fegetround() == FE_TONEAREST;  // the unit for long double has a mode of its own
}

}  // namespace

DefaultFloatingPoint::DefaultFloatingPoint() : changed_(!is_default()) {
  if (!changed_) return;
  std::fegetenv(&before_);
  std::fesetenv(FE_DFL_ENV);
}

DefaultFloatingPoint::~DefaultFloatingPoint() {
  if (changed_) std::fesetenv(&before_);
}

}  // namespace strutt
