// Two runs of the same cases: which have become slower or faster, by more than chance, and by more
// than the machine has?
//
// Per case   ratio = median time in B / median time in A, with its 95 % bootstrap interval
//            p: Mann-Whitney test of B's samples against A's, Holm's adjustment over all cases
// Per run    drift = median over the cases of noise_kernel_s in B / in A: the machine's own change,
//            by a fixed kernel that both runs timed between the cases
// A case is slower when p <= 5 %, its ratio and ratio / drift are above the minimum effect, and
// ratio / drift is above the drift (or its reciprocal) too: how a slower machine slows a case is
// not how it slows the kernel, so the correction may be off by as much as it corrects. Faster: the
// same with the reciprocals. p knows only the scatter within a run: a machine that changes between
// the runs without the kernel's showing it looks like a change of the cases.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/records/record_reader.hpp"
#include "bench/statistics/bootstrap.hpp"

namespace airybench {

struct CompareRules {
  double minimum_effect = 0.03;  // of the ratio: slower above 1 + this, faster below 1 / (1 + this)
  double level = 0.05;           // family-wise
};

enum class TimeVerdict { faster, slower, not_separated, too_few_samples };
std::string_view name_of(TimeVerdict verdict);  // "not separated"

struct ComparedCase {
  Record a, b;
  bool timed = false;    // both have an answer and samples; what follows is of these
  double ratio = 1;      // raw
  double corrected = 1;  // by the drift
  Interval interval;     // of the raw ratio
  double p = 1;          // adjusted
  TimeVerdict verdict = TimeVerdict::not_separated;
  bool broke() const { return a.status == Status::ok && b.status != Status::ok; }
};

struct Comparison {
  std::vector<ComparedCase> cases;          // in the order of A
  std::vector<std::string> only_a, only_b;  // names
  std::optional<double> drift;              // empty: the kernel was not timed in both
  std::size_t timed = 0;                    // cases with times on both sides
  double mean_ratio = 1;                    // geometric, raw
  Interval mean_interval;
  std::size_t repetitions_needed = 0;  // on both sides, for a p that can be small enough
  CompareRules rules;

  // A case is slower, or was ok and is not any more.
  bool has_regression() const;
};

// Of several records of a case the last counts.
Comparison compare(const std::vector<Record>& a, const std::vector<Record>& b,
                   const CompareRules& rules);

}  // namespace airybench
