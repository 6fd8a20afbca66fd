// Compares two programs, each run several times on the same cases. The unit is the run, because
// repetitions share clock, load and memory layout: each run gives one value per case, the median of
// its repetitions. Cases of EXTERNAL: methods are judged by the program's own solve, without what
// is ours.
//
//   per case   ratio = median over B's runs / median over A's, with a 95 % bootstrap interval
//              p: Mann-Whitney test of B's runs against A's, Holm's adjustment over all cases
//   together   drift = median over the cases of noise_kernel_s in B / in A: the machine's change
//
// A case is slower if all of these hold; it is faster if they hold for the reciprocals:
//   p <= 5 %
//   ratio and ratio / drift exceed the minimum effect
//   ratio / drift exceeds the drift and its reciprocal: a slower machine need not slow a case as it
//     slows the kernel, so the correction may be off by as much as it corrects
//   the runs are interleaved: no side ever had more than one run more than the other; otherwise the
//     test measures the time of day
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/records/json.hpp"
#include "bench/records/record_reader.hpp"
#include "bench/records/robust.hpp"

namespace airybench {

struct CompareRules {
  double minimum_effect = 0.03;  // slower: ratio > 1 + this, faster: ratio < 1 / (1 + this)
  double level = 0.05;           // family-wise, both directions together
};

enum class TimeVerdict {
  faster,
  slower,
  not_separated,
  one_run_each,     // scatter between runs is unknown
  too_few_runs,     // no p can be small enough
  not_interleaved,  // not chance, but perhaps the time of day
};
std::string_view name_of(TimeVerdict verdict);  // "not separated: one run each"

struct ComparedCase {
  Record a, b;                               // the side's first run that is not ok, else its last
  std::vector<double> medians_a, medians_b;  // s, of runs with an answer and samples
  const char* time = "time_s";               // the field that they are of, or program_solve_s
  bool interleaved = false;
  double ratio = 1;                  // raw; like what follows, only if is_timed()
  double corrected = 1;              // ratio / drift
  std::optional<Interval> interval;  // of the raw ratio; empty: one run on a side
  double p = 1;                      // adjusted
  TimeVerdict verdict = TimeVerdict::not_separated;
  bool is_timed() const { return !medians_a.empty() && !medians_b.empty(); }
  // Ok in all runs of A, but not in all of B.
  bool broke() const { return a.status == Status::ok && b.status != Status::ok; }
};

struct Comparison {
  std::vector<ComparedCase> cases;          // in the order of A's runs
  std::vector<std::string> only_a, only_b;  // names
  std::optional<double> drift;              // empty: kernel not timed in both
  std::size_t timed = 0;                    // cases with times on both sides
  // Geometric mean over the cases that every run has times of; empty: none.
  std::optional<double> mean_ratio;       // raw
  std::optional<Interval> mean_interval;  // empty: one run on a side
  std::size_t runs_a = 0, runs_b = 0;
  std::size_t runs_needed = 0;  // on both sides, for a small enough p
  CompareRules rules;

  bool has_regression() const;
  std::string text() const;
  std::string markdown() const;
  Json json() const;
};

using Runs = std::vector<std::vector<Record>>;  // of one side; their cases may differ

// The last record of a case in a run counts.
Comparison compare(const Runs& a, const Runs& b, const CompareRules& rules);

}  // namespace airybench
