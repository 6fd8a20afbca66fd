#include "bench/records/record_reader.hpp"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "support/file_text.hpp"
#include "support/gzip.hpp"

namespace airybench {

namespace {

void check_is_there(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_regular_file(file, error)) return;
  if (error && error != std::errc::no_such_file_or_directory)
    throw RecordError(fmt::format("{}: {}", file.string(), error.message()));
  throw RecordError(file.string() + ": no such file (a folder that bench --out wrote has it)");
}

void check_has_records(const std::filesystem::path& file, bool torn, bool empty) {
  if (torn && empty)
    throw RecordError(file.string() +
                      ": only the start of a record (of a run that was ended; --resume goes on)");
}

}  // namespace

std::string place_of(const std::filesystem::path& file, const Line& line) {
  return fmt::format("{}:{}", file.string(), line.number);
}

bool read_lines(const std::filesystem::path& file, const LineSplitter::Take& take) {
  std::error_code error;
  if (!std::filesystem::exists(file, error) && !error) return false;
  LineSplitter lines(file.string(), take);
  const auto split = [&](std::string_view part) { lines.add(part); };
  (file.extension() == ".gz" ? read_unpacked_parts : read_parts)(file, split);
  return lines.is_torn();
}

std::filesystem::path records_file_in(const std::filesystem::path& folder) {
  std::filesystem::path file = folder / "records.jsonl", packed = folder / "records.jsonl.gz";
  std::error_code error;
  const bool is_packed =
      !std::filesystem::exists(file, error) && std::filesystem::exists(packed, error);
  return is_packed ? packed : file;
}

std::vector<RecordLine> lines_in(const std::filesystem::path& folder) {
  const std::filesystem::path file = records_file_in(folder);
  check_is_there(file);
  std::vector<RecordLine> lines;
  const bool torn = read_lines(file, [&](const std::string& text, const Line& line) {
    RecordLine& added = lines.emplace_back();
    added.place = place_of(file, line);
    added.json = json_of_text(text, added.place);
    added.record = record_of(added.json, added.place);
  });
  check_has_records(file, torn, lines.empty());
  return lines;
}

std::vector<Record> read_records(const std::filesystem::path& file, Studies studies) {
  check_is_there(file);
  std::vector<Record> records;
  bool any = false;
  const bool torn = read_lines(file, [&](const std::string& text, const Line& line) {
    any = true;
    Record record = record_of_text(text, place_of(file, line));
    if (studies == Studies::include || record.study.empty()) records.push_back(std::move(record));
  });
  check_has_records(file, torn, !any);
  return records;
}

}  // namespace airybench
