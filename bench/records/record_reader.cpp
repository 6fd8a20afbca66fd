#include "bench/records/record_reader.hpp"

#include <fmt/format.h>

#include "bench/records/gzip.hpp"
#include "bench/records/journal.hpp"
#include "support/file_text.hpp"

namespace airybench {

namespace {

std::string place_of(const std::string& file, std::size_t line) {
  return fmt::format("{}:{}", file, line + 1);
}

RecordLines record_lines_of(const JournalLines& journal, const std::string& file) {
  RecordLines result;
  result.torn = journal.torn;
  for (const std::string& text : journal.lines) {
    RecordLine& line = result.lines.emplace_back();
    line.place = place_of(file, result.lines.size() - 1);
    line.json = json_of_text(text, line.place);
    line.record = record_of(line.json, line.place);
  }
  return result;
}

JournalLines lines_of(const std::filesystem::path& file) {
  if (file.extension() == ".gz") return journal_lines_of(unpacked(file_text(file), file.string()));
  return read_journal(file);
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
  return record_lines_of(lines_of(file), file.string());
}

std::vector<Record> read_records(const std::filesystem::path& file, Studies studies) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw RecordError(file.string() + ": no such file (a folder that bench --out wrote has it)");
  std::vector<Record> records;
  const std::vector<std::string> lines = lines_of(file).lines;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    Record record = record_of_text(lines[i], place_of(file.string(), i));
    if (studies == Studies::include || record.study.empty()) records.push_back(std::move(record));
  }
  return records;
}

}  // namespace airybench
