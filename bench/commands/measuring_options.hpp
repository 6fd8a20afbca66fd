// Options of how a case is measured whose values are more than a number: what they may be, and what
// follows from them.
#pragma once

#include <string>

#include "bench/plan/options.hpp"

namespace airybench {

inline constexpr double most_of_a_limit = 1e9;

// All throw UsageError. The study is set before.

// --threads: one number; of the scaling study several, no more than there are processors: what runs
// on fewer has no efficiency.
void read_threads(const std::string& text, bool is_given, Options& options);

// --precision: a share, 2%. After --repetitions and --max-repetitions.
void read_precision(const std::string& text, Options& options);

// --retry-noisy: a share, 7%; without a value 5%.
void read_retry_noisy(const std::string& text, Options& options);

// --budget: seconds. Runs may take twice as long, unless there is a --timeout: a detail run takes
// longer than a timed one. The search for parameters, which is in no time, keeps the limit that it
// had.
void read_budgets(const std::string& text, bool has_timeout, Options& options);

}  // namespace airybench
