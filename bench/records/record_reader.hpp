// Reads records.jsonl back: the keys that comparisons between cases need, of every line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "solvers/solution.hpp"

namespace airybench {

// what() is one line: file, line number, key, value, what is allowed.
struct RecordError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct CaseRecord {
  std::string mesh, scene, method;  // method as it was asked for: "SDTIC3"
  int n_phi = 0;                    // 0: the line does not say
  Status status = Status::crashed;
  std::string stop;                // "target" or "paper"; empty: the run made no difference
  std::vector<double> samples_s;   // every timed run
  std::optional<double> time_s;    // their median
  std::optional<double> tuning_s;  // not in time_s
  std::optional<double> stage_contact_s;
  std::optional<std::int64_t> peak_heap_bytes, storage_bytes;
  std::optional<double> done_fraction, extrapolated_time_s;  // status timeout only
  std::string study;                                         // empty: an ordinary run
  std::string knob;                                          // what a study turned; empty: nothing
  std::optional<double> knob_value;
  std::string date;  // UTC, "2026-11-21T11:28:12Z"; empty: the line does not say
};

enum class StudyRecords { left_out, kept };

// In the order of the lines; keys that are not in CaseRecord are passed over. Throws RecordError.
std::vector<CaseRecord> read_records(const std::filesystem::path& file,
                                     StudyRecords of_studies = StudyRecords::left_out);

}  // namespace airybench
