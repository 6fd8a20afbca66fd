// What does not scatter: status, counters and errors of a night against an earlier one. Any
// worsening counts at once.
//
//   status     ok → anything else is worse
//   counters   iterations, factor entries, flops, storage: any growth is worse. Heap figures and
//              instructions depend on the libraries as well: they are compared only with a night of
//              the same compiler and libraries. Bytes of heap may vary by 0.1 % (how far a block is
//              rounded up depends on what is free: tens of bytes), instructions by 1 %
//              (interrupts).
//   errors     growth by more than 1 % and by more than 1e-11 is worse. What stays below is
//              rounding: the errors of direct methods are 1e-12 to 1e-10, and another order of
//              summation moves them by their own size; at 1e-11 what is reached is a hundred
//              thousandth of the target error.
//   answer     another answer_hash where no error has changed: changed, no failure
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bench/report/history.hpp"

namespace airybench {

// A field that is a counter.
struct JudgedCount {
  const Field* field;
  bool of_libraries = false;
  double tolerated_growth = 1;
  std::optional<std::int64_t> in(const Record& record) const;
};
const std::vector<JudgedCount>& judged_counts();
bool count_grew(const JudgedCount& count, std::int64_t before, std::int64_t after);

// The findings on the newest of `nights`, which are of one machine, in the order of dates: of each
// value against the last earlier night that has it.
std::vector<Finding> judge_counters(const std::vector<Night>& nights);

// By more than 1 % and by more than 1e-11.
bool error_grew(double before, double after);

}  // namespace airybench
