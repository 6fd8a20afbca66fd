#include "support/file_text.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
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

}  // namespace

std::string file_text(const std::filesystem::path& file) {
  constexpr std::int64_t most = std::int64_t{1} << 30;
  const Descriptor in(file);
  if (in.number < 0) fail(file, "cannot be opened: " + std::generic_category().message(errno));
  struct stat opened = {};
  if (fstat(in.number, &opened) != 0 || !S_ISREG(opened.st_mode))
    fail(file, S_ISDIR(opened.st_mode) ? "a folder, not a file" : "is no regular file");
  if (opened.st_size > most) fail(file, "larger than 1 GiB");
  std::string text(static_cast<std::size_t>(opened.st_size), '\0');
  std::size_t size = 0;  // it may be changing
  while (size < text.size()) {
    const ssize_t n = read(in.number, text.data() + size, text.size() - size);
    if (n < 0 && errno != EINTR)
      fail(file, "cannot be read: " + std::generic_category().message(errno));
    if (n == 0) break;
    if (n > 0) size += static_cast<std::size_t>(n);
  }
  text.resize(size);
  return text;
}

}  // namespace airybench
