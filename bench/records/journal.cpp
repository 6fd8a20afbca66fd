#include "bench/records/journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

namespace airybench {

Journal::Journal(const std::filesystem::path& file) : file_(file) {
  descriptor_ = open(file.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0)
    throw FileError(fmt::format("{}: cannot be written: {}", file.string(), strerror(errno)));
}

Journal::~Journal() {
  if (is_open()) close(descriptor_);
}

Journal::Journal(Journal&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

Journal& Journal::operator=(Journal&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

void Journal::append(const std::string& line) {
  const std::string text = line + "\n";
  const off_t before = lseek(descriptor_, 0, SEEK_END);
  int error = 0;
  for (std::size_t written = 0; written < text.size() && error == 0;) {
    const ssize_t n = write(descriptor_, text.data() + written, text.size() - written);
    if (n > 0)
      written += static_cast<std::size_t>(n);
    else if (n < 0 && errno != EINTR)
      error = errno;
  }
  // What cannot be synchronised (a pipe) is where it was meant to go.
  if (error == 0 && fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) error = errno;
  if (error == 0) return;
  // If this fails as well, a torn line stays, and read_journal() passes over it.
  [[maybe_unused]] const int taken_back = ftruncate(descriptor_, before);
  throw FileError(fmt::format("{}: cannot be written: {}", file_.string(), strerror(error)));
}

JournalLines read_journal(const std::filesystem::path& file) {
  JournalLines result;
  std::error_code error;
  if (!std::filesystem::exists(file, error) && !error) return result;
  if (error || !std::filesystem::is_regular_file(file))
    throw FileError(file.string() + ": is not a file of records");
  std::ifstream in(file, std::ios::binary);
  if (!in.is_open()) throw FileError(file.string() + ": cannot be read");
  std::ostringstream bytes;
  bytes << in.rdbuf();
  const std::string text = bytes.str();
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find('\n', begin)) != text.npos; begin = end + 1)
    result.lines.push_back(text.substr(begin, end - begin));
  result.torn = begin < text.size();
  return result;
}

}  // namespace airybench
