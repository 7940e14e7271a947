#pragma once

#include "strutt/base/instruction_set.hpp"

namespace strutt {

/// Of three versions of a function, the one for the instruction set of this process.
template <typename Function>
Function* for_this_process(Function* sse2, Function* avx2, Function* avx512) {
  switch (instruction_set()) {
    case InstructionSet::avx512:
      return avx512;
    case InstructionSet::avx2:
      return avx2;
    case InstructionSet::sse2:
      break;
  }
  return sse2;
}

}  // namespace strutt
