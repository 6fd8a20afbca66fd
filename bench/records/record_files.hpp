// The output folder: records.jsonl (a line per case, on disk before the next case starts) and,
// written at the end, results.csv (flat) and results.json (Google Benchmark's schema).
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

enum class Keep {
  none,      // the first new record removes them
  others,    // a new record replaces the old one of its case
  finished,  // all; machine, program and settings must be those of this run
};

class RecordFiles {
 public:
  // Makes and locks the folder. Throws FileError if that fails, if records to keep cannot be read
  // or, with Keep::finished, if they belong to another run.
  RecordFiles(const std::filesystem::path& folder, Context context, Keep keep);

  // With Keep::finished: the case's record, unless a fault of the machine made it. Throws FileError
  // if mesh, scene or program differs.
  std::optional<Record> finished(const Record& blank) const;

  // Adds the context. The line is on disk when append() returns. Throws FileError.
  void append(Record record);
  void finish() const;  // writes results.csv and results.json

  bool was_torn() const { return torn_; }  // dropped an incomplete line

 private:
  std::filesystem::path records_file() const { return folder_ / "records.jsonl"; }
  void rewrite();

  std::filesystem::path folder_;
  FolderLock lock_;
  Context context_;
  Keep keep_;
  std::vector<RecordLine> lines_;                // of the folder
  std::map<std::string, std::size_t> finished_;  // with Keep::finished: case name → index in lines_
  bool torn_ = false;
  Journal journal_;
};

// Writes the folder's files, each atomically. Throws FileError, also if the folder is locked.
void write_records(const std::filesystem::path& folder, const std::vector<RecordLine>& lines);

}  // namespace airybench
