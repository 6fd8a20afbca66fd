// Where and with what a run is made, the setting of its threads, and what makes its figures less
// certain than they look.
#pragma once

#include <string>
#include <vector>

#include "bench/plan/options.hpp"
#include "bench/records/context.hpp"

namespace airybench {

// Gives BLAS and OpenMP regions (CHOLMOD's) this many threads.
void set_threads(int threads);

// git revision and dirty flag, compiler and flags, library versions, BLAS, CPU, threads, load,
// date.
Context describe_environment(int threads);

// The same, and what the options add: tolerances, limits, repetitions, words of the user's own.
// Throws UsageError: such a word is one of the run's.
Context context_of_run(const Options& options);

// A line for each fault of the machine and the run. What is "unknown" in the environment, or not
// there, gives no warning. noise_kernel_s: times of the noise kernel; may be empty.
std::vector<std::string> machine_warnings(const Context& environment, int repetitions,
                                          const std::vector<double>& noise_kernel_s);

}  // namespace airybench
