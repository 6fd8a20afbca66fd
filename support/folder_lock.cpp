#include "support/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "support/atomic_file.hpp"
#include "support/errors.hpp"

namespace airybench {
namespace {

std::string this_process() {
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  return fmt::format("process {} on {}", getpid(), host.data());
}

// The holder may not have written its name yet.
std::string holder(int descriptor) {
  std::array<char, 300> text;
  const ssize_t n = pread(descriptor, text.data(), text.size(), 0);
  return n > 0 ? std::string(text.data(), static_cast<std::size_t>(n)) : "another process";
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder) : file_(folder / ".lock") {
  const std::string own_name = this_process();  // an exception later would leave the file
  for (;;) {
    descriptor_ = open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
    struct flock whole = {};
    whole.l_type = F_WRLCK;
    whole.l_whence = SEEK_SET;
    if (descriptor_ < 0 || fcntl(descriptor_, F_SETLK, &whole) != 0) {
      const int error = errno;
      const bool is_held = descriptor_ >= 0 && (error == EACCES || error == EAGAIN);
      const std::string why = is_held
                                  ? "in use by " + holder(descriptor_)
                                  : "cannot be locked: " + std::generic_category().message(error);
      if (descriptor_ >= 0) close(descriptor_);
      throw FileError(fmt::format("{}: {}", folder.string(), why));
    }
    if (is_open_as(descriptor_, file_)) break;
    close(descriptor_);  // the holder removed the file in between
  }
  // The name is for error messages; the lock holds without it.
  if (ftruncate(descriptor_, 0) == 0) static_cast<void>(write_all(descriptor_, own_name));
}

FolderLock::~FolderLock() {
  if (is_open_as(descriptor_, file_)) unlink(file_.c_str());
  close(descriptor_);
}

}  // namespace airybench
