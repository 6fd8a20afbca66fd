#include "bench/records/journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "support/atomic_file.hpp"
#include "support/file_text.hpp"

namespace airybench {

Journal::Journal(const std::filesystem::path& file) : file_(file) {
  // O_NONBLOCK: do not block on a FIFO.
  descriptor_ = open(file.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC | O_NONBLOCK, 0666);
  if (descriptor_ < 0)
    throw FileError(fmt::format("{}: cannot be written: {}", file.string(), strerror(errno)));
  struct stat opened = {};
  if (fstat(descriptor_, &opened) != 0 || !S_ISREG(opened.st_mode)) {
    close(descriptor_);
    throw FileError(file.string() +
                    ": is no regular file (allowed: one, or a name that is not there)");
  }
  sync_folder(file.parent_path());
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
  if (!is_open_as(descriptor_, file_))
    throw FileError(file_.string() + ": was removed or replaced while the run wrote it");
  const off_t before = lseek(descriptor_, 0, SEEK_END);
  int error = write_all(descriptor_, line + "\n");
  if (error == 0 && fsync(descriptor_) != 0) error = errno;
  if (error == 0) return;
  // If truncation fails too, a torn line stays, which read_journal() ignores.
  [[maybe_unused]] const int taken_back = ftruncate(descriptor_, before);
  throw FileError(fmt::format("{}: cannot be written: {}", file_.string(), strerror(error)));
}

JournalLines journal_lines_of(const std::string& text) {
  JournalLines result;
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find('\n', begin)) != text.npos; begin = end + 1)
    result.lines.push_back(text.substr(begin, end - begin));
  result.torn = begin < text.size();
  return result;
}

JournalLines read_journal(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error) && !error) return {};
  return journal_lines_of(file_text(file));
}

}  // namespace airybench
