// Time and memory of planned cases, predicted from earlier records.
//
// In this order, for time, tuning and memory each:
//   1. the latest record of the same case (mesh, size, scene, method, stop, parameter of a study);
//   2. the power law over the method's other meshes (power_law.hpp), of the same scene where that
//      has two sizes;
//   3. with one size only: that, with the exponent common to all methods;
//   4. else the same from the method's closest relative: the other stop, then the name in the same
//      family that begins most alike.
// A record of a timeout counts with its extrapolated time. A case that will be skipped takes none.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/records/record_reader.hpp"
#include "bench/report/power_law.hpp"

namespace airybench {

// What a run allows and repeats.
struct RunLimits {
  int repetitions = 5;
  double timeout_s = 900, long_case_s = 30;
  std::optional<std::int64_t> memory_limit_bytes = {};
  bool measures_once = false;  // the stability study
};

enum class LimitMark { below, may_pass, above };

struct Prediction {
  std::optional<Estimate> time_s;  // of one solve; empty: unknown
  double tuning_s = 0;             // before it
  std::optional<Estimate> peak_heap_bytes;
  std::optional<double> run_s;  // what the case costs the run, all its solves together
  std::string basis;            // "measured", "7 records, Mesh0..Mesh6", "no record"
  LimitMark timeout = LimitMark::below, memory_limit = LimitMark::below;
};

struct Forecast {
  std::vector<Prediction> cases;       // as planned
  std::optional<double> references_s;  // one per mesh and scene; empty: unknown for one of them
};

// The records of these folders, studies included, oldest first. Folders without records are passed
// over, also files that cannot be used, with a line that says why: a prediction is no reason to
// refuse a run.
struct PastRecords {
  std::vector<Record> records;
  std::vector<std::string> passed_over;
};
PastRecords read_past_records(const std::vector<std::filesystem::path>& folders);
// Of the committed runs that have such cases, and of one more folder.
PastRecords read_committed_records(const std::vector<Record>& cases,
                                   const std::filesystem::path& besides);

// Cases are blank records. Of several records of one case the last one counts, but a study's only
// where there is no other: its runs do more than the method alone.
Forecast forecast(const std::vector<Record>& cases, const std::vector<Record>& records,
                  const RunLimits& limits);

// Seconds that a case takes: tuning, then the detail run, and for a solve up to long_case_s the
// memory run and repetitions until they add up to that. A solve ends at its --timeout.
double run_seconds(double time_s, double tuning_s, const RunLimits& limits);

// A row per case, totals, and a line for each case that may pass a limit.
std::string prediction_table(const std::vector<Record>& cases, const Forecast& forecast,
                             const RunLimits& limits);

}  // namespace airybench
