#include "strutt/base/method.hpp"

#include <array>
#include <string>

#include "strutt/base/error.hpp"

namespace strutt {
namespace {

constexpr std::array<std::string_view, kMethodCount> kMethodNames = {
    "auto", "surrogate", "propagator", "cvode", "arkode", "fourier", "exact"};

}  // namespace

std::string_view to_string(Method method) { return kMethodNames[static_cast<std::size_t>(method)]; }

Method method_from_string(std::string_view name) {
  for (std::size_t i = 0; i < kMethodNames.size(); ++i) {
    if (kMethodNames[i] == name) return static_cast<Method>(i);
  }
  std::string known;
  for (const auto& other : kMethodNames) known += (known.empty() ? "" : ", ") + std::string(other);
  throw InvalidInput("method", name, "one of " + known);
}

}  // namespace strutt
