// Reads records.jsonl back: the keys that comparisons between cases need, of every line.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bench/records/json.hpp"
#include "solvers/solution.hpp"

namespace airybench {

// what() is one line: file, line number, key, value, what is allowed.
struct RecordError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct CaseRecord {
  std::string mesh, scene, method;  // method as it was asked for: "SDTIC3"
  Status status = Status::crashed;
  std::string stop;                      // "target" or "paper"; empty: the run made no difference
  std::string study, knob;               // empty: an ordinary run
  std::optional<double> knob_value;      // of a study
  std::vector<double> samples_s;         // every timed run
  std::optional<double> time_s;          // their median
  std::optional<double> noise_kernel_s;  // of the fixed kernel that is timed between cases
  std::optional<double> assembly_s;      // of the blocks, not in time_s
  std::optional<double> tuning_s;        // not in time_s
  std::optional<double> peak_rss_bytes;
  std::optional<double> stage_contact_s;
  std::optional<double> done_fraction, extrapolated_time_s;  // status timeout only
  std::optional<double> error_stress, error_force, equilibrium_residual;
  std::string answer_hash;  // of contact forces and stresses; empty: not known
  // Whole numbers that do not scatter.
  std::optional<std::int64_t> n_phi, linear_iterations, contact_iterations, uzawa_iterations,
      factor_entries, factor_flops, storage_bytes, peak_heap_bytes, heap_allocations,
      heap_allocated_bytes, instructions;
  std::map<std::string, std::string> context;  // of the run: cpu, compiler, libraries

  std::string name() const;  // see case_name.hpp
  std::string date() const;  // UTC, "2026-11-21T11:28:12Z"; empty: the line does not say
};

// Names of members that are read, written and compared alike.
using CountMember = std::pair<const char*, std::optional<std::int64_t> CaseRecord::*>;
inline constexpr std::array<CountMember, 11> count_members = {{
    {"n_phi", &CaseRecord::n_phi},
    {"linear_iterations", &CaseRecord::linear_iterations},
    {"contact_iterations", &CaseRecord::contact_iterations},
    {"uzawa_iterations", &CaseRecord::uzawa_iterations},
    {"factor_entries", &CaseRecord::factor_entries},
    {"factor_flops", &CaseRecord::factor_flops},
    {"storage_bytes", &CaseRecord::storage_bytes},
    {"peak_heap_bytes", &CaseRecord::peak_heap_bytes},
    {"heap_allocations", &CaseRecord::heap_allocations},
    {"heap_allocated_bytes", &CaseRecord::heap_allocated_bytes},
    {"instructions", &CaseRecord::instructions},
}};
using NumberMember = std::pair<const char*, std::optional<double> CaseRecord::*>;
inline constexpr std::array<NumberMember, 3> error_members = {{
    {"error_stress", &CaseRecord::error_stress},
    {"error_force", &CaseRecord::error_force},
    {"equilibrium_residual", &CaseRecord::equilibrium_residual},
}};
// Shown over the nights, not judged.
inline constexpr std::array<NumberMember, 3> shown_members = {{
    {"assembly_s", &CaseRecord::assembly_s},
    {"tuning_s", &CaseRecord::tuning_s},
    {"peak_rss_bytes", &CaseRecord::peak_rss_bytes},
}};

// All bytes of a file of records; throws RecordError "file: why".
std::string text_of_records(const std::filesystem::path& file);

// Keys that are not in CaseRecord are passed over; null and a missing key are the same. `place` is
// what a RecordError begins with.
CaseRecord case_record(const Json& json, const std::string& place);

enum class Studies { leave_out, include };
// In the order of the lines; one that is half written is none. Throws RecordError.
std::vector<CaseRecord> read_records(const std::filesystem::path& file,
                                     Studies studies = Studies::leave_out);

// Ended with something whose time counts: ok or inaccurate.
bool has_answer(const CaseRecord& record);

}  // namespace airybench
