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

// Throws FileError if records could not be written to this folder, which need not be there.
void check_takes_records(const std::filesystem::path& folder);

// Holds where records are, not the records: a run may have many.
class RecordFiles {
 public:
  // Makes and locks the folder. Throws FileError if that fails or the files could not be written,
  // if records to keep cannot be read or, with Keep::finished, if they belong to another run.
  RecordFiles(const std::filesystem::path& folder, Context context, Keep keep);

  // With Keep::finished: the case's record, unless a fault of the machine made it. Throws FileError
  // if mesh, scene or program differs.
  std::optional<Record> finished(const Record& blank) const;

  // Adds the context; returns the record as it will be read. The line is on disk when append()
  // returns. Throws FileError, or RecordError for values that could not be read; the records so far
  // are untouched then.
  Record append(Record record);
  void finish();  // writes results.csv and results.json, and unlocks the folder

  bool has(const std::string& case_name) const { return lines_.contains(case_name); }
  Record read(const std::string& case_name) const;  // that has(). Throws FileError.
  bool was_torn() const { return torn_; }           // dropped an incomplete line

 private:
  std::filesystem::path records_file() const { return folder_ / "records.jsonl"; }
  Record read(const Line& line) const;
  std::vector<std::pair<Line, std::string>> lines_in_order() const;
  void rewrite_with(const std::string& case_name, const std::string& text);

  std::filesystem::path folder_;
  std::optional<FolderLock> lock_;
  Context context_;
  Keep keep_;
  std::multimap<std::string, Line> lines_;  // to keep, by the case's name
  bool torn_ = false, ends_torn_ = false;
  Journal journal_;  // closed: the next record begins a new file
};

// Writes the folder's files; if that fails, the old ones stand. Throws FileError, also if the
// folder is locked.
void write_records(const std::filesystem::path& folder, const std::vector<RecordLine>& lines);

}  // namespace airybench
