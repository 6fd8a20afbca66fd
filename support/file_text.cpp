#include "support/file_text.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <system_error>

#include "support/errors.hpp"

namespace airybench {
namespace {

[[noreturn]] void fail_to_read(const std::filesystem::path& file, const std::string& why) {
  throw FileError(file.string() + ": " + why);
}

std::string because_of(const char* what) {
  return what + (": " + std::generic_category().message(errno));
}

void read_file(const std::filesystem::path& file, const std::function<void(std::size_t)>& begin,
               const std::function<void(std::string_view)>& take) {
  constexpr std::int64_t most = std::int64_t{1} << 30;
  // Do not block on a FIFO.
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) fail_to_read(file, because_of("cannot be opened"));
  const struct Closer {
    int descriptor;
    ~Closer() { close(descriptor); }
  } closer{descriptor};
  struct stat opened = {};
  if (fstat(descriptor, &opened) != 0 || !S_ISREG(opened.st_mode))
    fail_to_read(file, S_ISDIR(opened.st_mode) ? "a folder, not a file" : "is no regular file");
  if (opened.st_size > most) fail_to_read(file, "larger than 1 GiB");
  begin(static_cast<std::size_t>(opened.st_size));
  std::array<char, 1 << 15> part;
  while (const ssize_t n = read(descriptor, part.data(), part.size())) {
    if (n > 0) take({part.data(), static_cast<std::size_t>(n)});
    if (n < 0 && errno != EINTR) fail_to_read(file, because_of("cannot be read"));
  }
}

}  // namespace

std::string file_text(const std::filesystem::path& file) {
  std::string text;
  read_file(
      file, [&](std::size_t size) { text.reserve(size); },
      [&](std::string_view part) { text += part; });
  return text;
}

void read_parts(const std::filesystem::path& file,
                const std::function<void(std::string_view part)>& take) {
  read_file(
      file, [](std::size_t) {}, take);
}

}  // namespace airybench
