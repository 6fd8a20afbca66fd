#include "bench/records/journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <iterator>
#include <utility>

#include "support/atomic_file.hpp"

namespace airybench {
namespace {

constexpr const char* was_removed = ": was removed or replaced while the run wrote it";

}  // namespace

Journal::Journal(const std::filesystem::path& file, std::int64_t size) : file_(file), end_(size) {
  // O_NONBLOCK: do not block on a FIFO.
  descriptor_ = open(file.c_str(), O_RDWR | O_APPEND | O_CLOEXEC | O_NONBLOCK);
  if (descriptor_ < 0 && errno != ENOENT)
    throw FileError(fmt::format("{}: cannot be written: {}", file.string(), strerror(errno)));
  struct stat opened = {};
  if (fstat(descriptor_, &opened) == 0 && S_ISREG(opened.st_mode) && opened.st_size == size) return;
  if (descriptor_ >= 0) close(descriptor_);
  throw FileError(file.string() + was_removed);
}

Journal::~Journal() {
  if (is_open()) close(descriptor_);
}

Journal::Journal(Journal&& other) noexcept
    : file_(std::move(other.file_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      end_(other.end_) {}

Journal& Journal::operator=(Journal&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(end_, other.end_);
  return *this;
}

std::int64_t Journal::append(const std::string& line) {
  const std::int64_t begin = end_;
  if (!is_open_as(descriptor_, file_)) throw FileError(file_.string() + was_removed);
  if (lseek(descriptor_, 0, SEEK_END) != begin)
    throw FileError(file_.string() + ": was changed while the run wrote it");
  int error = write_all(descriptor_, line + "\n");
  if (error == 0 && fsync(descriptor_) != 0) error = errno;
  if (error == 0) {
    end_ += std::ssize(line) + 1;
    return begin;
  }
  // If truncation fails too, a torn line stays, which readers leave out.
  [[maybe_unused]] const int taken_back = ftruncate(descriptor_, begin);
  throw FileError(fmt::format("{}: cannot be written: {}", file_.string(), strerror(error)));
}

std::string Journal::text_of(const Line& line) const {
  std::string text(static_cast<std::size_t>(line.size), '\0');
  for (std::size_t got = 0; got < text.size();) {
    const ssize_t n = pread(descriptor_, text.data() + got, text.size() - got,
                            line.begin + static_cast<std::int64_t>(got));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0)
      throw FileError(fmt::format("{}: cannot be read: {}", file_.string(),
                                  n < 0 ? strerror(errno) : "it has become shorter"));
    got += static_cast<std::size_t>(n);
  }
  return text;
}

LineSplitter::LineSplitter(std::string file, Take take)
    : file_(std::move(file)), take_(std::move(take)) {}

void LineSplitter::add(std::string_view part) {
  constexpr std::int64_t most = 1'000'000;
  const auto refuse = [&](const char* what) {
    throw FileError(fmt::format("{}:{}: {}", file_, line_.number, what));
  };
  for (bool ends = true; ends && !part.empty();) {
    const std::size_t end = part.find('\n');
    ends = end != part.npos;
    text_ += part.substr(0, end);
    if (text_.size() > longest_line) refuse("a line longer than 16 MiB (allowed: up to 16 MiB)");
    if (line_.number > most) refuse("more than a million lines (allowed: up to a million)");
    if (!ends) return;
    part.remove_prefix(end + 1);
    line_.size = std::ssize(text_);
    take_(text_, line_);
    line_ = {line_.begin + line_.size + 1, 0, line_.number + 1};
    text_.clear();
  }
}

}  // namespace airybench
