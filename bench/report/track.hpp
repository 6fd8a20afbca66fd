// The newest run of a history against earlier ones of the same machine: status, counters and errors
// do not scatter, and any worsening counts at once; times are searched for changes of level
// (track_times.hpp).
//
//   status     ok → anything else is worse
//   counters   iterations, factor entries, flops, storage: any growth is worse. Heap figures and
//              instructions depend on the libraries as well: they are compared only with a run of
//              the same compiler and libraries. Bytes of heap may vary by 0.1 % (how far a block is
//              rounded up depends on what is free: tens of bytes), instructions by 1 %
//              (interrupts).
//   errors     growth by more than 1 % and by more than 1e-11 is worse. Below that it is rounding:
//              the errors of direct methods are 1e-12 to 1e-10, and another order of summation
//              moves them by their own size; 1e-11 is a hundred thousandth of the target error.
//   answer     another answer_hash where no error has changed: changed, no failure
#pragma once

#include <vector>

#include "bench/report/history.hpp"
#include "bench/report/track_times.hpp"

namespace airybench {

// Fills in findings and `failed` of the last run. Each value is compared with the last earlier run
// that has it; a change of times is reported once, as earlier runs' findings say which level
// counts. Not for an empty history.
void track_newest(std::vector<TrackedRun>& history, const TimeRules& rules);

// By more than is tolerated of this field, a counter or an error.
bool grew(const Field& field, double before, double after);

}  // namespace airybench
