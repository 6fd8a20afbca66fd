// Reads files of records back, also packed ones.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/records/record.hpp"

namespace airybench {

struct RecordLine {
  std::string place;  // "results/latest/records.jsonl:3"
  Json json;          // with keys that are no fields
  Record record;
};

struct RecordLines {
  std::vector<RecordLine> lines;
  bool torn = false;  // the last one was half written, and is not among them
};

// records.jsonl of a folder that bench wrote; records.jsonl.gz where it is packed.
std::filesystem::path records_file_in(const std::filesystem::path& folder);

// A file that is not there has no lines, one that ends in .gz is unpacked. Throws FileError;
// RecordError: a line that is no record.
RecordLines read_record_lines(const std::filesystem::path& file);
// The same of a file's text; file is what messages name.
RecordLines record_lines_of(const std::string& text, const std::string& file);
// Of a folder's records, packed or not. Throws FileError, also where there is none.
std::vector<RecordLine> lines_in(const std::filesystem::path& folder);

enum class Studies { leave_out, include };
// In the order of the lines. Throws RecordError, also where there is no such file.
std::vector<Record> read_records(const std::filesystem::path& file,
                                 Studies studies = Studies::leave_out);

// The bytes of a .gz (RFC 1952), of one member or several, unpacked: at most 1 GiB. Throws
// FileError "file: why".
std::string unpacked(const std::string& bytes, const std::string& file);

}  // namespace airybench
