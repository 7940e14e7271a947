#pragma once

#include <array>
#include <cfenv>
#include <string_view>

namespace strutt::test {

/// A floating-point environment that a host program may have, for as long as this lives.
class HostEnvironment {
 public:
  enum class Kind { upward, downward, toward_zero, no_subnormals, traps };
  static constexpr std::array kAll{Kind::upward, Kind::downward, Kind::toward_zero, Kind::no_subnormals,
                                   Kind::traps};

  explicit HostEnvironment(Kind kind);
  ~HostEnvironment();
  HostEnvironment(const HostEnvironment&) = delete;
  HostEnvironment& operator=(const HostEnvironment&) = delete;

  std::string_view name() const;
  static bool is_now(Kind kind);
  static bool is_default();

 private:
  Kind kind_;
  std::fenv_t before_;
};

}  // namespace strutt::test
