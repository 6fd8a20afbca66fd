// Compares the newest run of a history with earlier ones of the same machine. Times scatter: they
// are searched for changes of level (track_times.hpp), those of programs in their own solve.
//
//   status     ok → anything else is worse
//   counters   any growth is worse. Heap figures depend on the libraries: only runs with the same
//              compiler and libraries are compared. Heap may vary by 0.1 % (rounding of blocks
//              depends on what is free).
//   errors     growth by more than 1 % and more than 1e-11 is worse. Less is rounding: another
//              order of summation moves errors of direct methods, 1e-12 to 1e-10, by their size.
//   answer     another answer_hash with unchanged errors: changed, no failure
#pragma once

#include <vector>

#include "bench/report/history.hpp"
#include "bench/report/track_times.hpp"

namespace airybench {

// Fills in findings and `failed` of the last run. Compares each value with the last earlier run
// that has it. Reports a change of times once: earlier findings say which level counts. history
// must not be empty.
void track_newest(std::vector<TrackedRun>& history, const TimeRules& rules);

// True if a counter or an error grew by more than its tolerance.
bool grew(const Field& field, double before, double after);

}  // namespace airybench
