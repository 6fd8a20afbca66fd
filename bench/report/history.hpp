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

// A change of one case and one quantity in a run.
struct Finding {
  std::string case_name;  // "Mesh0/default/3STEPD"; "all cases"
  Lane lane = Lane::status;
  std::string quantity;  // "linear_iterations"
  Json before, after;    // numbers, or texts; null: not known
  Kind kind = Kind::changed;
  std::string since;                       // date of the first run after the change
  std::optional<double> ratio, low, high;  // after/before; of times with its 95 % interval
  std::string sentence;
};

struct TrackedRun {
  std::filesystem::path file;  // empty: not in a history yet
  std::string date;            // ISO 8601, UTC
  std::map<std::string, std::string> context;
  std::vector<double> noise_samples_s;  // of the reference kernel
  std::vector<Record> cases;
  std::vector<Finding> findings;
  bool failed = false;
  bool times_judged = false;  // there were enough runs of the machine

  const Record* find(const std::string& case_name) const;   // or null
  std::string context_value(const std::string& key) const;  // "" where it has none
  // Processor, number of processors, threads. Only runs of the same machine are compared.
  std::string machine() const;
};

// Context and date are those of the first record. Throws RecordError: no records, or no usable
// date.
TrackedRun tracked_run_of(std::vector<Record> records, const std::string& source);

// From a file's text. Throws RecordError.
TrackedRun parse_tracked_run(const std::string& text, const std::filesystem::path& file);
// In the order of dates. Empty where there is no folder yet. Throws RecordError, which names the
// file that is torn or wrong.
std::vector<TrackedRun> read_history(const std::filesystem::path& folder);

// The file for a run that is not in the history yet: of its date, with "-2" and so on where there
// is another of the same second. Throws RecordError when the history has this very run.
std::filesystem::path file_for(const TrackedRun& run, const std::filesystem::path& folder,
                               const std::vector<TrackedRun>& history);
// Writes run.file whole. Throws FileError.
void write_tracked_run(const TrackedRun& run);

}  // namespace airybench
