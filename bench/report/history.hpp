// The nights of a nightly run: a folder with one file per night, nights/2026-11-21T030000Z.json,
//   {"format": "airybench-night-1", "date": "2026-11-21T03:00:00Z", "context": {…},
//    "noise": {"median_s", "mad_s", "samples_s"},   the reference kernel, over the night
//    "cases": [{…}], "verdicts": [{…}], "failed": true | false}
// A case has the fields of a record that are `nightly`. What is not known is null.
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

// What a night's judgement says of one case and one quantity.
struct Finding {
  std::string case_name;  // "Mesh0/default/3STEPD"; "all cases"
  Lane lane = Lane::status;
  std::string quantity;  // "linear_iterations"
  Json before, after;    // numbers, or texts; null: not known
  Kind kind = Kind::changed;
  std::string since;                       // date of the first night after the change
  std::optional<double> ratio, low, high;  // after/before; of times with its 95 % interval
  std::string sentence;
};

struct Night {
  std::filesystem::path file;  // empty: not in a history yet
  std::string date;            // ISO 8601, UTC
  std::map<std::string, std::string> context;
  std::vector<double> noise_samples_s;  // of the reference kernel
  std::vector<Record> cases;
  std::vector<Finding> findings;
  bool failed = false;
  bool times_judged = false;  // there were enough nights of the machine

  const Record* find(const std::string& case_name) const;   // or null
  std::string context_value(const std::string& key) const;  // "" where it has none
  // Runs of the same machine: processor, their number, threads. Only these are compared.
  std::string machine() const;
};

// A night of records as a run writes them; the context is the first record's. Its date is the
// context's. Throws RecordError: no records, or no usable date ("date").
Night night_of(std::vector<Record> records, const std::string& source);

// A night's file, from its text. Throws RecordError.
Night parse_night(const std::string& text, const std::filesystem::path& file);
// In the order of dates. Empty where there is no folder yet. Throws RecordError, which names a file
// that is no whole night.
std::vector<Night> read_history(const std::filesystem::path& folder);

// The file for a night that is not in the history yet: of its date, with "-2" and so on where there
// is another of the same second. Throws RecordError when the history has this very night.
std::filesystem::path file_for(const Night& night, const std::filesystem::path& folder,
                               const std::vector<Night>& history);
// Writes night.file whole. Throws FileError.
void write_night(const Night& night);

}  // namespace airybench
