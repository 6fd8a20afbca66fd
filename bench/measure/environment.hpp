// Where and with what a run was made, and the setting of its threads.
#pragma once

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

}  // namespace airybench
