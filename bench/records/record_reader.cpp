#include "bench/records/record_reader.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <array>
#include <new>
#include <system_error>
#include <utility>

#include "support/file_text.hpp"

namespace airybench {

namespace {

LineSplitter::Take adding_to(RecordLines& result, const std::filesystem::path& file) {
  return [&result, file](const std::string& text, const Line& line) {
    RecordLine& added = result.lines.emplace_back();
    added.place = place_of(file, line);
    added.json = json_of_text(text, added.place);
    added.record = record_of(added.json, added.place);
  };
}

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

// Passes on what a .gz unpacks to.
class Inflation {
 public:
  using Take = std::function<void(std::string_view part)>;
  Inflation(std::string file, Take take) : file_(std::move(file)), take_(std::move(take)) {
    constexpr int gzip_alone = 16 + MAX_WBITS;
    if (inflateInit2(&stream_, gzip_alone) != Z_OK) throw std::bad_alloc();
  }
  ~Inflation() { inflateEnd(&stream_); }
  Inflation(const Inflation&) = delete;
  Inflation& operator=(const Inflation&) = delete;

  void add(std::string_view packed) {
    // zlib's interface lacks const; inflate() does not write to its input.
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream_.avail_in = static_cast<uInt>(packed.size());
    do {
      if (state_ == Z_STREAM_END && stream_.avail_in == 0) return;
      if (state_ == Z_STREAM_END) inflateReset(&stream_);  // another member follows
      stream_.next_out = reinterpret_cast<Bytef*>(part_.data());
      stream_.avail_out = static_cast<uInt>(part_.size());
      state_ = inflate(&stream_, Z_NO_FLUSH);
      if (state_ == Z_MEM_ERROR) throw std::bad_alloc();
      if (state_ == Z_BUF_ERROR) return;  // wants more
      if (state_ != Z_OK && state_ != Z_STREAM_END)
        throw FileError(file_ + ": is not of gzip, or damaged");
      const std::size_t size = part_.size() - stream_.avail_out;
      bytes_ += size;
      if (bytes_ > most_bytes)
        throw FileError(file_ + ": unpacks to more than 1 GiB (allowed: up to 1 GiB)");
      take_({part_.data(), size});
    } while (stream_.avail_in > 0 || stream_.avail_out == 0);
  }
  void end() const {
    if (state_ != Z_STREAM_END) throw FileError(file_ + ": ends before what gzip has packed does");
  }

 private:
  static constexpr std::size_t most_bytes = std::size_t{1} << 30;
  std::string file_;
  Take take_;
  z_stream stream_ = {};
  int state_ = Z_OK;
  std::size_t bytes_ = 0;
  std::array<char, 1 << 16> part_;
};

}  // namespace

std::string place_of(const std::filesystem::path& file, const Line& line) {
  return fmt::format("{}:{}", file.string(), line.number);
}

bool read_lines(const std::filesystem::path& file, const LineSplitter::Take& take) {
  std::error_code error;
  if (!std::filesystem::exists(file, error) && !error) return false;
  LineSplitter lines(file.string(), take);
  const auto split = [&](std::string_view part) { lines.add(part); };
  if (file.extension() != ".gz") {
    read_parts(file, split);
    return lines.is_torn();
  }
  Inflation inflation(file.string(), split);
  read_parts(file, [&](std::string_view part) { inflation.add(part); });
  inflation.end();
  return lines.is_torn();
}

RecordLines record_lines_of(const std::string& text, const std::string& file) {
  RecordLines result;
  LineSplitter lines(file, adding_to(result, file));
  lines.add(text);
  result.torn = lines.is_torn();
  return result;
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
  RecordLines result;
  const bool torn = read_lines(file, adding_to(result, file));
  check_has_records(file, torn, result.lines.empty());
  return std::move(result.lines);
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

std::string unpacked(const std::string& bytes, const std::string& file) {
  std::string text;
  Inflation inflation(file, [&](std::string_view part) { text += part; });
  inflation.add(bytes);
  inflation.end();
  return text;
}

}  // namespace airybench
