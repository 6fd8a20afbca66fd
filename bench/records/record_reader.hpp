// Reads files of records, plain or packed with gzip.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/records/record.hpp"

namespace airybench {

struct RecordLine {
  std::string place;  // "results/latest/records.jsonl:3"
  Json json;          // includes unknown keys
  Record record;
};

struct RecordLines {
  std::vector<RecordLine> lines;
  bool torn = false;  // an incomplete last line was left out
};

// records.jsonl, or records.jsonl.gz if only that exists.
std::filesystem::path records_file_in(const std::filesystem::path& folder);

// A missing file has no lines; .gz is unpacked. Throws FileError, or RecordError for a bad line.
RecordLines read_record_lines(const std::filesystem::path& file);
RecordLines record_lines_of(const std::string& text, const std::string& file);  // file: in messages
// Throws FileError, also if the folder has no file of records.
std::vector<RecordLine> lines_in(const std::filesystem::path& folder);

enum class Studies { leave_out, include };
// Throws FileError, or RecordError for a bad line or a missing file.
std::vector<Record> read_records(const std::filesystem::path& file,
                                 Studies studies = Studies::leave_out);

// Unpacks a .gz (RFC 1952) with one or several members, up to 1 GiB. Throws FileError "file: why".
std::string unpacked(const std::string& bytes, const std::string& file);

}  // namespace airybench
