// Judges the newest night of a history: counters and errors by themselves (judge_counters.hpp),
// times by change points over the nights of the same machine (judge_times.hpp).
#pragma once

#include <vector>

#include "bench/report/history.hpp"
#include "bench/report/judge_times.hpp"

namespace airybench {

// Fills in findings and `failed` of the last night, from those of the earlier nights where a change
// of times has been reported: after it a new level counts, so that it is reported once. Not for an
// empty history.
void judge_newest(std::vector<Night>& history, const TimeRules& rules);

}  // namespace airybench
