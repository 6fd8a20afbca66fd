// The output folder: records.jsonl (a line per case, on disk before the next case starts),
// results.csv (the flat view) and results.json (Google Benchmark's schema), both written at the
// end, fields/ (on request).
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/records/journal.hpp"
#include "bench/records/json.hpp"
#include "bench/records/record.hpp"
#include "bench/records/run_identity.hpp"

namespace airybench {

// What becomes of the records that a folder has.
enum class Keep {
  none,      // they go when the first of this run comes
  others,    // only those of the same cases go, whatever they were measured with
  finished,  // all stay, and must be of the same machine, program and settings as this run
};

class RecordFiles {
 public:
  // Makes the folder. Throws OutputError: the folder, records to keep that cannot be read or, with
  // Keep::finished, are of another run.
  RecordFiles(std::filesystem::path folder, Context context, Keep keep);

  // With Keep::finished: the record of this case, if there is one. Throws OutputError when its mesh
  // or scene was another.
  std::optional<Record> finished(const Record& blank) const;

  // One line, on disk when it returns; throws OutputError.
  void append(const Record& record);
  // results.csv and results.json, of all records of the folder.
  void finish() const;

  bool was_torn() const { return torn_; }  // a line was half written, and is dropped

 private:
  std::filesystem::path records_file() const { return folder_ / "records.jsonl"; }
  void rewrite();  // all records, whole

  std::filesystem::path folder_;
  Context context_;
  Keep keep_;
  std::vector<Json> records_;                    // those of the folder
  std::map<std::string, std::size_t> finished_;  // with Keep::finished: identity → place there
  bool torn_ = false;
  Journal journal_;
};

// The records of a folder, as they stand there. Throws OutputError: file, line, what is allowed.
std::vector<Json> read_record_lines(const std::filesystem::path& folder);
Context context_of(const Json& record);

// Same mesh, scene, method, stop, study and knob?
bool same_case(const Json& a, const Json& b);
// See case_name.hpp.
std::string case_name(const Json& record);

// records.jsonl, results.csv and results.json of these records; each file whole or not at all.
void write_records(const std::filesystem::path& folder, const std::vector<Json>& records);

// results.csv as text: a header, a row per record as to_json() gives it; empty: does not apply. RFC
// 4180.
std::string csv_text(const std::vector<Json>& records);

// A cell of it: null is empty, a text is quoted where it must be.
std::string csv_field(const Json& value);

}  // namespace airybench
