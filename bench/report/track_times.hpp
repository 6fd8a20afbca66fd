// Which cases became slower or faster for good over the runs of one machine, and since when? In
//   x_ct = a_c + f_t + e_ct        log of the median time of case c in run t
// the common factor f of a slow or fast run is removed first, by median polish (Tukey, "Exploratory
// Data Analysis", 1977): a_c = median over t of x - f, f_t = median over c of x - a. A slowdown of
// all cases is in f, so f_t - log κ_t is tested as one more series, if there are times κ of the
// reference kernel, which no change of this program or its libraries touches. With fewer than
// `min_cases` cases f would be their own changes; log κ_t replaces it.
//
// The rest of each case is searched for a change of level. A value scatters about the level a as
//   g(e) = (1 - ε) φ(e; σ) + ε φ(e; ω),   e = x_t - a,   ε = 0.1, ω = 0.25:
// normal with the series' scale σ, plus single outliers of tens of per cent, which count little
// because g is flat there. For every run k that may be the first after a change
//   before  a, σ: maximum likelihood of x_t, t < k; σ is drawn towards the scale common to all
//           series, as short histories know little of it
//   after   a + δ: maximum likelihood of x_t, t >= k
//   λ_k = n_b / (n_b + n_a) Σ_{t >= k} log [ g(x_t - a - δ) / g(x_t - a) ]
// where n_b and n_a count the runs without outliers, and the factor is for the uncertainty of a.
// Without a change ±sqrt(2 λ_k) is about standard normal (Wilks). A change is confirmed if this
// exceeds the normal quantile of the false-alarm level, |δ| less 1.1 standard errors exceeds the
// minimum effect, and enough runs after it, most of them, agree. The k with the largest λ_k is the
// change. Lai, "Sequential changepoint detection in quality control and dynamical systems", J. R.
// Statist. Soc. B 57 (1995): window-limited generalised likelihood ratio.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace airybench {

// Simulated with 50 cases of 2 to 4 % scatter, 5 % outliers and drift (track_times_test.cpp): 0.66
// false alarms in 100 runs over all cases (95 %: 0.45 to 0.93). A slowdown of one case by 10 % is
// found within five runs in 95 % of histories of 60 runs, in 92 % of those of 20.
struct TimeRules {
  double minimum_effect = 0.05;  // |δ| - 1.1 standard errors >= log(1 + this)
  std::size_t min_after = 4;     // agreeing runs after a change; three may be outliers in a row
  // Family-wise level of one run's tests, over all cases and the common factor; slowdowns take nine
  // tenths. Tests of a series in successive runs are nearly the same test.
  double level_per_run = 0.012;

  static constexpr std::size_t min_before = 8;  // runs before a change
  // Times are tested from this many runs on.
  std::size_t min_runs() const { return min_before + min_after; }
};
constexpr std::size_t min_cases = 6;
constexpr std::size_t time_window = 60;  // runs looked back; keeps slow drift small

// NaN: not measured. The newest run is the last.
struct TimeTable {
  std::vector<std::vector<double>> log_times;  // by case and run
  std::vector<double> log_kernel;              // by run
  // First run of the current level, after the last reported change.
  std::vector<std::size_t> starts;  // by case
  std::size_t common_start = 0;
};

struct TimeChange {
  std::size_t first = 0;                // index of the first run after it
  double shift = 0, low = 0, high = 0;  // δ and its 95 % interval
  std::optional<std::size_t> series;    // the case; empty: all cases
};

std::vector<TimeChange> find_time_changes(const TimeTable& table, const TimeRules& rules);

// For one series. level: probability of a false alarm per run.
std::optional<TimeChange> find_change(const std::vector<double>& series, double common_scale,
                                      const TimeRules& rules, double level);
// Robust standard deviation about the median (1.4826 MAD), at least that of clocks and caches; NaN
// for fewer than two values. The common scale of several series is the median of theirs.
double scale_of(const std::vector<double>& series);

}  // namespace airybench
