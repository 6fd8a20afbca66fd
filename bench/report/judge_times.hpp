// Which cases have become slower or faster, over the nights of one machine?
//
// A night is slow or fast as a whole: the machine is shared, its clock varies. So
//   x_ct = a_c + f_t + e_ct        log of the median time of case c in night t
// and the common factor f is taken out before the cases are looked at, by median polish (Tukey,
// "Exploratory Data Analysis", 1977): a_c = median over t of x - f, f_t = median over c of x - a.
// It is better known than any single kernel's time, as there are many cases. What remains of each
// case is searched for a change of level (change_point.hpp).
//
// A slowdown of all cases is f. So f itself is held against the reference kernel κ, which no change
// of this program or of its libraries touches: f_t - log κ_t is one more series. Without kernel
// times it is not judged. Of fewer than `least_cases` cases f would be these cases' own changes:
// then log κ_t takes its place.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "bench/report/change_point.hpp"

namespace airybench {

// Simulated with 50 cases of 2 to 4 % scatter, 5 % outliers and drift (simulation_test.cpp): 0.66
// false alarms in 100 nights over all cases (95 %: 0.45 to 0.93); a slowdown of one case by 10 % is
// found within five nights in 95 % of the runs after 60 nights of history, in 92 % after 20. Four
// nights, not three: three outliers in a row that agree are most of the false alarms otherwise.
struct TimeRules {
  double minimum_effect = 0.05;
  std::size_t least_nights_after = 4;
  // Family-wise level of one night's tests, over all cases and the common factor; slowdowns take
  // nine tenths of it. Tests of one series in successive nights are nearly the same test.
  double level_per_night = 0.012;
};

// Nights of a machine from which on times are judged.
std::size_t nights_to_judge_times(const TimeRules& rules);

// NaN: not measured. The newest night is the last.
struct TimeTable {
  std::vector<std::vector<double>> log_times;  // by case and night
  std::vector<double> log_kernel;              // by night
  // The first night of the level that is there now, after the last change that was reported.
  std::vector<std::size_t> starts;  // by case
  std::size_t common_start = 0;
};

struct TimeChange {
  std::optional<std::size_t> series;  // the case; empty: all of them
  Change change;
};

constexpr std::size_t least_cases = 6;
constexpr std::size_t time_window = 60;  // nights that are looked back: slow drift stays small

std::vector<TimeChange> find_time_changes(const TimeTable& table, const TimeRules& rules);

}  // namespace airybench
