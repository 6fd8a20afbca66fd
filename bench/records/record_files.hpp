// The output folder: records.jsonl (a line per case, on disk before the next case starts),
// results.csv (the flat view) and results.json (Google Benchmark's schema), both written at the
// end, fields/ (on request).
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/records/context.hpp"
#include "bench/records/journal.hpp"
#include "bench/records/record_reader.hpp"
#include "support/folder_lock.hpp"

namespace airybench {

// What becomes of the records that a folder has.
enum class Keep {
  none,      // they go when the first of this run comes
  others,    // those of the same cases go, whatever they were measured with
  finished,  // all stay, and must be of the same machine, program and settings as this run
};

class RecordFiles {
 public:
  // Makes the folder, and locks it. Throws FileError: the folder cannot be made or is locked;
  // records to keep cannot be read or, with Keep::finished, are of another run.
  RecordFiles(const std::filesystem::path& folder, Context context, Keep keep);

  // With Keep::finished: the record of this case, if there is one that no fault of the machine
  // made. Throws FileError when its mesh or scene was another.
  std::optional<Record> finished(const Record& blank) const;

  // One line, on disk when it returns, with the run's context; throws FileError.
  void append(Record record);
  // results.csv and results.json, of all records of the folder.
  void finish() const;

  bool was_torn() const { return torn_; }  // a line was half written, and is dropped

 private:
  std::filesystem::path records_file() const { return folder_ / "records.jsonl"; }
  void rewrite();  // all records, whole

  std::filesystem::path folder_;
  FolderLock lock_;
  Context context_;
  Keep keep_;
  std::vector<RecordLine> lines_;                // those of the folder
  std::map<std::string, std::size_t> finished_;  // with Keep::finished: name → place there
  bool torn_ = false;
  Journal journal_;
};

// records.jsonl, results.csv and results.json of these; each file whole or not at all. Throws
// FileError, also when the folder is locked.
void write_records(const std::filesystem::path& folder, const std::vector<RecordLine>& lines);

}  // namespace airybench
