// A case's record before anything has run: names, sizes, stages, what makes it this case.
#pragma once

#include "bench/plan/options.hpp"
#include "bench/plan/plan.hpp"
#include "bench/records/record.hpp"

namespace airybench {

Record blank_record(const PosedProblem& problem, const Method& method, const Options& options);
Record blank_record(const Case& planned, const Options& options);

// Its name, family and parts.
void describe(const Method& method, Record& record);

// Scene, mesh file, knob and stop of the case.
void identify(const Case& planned, Record& record);

}  // namespace airybench
