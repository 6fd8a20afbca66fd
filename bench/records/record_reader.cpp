#include "bench/records/record_reader.hpp"

#include <fmt/format.h>

#include "bench/records/gzip.hpp"
#include "bench/records/journal.hpp"
#include "support/file_text.hpp"

namespace airybench {

namespace {

RecordLines record_lines_of(const JournalLines& journal, const std::string& file) {
  RecordLines result;
  result.torn = journal.torn;
  for (const std::string& text : journal.lines) {
    RecordLine& line = result.lines.emplace_back();
    line.place = fmt::format("{}:{}", file, result.lines.size());
    try {
      line.json = parse_json(text);
    } catch (const Json::exception& wrong) {
      throw RecordError(fmt::format("{}: not JSON: {}", line.place, without_prefix(wrong)));
    }
    line.record = record_of(line.json, line.place);
  }
  return result;
}

}  // namespace

RecordLines record_lines_of(const std::string& text, const std::string& file) {
  return record_lines_of(journal_lines_of(text), file);
}

std::filesystem::path records_file_in(const std::filesystem::path& folder) {
  std::filesystem::path file = folder / "records.jsonl", packed = folder / "records.jsonl.gz";
  std::error_code error;
  const bool is_packed =
      !std::filesystem::exists(file, error) && std::filesystem::exists(packed, error);
  return is_packed ? packed : file;
}

RecordLines read_record_lines(const std::filesystem::path& file) {
  if (file.extension() == ".gz")
    return record_lines_of(unpacked(file_text(file), file.string()), file.string());
  return record_lines_of(read_journal(file), file.string());
}

std::vector<Record> read_records(const std::filesystem::path& file, Studies studies) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw RecordError(file.string() + ": no such file (a folder that bench --out wrote has it)");
  std::vector<Record> records;
  for (RecordLine& line : read_record_lines(file).lines)
    if (studies == Studies::include || line.record.study.empty())
      records.push_back(std::move(line.record));
  return records;
}

}  // namespace airybench
