// How steadily the machine computes: a fixed piece of work of one or two milliseconds, timed
// between the measurements. On a machine that does nothing else its times would all be the same.
//
// The work has a part in the processor's caches, an LDLᵀ factorisation of 128 rows, and a part in
// its memory, two sweeps over 8 MiB; no library's version matters. Its data are in static storage,
// which heap figures do not see.
#pragma once

namespace airybench {

// Seconds of one pass. Allocates nothing. Not for several threads at once.
double run_noise_kernel();

// The same on so many threads at once, each with data of its own: seconds until the last has ended.
// Over those of one: what frequency, shared caches and memory, or other work take from each.
double run_noise_kernel(int threads);

double noise_kernel_checksum();

// Doubles: 8 MiB. Fewer in a sanitized program, which is not timed.
#ifdef AIRYBENCH_SANITIZED
inline constexpr int noise_sweep_length = 1 << 14;
#else
inline constexpr int noise_sweep_length = 1 << 20;
#endif

}  // namespace airybench
