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

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& why) {
  throw FileError(file.string() + ": " + why);
}

class Descriptor {
 public:
  // Does not wait for who might write into a pipe.
  explicit Descriptor(const std::filesystem::path& file)
      : number(open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
  ~Descriptor() {
    if (number >= 0) close(number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  const int number;
};

// Of what is a regular file, and not too large.
std::size_t checked_size(const Descriptor& in, const std::filesystem::path& file) {
  constexpr std::int64_t most = std::int64_t{1} << 30;
  if (in.number < 0) fail(file, "cannot be opened: " + std::generic_category().message(errno));
  struct stat opened = {};
  if (fstat(in.number, &opened) != 0 || !S_ISREG(opened.st_mode))
    fail(file, S_ISDIR(opened.st_mode) ? "a folder, not a file" : "is no regular file");
  if (opened.st_size > most) fail(file, "larger than 1 GiB");
  return static_cast<std::size_t>(opened.st_size);
}

// As much as one call gives; 0: the end.
std::size_t read_some(const Descriptor& in, const std::filesystem::path& file, char* to,
                      std::size_t most) {
  for (;;) {
    const ssize_t n = read(in.number, to, most);
    if (n >= 0) return static_cast<std::size_t>(n);
    if (errno != EINTR) fail(file, "cannot be read: " + std::generic_category().message(errno));
  }
}

}  // namespace

std::string file_text(const std::filesystem::path& file) {
  const Descriptor in(file);
  std::string text(checked_size(in, file), '\0');
  std::size_t size = 0;  // it may be changing
  while (size < text.size()) {
    const std::size_t n = read_some(in, file, text.data() + size, text.size() - size);
    if (n == 0) break;
    size += n;
  }
  text.resize(size);
  return text;
}

void read_parts(const std::filesystem::path& file,
                const std::function<void(std::string_view part)>& take) {
  const Descriptor in(file);
  checked_size(in, file);
  std::array<char, 1 << 15> part;
  while (const std::size_t n = read_some(in, file, part.data(), part.size()))
    take({part.data(), n});
}

}  // namespace airybench
