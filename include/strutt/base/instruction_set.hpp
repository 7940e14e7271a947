#pragma once

#include <string_view>

namespace strutt {

/// The instruction sets that the vectorised kernels are compiled for, narrowest first.
enum class InstructionSet : signed char {
  sse2,    ///< every x86-64 processor; 2 doubles, no fused multiply-add
  avx2,    ///< with FMA; 4 doubles
  avx512,  ///< AVX-512 F, DQ, VL, BW, CD with FMA; 8 doubles
};

/// The name in STRUTT_ISA and in files: `sse2`, `avx2`, `avx512`.
std::string_view to_string(InstructionSet set);

/// The widest set that this processor and its operating system run, or the one that the environment variable
/// STRUTT_ISA names; found once per process. Results are the same to the bit within one set; other sets agree
/// within the error bounds. Throws InvalidInput if STRUTT_ISA names no set, or one that cannot run here.
InstructionSet instruction_set();

}  // namespace strutt
