// How often a case is timed.
#pragma once

#include "bench/plan/options.hpp"
#include "bench/records/record.hpp"

namespace airybench {

// Of a case that is repeated at all, whatever the samples are.
int least_repetitions(const Options& options);
int most_repetitions(const Options& options);

// Is a case with these samples timed once more? Up to the least repetitions, then as long as the
// precision is not reached; not when the samples add up to long_case_s, nor after the most.
bool is_repeated(const Record& record, const Options& options);

}  // namespace airybench
