// Time and memory of planned cases, from the record of an earlier one: the latest of the same case
// (mesh, size, scene, method, stop, parameter of a study), else the method's nearest in size,
// scaled by n log n, else that of the closest relative: the other stop, then the name in the family
// with the longest common beginning. A timeout counts with its extrapolated time. A skipped case
// takes no time.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/records/record_reader.hpp"

namespace airybench {

// A value and its range of two standard deviations of the logarithm (about 19 of 20 cases).
struct Estimate {
  double value = 0, low = 0, high = 0;
};
Estimate estimate_of(double value, double scatter);  // scatter: that standard deviation

// n log n, from one number of unknowns to another.
double growth(std::int64_t from, std::int64_t to);

struct RunLimits {
  int repetitions = 5;
  double timeout_s = 900, long_case_s = 30;
  std::optional<std::int64_t> memory_limit_bytes = {};
  bool measures_once = false;  // the stability study
};

enum class LimitMark { below, may_pass, above };

struct Prediction {
  std::optional<Estimate> time_s;  // of one solve; empty: unknown
  double tuning_s = 0;             // before the solve
  std::optional<Estimate> peak_heap_bytes;
  std::optional<double> run_s;  // total of the case, all solves
  std::string basis;  // "measured", "measured on Mesh6/default, scaled by n log n", "no record"
  LimitMark timeout = LimitMark::below, memory_limit = LimitMark::below;
};

struct Forecast {
  std::vector<Prediction> cases;       // in the order of the cases
  std::optional<double> references_s;  // one per mesh and scene; empty: one is unknown
};

// The records of these folders, studies included, oldest first. Skips folders without records, and
// unusable files with a line that says why.
struct PastRecords {
  std::vector<Record> records;
  std::vector<std::string> passed_over;
};
PastRecords read_past_records(const std::vector<std::filesystem::path>& folders);
PastRecords read_committed_records(const std::vector<Record>& cases,
                                   const std::filesystem::path& besides);

// cases: blank records. The last record of a case counts; a study's only if there is no other,
// since it does more than the method alone.
Forecast forecast(const std::vector<Record>& cases, const std::vector<Record>& records,
                  const RunLimits& limits);

// What a measured case takes of the time that the records predict for it; 1 if they cannot.
double time_of_machine(const Record& measured, const std::vector<Record>& records);

// Seconds per case: tuning, the detail run, and for a solve up to long_case_s the memory run and
// repetitions until they add up to that. A solve ends at its --timeout.
double run_seconds(double time_s, double tuning_s, const RunLimits& limits);

// One row per case, totals, and one line per case that may exceed a limit.
std::string prediction_table(const std::vector<Record>& cases, const Forecast& forecast,
                             const RunLimits& limits);

}  // namespace airybench
