// Reads files of records, plain or packed with gzip.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/records/journal.hpp"
#include "bench/records/record.hpp"

namespace airybench {

struct RecordLine {
  std::string place;  // "results/latest/records.jsonl:3"
  Json json;          // includes unknown keys
  Record record;
};

// records.jsonl, or records.jsonl.gz if only that exists.
std::filesystem::path records_file_in(const std::filesystem::path& folder);

// Passes the complete lines of a file, .gz unpacked, and returns whether an incomplete one follows.
// A missing file has none. Holds one line at a time. Throws FileError: see LineSplitter; or a .gz
// unpacks to more than 1 GiB.
bool read_lines(const std::filesystem::path& file, const LineSplitter::Take& take);
std::string place_of(const std::filesystem::path& file, const Line& line);  // "o/records.jsonl:3"

// Throws FileError, also if the folder has no file of records, or only the start of a record.
std::vector<RecordLine> lines_in(const std::filesystem::path& folder);

enum class Studies { leave_out, include };
// Throws FileError, or RecordError for a bad line, a missing file, or only the start of a record.
std::vector<Record> read_records(const std::filesystem::path& file,
                                 Studies studies = Studies::leave_out);

}  // namespace airybench
