// Has the level of a series of nights changed for good, and since when?
//
// x_t: logarithms of times, t = 1 .. T, the newest last; NaN: not measured. A night's value
// scatters about the level a as
//   g(e) = (1 - ε) φ(e; σ) + ε φ(e; ω),   e = x_t - a,   ε = 0.1, ω = 0.25:
// normal with the series' own scale σ, but for single outliers of tens of per cent, for which g is
// so flat that they say little. For every night k that may be the first after a change
//   before  a, σ: maximum likelihood of x_t, t < k; σ is drawn towards the scale that is common to
//           all series, as short histories know little of it
//   after   a + δ: maximum likelihood of x_t, t >= k
//   λ_k = n_b / (n_b + n_a) Σ_{t >= k} log [ g(x_t - a - δ) / g(x_t - a) ]
// where n_b and n_a count the nights that are no outliers, and the factor is for the uncertainty of
// a. Where nothing changed, ±sqrt(2 λ_k) is about standard normal (Wilks). A change is confirmed
// when this is above the normal quantile of the false-alarm level, |δ| less 1.1 standard errors is
// above the minimum effect, and enough nights after it, most of them, agree. Of several k that with
// the largest λ_k is the change. Lai, "Sequential changepoint detection in quality control and
// dynamical systems", J. R. Statist. Soc. B 57 (1995): window-limited generalised likelihood ratio.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace airybench {

struct ChangePointRules {
  double minimum_effect = 0.05;  // |δ| - 1.1 standard errors >= log(1 + this)
  std::size_t least_before = 8;  // nights before a change
  std::size_t least_after = 4;   // nights after it that agree
  std::size_t most_after = 14;   // older changes are not looked for
  double rise_level = 0.01;      // chance that an unchanged series is said to have risen, a night
  double fall_level = 0.001;     // and to have fallen
};

struct Change {
  std::size_t first = 0;                // the index of the first night after it
  double shift = 0, low = 0, high = 0;  // δ and its 95 % interval
};

// Standard deviation about the median, robustly (1.4826 MAD), at least that of clocks and caches;
// NaN where fewer than two values are. The common scale of several series is the median of theirs.
double scale_of(const std::vector<double>& series);

std::optional<Change> find_change(const std::vector<double>& series, double common_scale,
                                  const ChangePointRules& rules);

}  // namespace airybench
