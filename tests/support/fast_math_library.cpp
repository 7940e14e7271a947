// Stands for a library built with -ffast-math: as it is loaded it takes subnormal numbers from the process
// that loads it.
#ifdef __SSE2__
#include <immintrin.h>

[[gnu::constructor]] static void take_subnormals() { _mm_setcsr(_mm_getcsr() | 0x8040); }
#endif
