#include "bench/records/record_reader.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <array>
#include <new>

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

void check_is_there(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw RecordError(file.string() + ": no such file (a folder that bench --out wrote has it)");
}

struct Inflation {
  Inflation() {
    constexpr int gzip_alone = 16 + MAX_WBITS;
    if (inflateInit2(&stream, gzip_alone) != Z_OK) throw std::bad_alloc();
  }
  ~Inflation() { inflateEnd(&stream); }
  Inflation(const Inflation&) = delete;
  Inflation& operator=(const Inflation&) = delete;

  z_stream stream = {};
};

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

std::vector<RecordLine> lines_in(const std::filesystem::path& folder) {
  const std::filesystem::path file = records_file_in(folder);
  check_is_there(file);
  return read_record_lines(file).lines;
}

std::vector<Record> read_records(const std::filesystem::path& file, Studies studies) {
  check_is_there(file);
  std::vector<Record> records;
  const std::vector<std::string> lines = lines_of(file).lines;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    Record record = record_of_text(lines[i], place_of(file.string(), i));
    if (studies == Studies::include || record.study.empty()) records.push_back(std::move(record));
  }
  return records;
}

std::string unpacked(const std::string& bytes, const std::string& file) {
  constexpr std::size_t most_bytes = std::size_t{1} << 30;
  if (bytes.size() > most_bytes) throw FileError(file + ": larger than 1 GiB");
  Inflation inflation;
  z_stream& stream = inflation.stream;
  // zlib's interface lacks const; inflate() does not write to its input.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  std::string text;
  std::array<char, 1 << 16> part;
  for (int state = Z_OK; state != Z_STREAM_END || stream.avail_in > 0;) {
    if (state == Z_STREAM_END) inflateReset(&stream);  // another member follows
    stream.next_out = reinterpret_cast<Bytef*>(part.data());
    stream.avail_out = static_cast<uInt>(part.size());
    state = inflate(&stream, Z_NO_FLUSH);
    if (state == Z_MEM_ERROR) throw std::bad_alloc();
    if (state == Z_BUF_ERROR) throw FileError(file + ": ends before what gzip has packed does");
    if (state != Z_OK && state != Z_STREAM_END)
      throw FileError(file + ": is not of gzip, or damaged");
    text.append(part.data(), part.size() - stream.avail_out);
    if (text.size() > most_bytes) throw FileError(file + ": unpacks to more than 1 GiB");
  }
  return text;
}

}  // namespace airybench
