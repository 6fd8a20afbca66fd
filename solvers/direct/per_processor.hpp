// A function compiled for each instruction set: the program takes what the processor has. Results
// may differ by rounding. For inner loops that no library has. By GCC: Clang's has no templates.
#pragma once

#include <cstddef>  // says whether this is glibc

#if defined(__x86_64__) && defined(__GLIBC__) && !defined(__clang__)
#define AIRYBENCH_PER_PROCESSOR __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define AIRYBENCH_PER_PROCESSOR
#endif
