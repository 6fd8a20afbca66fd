// The output folder: records.jsonl (a line per case, written as it ends), results.csv (the flat
// view, written at the end), fields/ (on request). results.json is Google Benchmark's own.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/records/record.hpp"

namespace airybench {

struct OutputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class RecordFiles {
 public:
  // Makes the folder. What an earlier run left there stays until the first record of this one, and
  // with keep_others beyond: then only records of the same cases (mesh, scene, method, stop, study,
  // knob) go. Throws OutputError, also for records to keep that cannot be read.
  RecordFiles(std::filesystem::path folder, std::map<std::string, std::string> context,
              bool keep_others);

  void append(const Record& record);  // one line, flushed; throws OutputError
  // results.csv of all records, and Google Benchmark's file, which is of this run, under its name.
  void finish() const;
  void abandon() const;  // removes the file that Google Benchmark writes while the run goes on

  // Where Google Benchmark writes while the run goes on.
  static std::filesystem::path benchmark_json_part(const std::filesystem::path& folder);

 private:
  std::filesystem::path folder_;
  std::map<std::string, std::string> context_;
  std::vector<nlohmann::ordered_json> records_;  // those of the folder
  std::ofstream lines_;
};

// The lines of records.jsonl, whole; none if there is no file. Throws OutputError.
std::vector<nlohmann::ordered_json> stored_records(const std::filesystem::path& file);

// results.csv as text: a header, a row per record as to_json() gives it; empty: does not apply. RFC
// 4180.
std::string csv_text(const std::vector<nlohmann::ordered_json>& records);

// A cell of it: null is empty, a text is quoted where it must be.
std::string csv_field(const nlohmann::ordered_json& value);

}  // namespace airybench
