// Measures how steadily the machine computes: a fixed piece of work of one or two milliseconds,
// timed between the measurements. An LDLᵀ factorisation of 128 rows runs in the caches, two sweeps
// over 8 MiB in memory; no library takes part. The data are in static storage, not on the heap.
#pragma once

namespace airybench {

// Seconds of one pass. Allocates nothing. One thread at a time may call it.
double run_noise_kernel();

// Seconds of the slowest of `threads` passes at once, each on its own data. Longer than one pass
// alone if frequency, shared caches, memory or other work slow them down.
double run_noise_kernel(int threads);

double noise_kernel_checksum();

// 8 MiB of doubles; fewer in a sanitized program, which is not timed.
#ifdef AIRYBENCH_SANITIZED
inline constexpr int noise_sweep_length = 1 << 14;
#else
inline constexpr int noise_sweep_length = 1 << 20;
#endif

}  // namespace airybench
