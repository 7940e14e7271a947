#include "support/host_environment.hpp"

#include <algorithm>

#ifdef __SSE2__
#include <immintrin.h>
#endif

namespace strutt::test {
namespace {

#ifdef __SSE2__
constexpr unsigned kNoSubnormals = 0x8040;  // flush results to zero, take operands as zero
unsigned control() { return _mm_getcsr(); }
void set_no_subnormals() { _mm_setcsr(control() | kNoSubnormals); }
bool no_subnormals() { return (control() & kNoSubnormals) == kNoSubnormals; }
#else
void set_no_subnormals() {}
bool no_subnormals() { return true; }
#endif

}  // namespace

HostEnvironment::HostEnvironment(Kind kind) : kind_(kind) {
  std::fegetenv(&before_);
  switch (kind) {
    case Kind::upward:
      std::fesetround(FE_UPWARD);
      break;
    case Kind::downward:
      std::fesetround(FE_DOWNWARD);
      break;
    case Kind::toward_zero:
      std::fesetround(FE_TOWARDZERO);
      break;
    case Kind::no_subnormals:
      set_no_subnormals();
      break;
    case Kind::traps:
      feenableexcept(FE_OVERFLOW | FE_INVALID | FE_DIVBYZERO);
      break;
  }
}

HostEnvironment::~HostEnvironment() { std::fesetenv(&before_); }

std::string_view HostEnvironment::name() const {
  constexpr std::array<std::string_view, 5> names{"upward", "downward", "toward zero", "no subnormals",
                                                  "traps"};
  return names[static_cast<std::size_t>(kind_)];
}

bool HostEnvironment::is_now(Kind kind) {
  switch (kind) {
    case Kind::upward:
      return std::fegetround() == FE_UPWARD;
    case Kind::downward:
      return std::fegetround() == FE_DOWNWARD;
    case Kind::toward_zero:
      return std::fegetround() == FE_TOWARDZERO;
    case Kind::no_subnormals:
      return no_subnormals();
    case Kind::traps:
      return fegetexcept() == (FE_OVERFLOW | FE_INVALID | FE_DIVBYZERO);
  }
  return false;
}

bool HostEnvironment::is_default() { return std::none_of(kAll.begin(), kAll.end(), is_now); }

}  // namespace strutt::test
