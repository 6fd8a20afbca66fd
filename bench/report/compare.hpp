// Two programs, each run several times on the same cases: which cases have become slower or faster,
// by more than chance, and by more than the machine has?
//
// The run is the unit, not the repetition: within a second the clock, the neighbours and the place
// of memory are the same for all repetitions, so they agree with each other far better than with
// those of the next run. Each run and case gives one value, the median of its repetitions.
//
// Per case   ratio = median over B's runs / median over A's runs, with its 95 % bootstrap interval
//            p: Mann-Whitney test of B's runs against A's, Holm's adjustment over all cases
// Together   drift = median over the cases of noise_kernel_s in B / in A: the machine's own change,
//            by a fixed kernel that all runs timed between the cases
// A case is slower when p <= 5 %, its ratio and ratio / drift are above the minimum effect, ratio /
// drift is also above the drift (or its reciprocal), since a slower machine need not slow a case as
// it slows the kernel, so that the correction may be off by as much as it corrects, and the runs
// were interleaved: at no time had one side more than one run more than the other. Otherwise the
// hour is tested, not the program. Faster: the same with the reciprocals.
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
  double minimum_effect = 0.03;  // of the ratio: slower above 1 + this, faster below 1 / (1 + this)
  double level = 0.05;           // family-wise, of both directions together
};

enum class TimeVerdict {
  faster,
  slower,
  not_separated,
  one_run_each,     // nothing is known of what differs between runs
  too_few_runs,     // no p could be small enough
  not_interleaved,  // chance is not the reason, but the time of day may be
};
std::string_view name_of(TimeVerdict verdict);  // "not separated: one run each"

struct ComparedCase {
  Record a, b;  // of each side the first run's that is not ok, else the last run's
  std::vector<double> medians_a, medians_b;  // s, of the runs that have an answer and samples
  bool interleaved = false;
  double ratio = 1;                  // raw; this and what follows only if is_timed()
  double corrected = 1;              // by the drift
  std::optional<Interval> interval;  // of the raw ratio; empty: a side has one run
  double p = 1;                      // adjusted
  TimeVerdict verdict = TimeVerdict::not_separated;
  bool is_timed() const { return !medians_a.empty() && !medians_b.empty(); }
  // It was ok in all runs of A and is not in all of B.
  bool broke() const { return a.status == Status::ok && b.status != Status::ok; }
};

struct Comparison {
  std::vector<ComparedCase> cases;          // in the order of A's runs
  std::vector<std::string> only_a, only_b;  // names
  std::optional<double> drift;              // empty: the kernel was not timed in both
  std::size_t timed = 0;                    // cases with times on both sides
  // Of the geometric mean over the cases that every run has times of; empty: none.
  std::optional<double> mean_ratio;       // raw
  std::optional<Interval> mean_interval;  // empty: a side has one run
  std::size_t runs_a = 0, runs_b = 0;
  std::size_t runs_needed = 0;  // on both sides, for a p that can be small enough
  CompareRules rules;

  // A case is slower, or was ok and is not any more.
  bool has_regression() const;
  // A table of the times, then what else has changed, a sentence a line.
  std::string text() const;
  std::string markdown() const;
  Json json() const;
};

using Runs = std::vector<std::vector<Record>>;  // of a side; a run may have any of the cases

// Of several records of a case in a run the last counts.
Comparison compare(const Runs& a, const Runs& b, const CompareRules& rules);

}  // namespace airybench
