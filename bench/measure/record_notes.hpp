// What a record takes over from a solution, a verification and what else was found of a case.
#pragma once

#include "bench/measure/memory_split.hpp"
#include "bench/records/record.hpp"
#include "bench/verify/contact_intervals.hpp"
#include "bench/verify/discretisation_error.hpp"
#include "bench/verify/verifier.hpp"
#include "solvers/base/method.hpp"

namespace airybench {

// The method's own word, with counts and sizes.
void note(const Solution& solution, Record& record);
void note(const std::vector<IterationHistory>& histories, Record& record);  // none: nothing
void note(const std::vector<GridPoint>& grid, Record& record);              // none: nothing
void note(const Verification& verification, Record& record);
// by: whose displacements it was made with, Record::discretisation_by. After the verification.
void note(const ConstitutiveError& error, const char* by, Record& record);
void note(const ContactIntervals& intervals, Record& record);
void note(const MemorySplit& memory, Record& record);
// Of an ok case, after the verification: nothing touches, nothing can touch, nothing is free.
void note_what_is_idle(const Problem& problem, Record& record);
// The same, of a path in equilibrium stresses: that another number of contact points sticks, or
// resultants move by more than 1 %, where every step is gone in two halves.
void note_slip_of_half_steps(Record& record);
// The same: strains for which linear elasticity does not hold.
void note_large_strains(const Problem& problem, const StressField& stress, Record& record);

}  // namespace airybench
