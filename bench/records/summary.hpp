// Derives fields of a record from others: medians and intervals of samples, totals, the outcome.
#pragma once

#include "bench/records/record.hpp"

namespace airybench {

void summarise(Record& record);

// If the method claims ok and the verifier disagrees: "wrong_success", or "unverified" without an
// error_stress. Else status, or what the judge has written there: other_solution, or "inaccurate"
// where mesh or scene are to blame.
std::string outcome_of(const Record& record);

// Whether the intervals of both median times overlap, so that neither is known to be faster.
bool times_tie(const Record& a, const Record& b);
inline constexpr int fewest_to_tell_apart =
    5;  // two samples of five differ at p < 0.01, of four never
// Whether a total error is the one asked for or less, up to rounding; not known: it is not.
bool meets(const std::optional<double>& error, double goal);
// Its mesh was adapted to a total error below its own.
bool misses_goal(const Record& record);

// --repetitions=…,precision= of its run, and whether the interval of its median is wider.
std::optional<double> precision_of(const Record& record);
bool misses_precision(const Record& record);

bool has_few_samples(const Record& record);

}  // namespace airybench
