// A history: a folder with one file per tracked run, nights/2026-11-21T030000Z.json,
//   {"format": "airybench-night-1", "date": "2026-11-21T03:00:00Z", "context": {…},
//    "noise": {"median_s", "mad_s", "samples_s"},   the reference kernel, over the run
//    "cases": [{…}], "verdicts": [{…}], "failed": true | false, "times_judged": true | false}
// A case has the fields of a record that are `nightly`. Unknown values are null.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/records/json.hpp"
#include "bench/records/record_reader.hpp"

namespace airybench {

enum class Lane { status, counters, errors, times };
enum class Kind { worse, better, changed };
std::string_view name_of(Lane lane);
std::string_view name_of(Kind kind);

struct Finding {
  std::string case_name;  // "Mesh0/default/3STEPD"; "all cases"
  Lane lane = Lane::status;
  std::string quantity;  // "linear_iterations"
  Json before, after;    // numbers or texts; null: unknown
  Kind kind = Kind::changed;
  std::string since;                       // date of the first run after the change
  std::optional<double> ratio, low, high;  // after/before; times: with 95 % interval
  std::string sentence;
};

struct TrackedRun {
  std::filesystem::path file;  // empty: not yet in a history
  std::string date;            // ISO 8601, UTC
  std::map<std::string, std::string> context;
  std::vector<double> noise_samples_s;  // of the reference kernel
  std::vector<Record> cases;
  std::vector<Finding> findings;
  bool failed = false;
  bool times_judged = false;  // the machine has enough runs

  const Record* find(const std::string& case_name) const;  // or null
  // Processor, processor count, threads. Only runs of the same machine are compared.
  std::string machine() const;
};

// All of these throw FileError, which names the file.

// Context and date of the first record.
TrackedRun tracked_run_of(std::vector<Record> records, const std::string& source);

TrackedRun parse_tracked_run(const std::string& text, const std::filesystem::path& file);
// By date. Empty if there is no folder.
std::vector<TrackedRun> read_history(const std::filesystem::path& folder);

// A new file's name: the date, with "-2", "-3", … for runs of the same second. Refuses a run that
// the history has.
std::filesystem::path file_for(const TrackedRun& run, const std::filesystem::path& folder,
                               const std::vector<TrackedRun>& history);
// Atomic.
void write_tracked_run(const TrackedRun& run);

}  // namespace airybench
