// The record of a case before anything runs: names, sizes, stages and the reason to skip it.
#pragma once

#include "bench/plan/options.hpp"
#include "bench/plan/plan.hpp"
#include "bench/records/record.hpp"

namespace airybench {

Record blank_record(const PosedProblem& problem, const Method& method, const Options& options);
Record blank_record(const Case& planned, const Options& options);

void describe(const Method& method, Record& record);
// Sets scene, mesh file, knob, stop and contact solver.
void identify(const Case& planned, Record& record);

}  // namespace airybench
