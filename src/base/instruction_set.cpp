#include "strutt/base/instruction_set.hpp"

#include <array>
#include <cstdlib>

#include "strutt/base/error.hpp"

namespace strutt {
namespace {

constexpr std::array<std::string_view, 3> kSetNames = {"sse2", "avx2", "avx512"};

bool runs_here(InstructionSet set) {
  switch (set) {
    case InstructionSet::avx512:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
             __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") &&
             __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("fma");
    case InstructionSet::avx2:
      return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    case InstructionSet::sse2:
      break;
  }
  return true;
}

InstructionSet widest() {
  if (runs_here(InstructionSet::avx512)) return InstructionSet::avx512;
  return runs_here(InstructionSet::avx2) ? InstructionSet::avx2 : InstructionSet::sse2;
}

InstructionSet chosen() {
  const char* const asked = std::getenv("STRUTT_ISA");
  if (asked == nullptr || *asked == '\0') return widest();
  for (std::size_t i = 0; i < kSetNames.size(); ++i) {
    const auto set = static_cast<InstructionSet>(i);
    if (kSetNames[i] != asked) continue;
    if (runs_here(set)) return set;
    throw InvalidInput("STRUTT_ISA", asked,
                       "a set that this processor runs, at most " + std::string(to_string(widest())));
  }
  throw InvalidInput("STRUTT_ISA", asked, "one of sse2, avx2, avx512");
}

}  // namespace

std::string_view to_string(InstructionSet set) { return kSetNames[static_cast<std::size_t>(set)]; }

InstructionSet instruction_set() {
  static const InstructionSet set = chosen();
  return set;
}

}  // namespace strutt
