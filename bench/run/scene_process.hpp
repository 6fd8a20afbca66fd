// The processes of a scene: what runs in them. Commands are lines, "examine 3", "time 3", "end 3";
// answers are JSON on a line.
#pragma once

#include <vector>

#include "bench/measure/activity_board.hpp"
#include "bench/measure/workbench.hpp"
#include "bench/plan/options.hpp"
#include "bench/plan/plan.hpp"
#include "bench/run/child_process.hpp"

namespace airybench {

// Serves the cases of one scene until the line ends. board: its own, for "prepare 3", which
// assembles and computes what the cases share; it beats there while it waits for a case.
void serve_scene(Channel& channel, const std::vector<const Case*>& cases, const Options& options,
                 ActivityBoard& board, const LeftOut& left_out);

// A run that takes longer than --timeout and a grace in which a method can end by itself, and say
// how far it came; assembly, reference and verification have a quarter of an hour at least.
bool is_overdue(const ActivityBoard& board, const Options& options);

// A run of a process that ended without an answer: status, a sentence, signal, where and how long
// it was there.
TimedRun obituary_of(const ChildEnd& end, const ActivityBoard& board, const Options& options);

}  // namespace airybench
