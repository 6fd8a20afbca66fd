// How steadily the machine computes: a fixed piece of work of one or two milliseconds, timed again
// and again between the measurements. Its times would all be the same on a machine that does
// nothing else; how much they scatter is what the measurements beside them have to bear.
//
// The work has a part in the processor's caches, an LDLᵀ factorisation of 128 rows, and a part in
// its memory, two sweeps over 8 MiB; both are loops of our own, so that no library's version
// matters. Its data are in static storage, so that heap figures do not see them.
#pragma once

namespace airybench {

// Seconds of one pass. Allocates nothing. Not for several threads at once.
double run_noise_kernel();

// The same on so many threads at once, each with data of its own: seconds until the last has ended.
// Over those of one: what frequency, shared caches and memory, or other work take from each.
double run_noise_kernel(int threads);

// The work itself; always the same number.
double noise_kernel_checksum();

// Doubles: 8 MiB. Fewer in a sanitized program, which is not timed: a sixth of a short run went
// into getting their pages.
#ifdef AIRYBENCH_SANITIZED
inline constexpr int noise_sweep_length = 1 << 14;
#else
inline constexpr int noise_sweep_length = 1 << 20;
#endif

}  // namespace airybench
