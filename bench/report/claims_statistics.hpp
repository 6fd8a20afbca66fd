// Ratios of measured times with an interval, and verdicts on inequalities between them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/records/robust.hpp"

namespace airybench {

enum class Verdict { reproduced, not_reproduced, undecided };
std::string_view name_of(Verdict verdict);

Verdict opposite(Verdict verdict);                     // of an undecided one: undecided
Verdict both(Verdict first, Verdict second);           // one that is not reproduced is enough
Verdict all_of(const std::vector<Verdict>& verdicts);  // of none: reproduced

// Is the quantity > threshold? Undecided: low ≤ threshold < high.
Verdict is_above(const Interval& interval, double threshold);
// Is it in (1/factor, factor]?
Verdict is_within_factor(const Interval& interval, double factor);

// The time of a case. One that was stopped by its time limit has no samples: it is known to take
// longer than at_least_s, and estimated to take figure_s.
struct CaseTime {
  double figure_s = 0;
  std::vector<double> samples_s;
  double at_least_s = 0;
  bool timed_out() const { return samples_s.empty(); }
};

struct Ratio {
  double figure = 0;
  Interval interval;
  bool estimated = false;  // the figure rests on an extrapolated time
};

// Of the medians: 95 % bootstrap interval with a fixed seed; one sample on either side is taken as
// exact. Timed-out cases enter with their lower bounds.
Ratio ratio_of(const CaseTime& numerator, const CaseTime& denominator);

// Over several meshes: geometric mean, smallest and largest. A ratio counts with its figure, one
// that rests on an extrapolated time with its bounds. Not for an empty list.
Ratio spread(const std::vector<Ratio>& ratios);

}  // namespace airybench
