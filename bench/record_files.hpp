// The output folder: records.jsonl (a line per case, written as it ends), results.csv (the flat
// view, written at the end), fields/ (on request). results.json is Google Benchmark's own.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/record.hpp"

namespace airybench {

struct OutputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class RecordFiles {
 public:
  // Makes the folder and begins records.jsonl anew. Throws OutputError.
  RecordFiles(std::filesystem::path folder, std::map<std::string, std::string> context);

  void append(const Record& record);  // one line, flushed; throws OutputError
  void write_csv(const std::vector<Record>& records) const;
  std::filesystem::path benchmark_json_in_the_making() const;  // hidden until finished
  void finish_benchmark_json() const;

 private:
  std::filesystem::path folder_;
  std::map<std::string, std::string> context_;
  std::ofstream lines_;
};

// results.csv as text: a header, a row per record; empty: does not apply. RFC 4180.
std::string csv_text(const std::vector<Record>& records);

}  // namespace airybench
