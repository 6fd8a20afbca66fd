#include "support/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <random>
#include <string>
#include <system_error>

#include "support/errors.hpp"

namespace airybench {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, int error) {
  throw FileError(file.string() + ": cannot be written: " + std::generic_category().message(error));
}

// Where the links end, whether something is there or not.
fs::path end_of_links(const fs::path& file) {
  constexpr int most_links = 40;  // as the kernel
  fs::path target = file;
  std::error_code error;
  for (int links = 0; fs::is_symlink(target, error); ++links) {
    if (links == most_links) fail(file, ELOOP);
    target = target.parent_path() / fs::read_symlink(target, error);  // absolute: that alone
  }
  return target;
}

// Opens a file that nobody could have put there before.
int open_new(const fs::path& target, fs::path& beside) {
  for (;;) {
    beside = name_beside(target);
    const int descriptor = open(beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0 || errno != EEXIST) return descriptor;
  }
}

}  // namespace

fs::path name_beside(const fs::path& target) {
  std::random_device chance;
  fs::path beside = target;
  beside += ".part" + std::to_string(chance()) + std::to_string(chance());
  return beside;
}

int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = write(descriptor, bytes.data(), bytes.size());
    if (n >= 0)
      bytes.remove_prefix(static_cast<std::size_t>(n));
    else if (errno != EINTR)
      return errno;
  }
  return 0;
}

bool is_open_as(int descriptor, const fs::path& file) {
  struct stat opened = {}, named = {};
  return fstat(descriptor, &opened) == 0 && stat(file.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

void sync_folder(const fs::path& folder) {
  const int descriptor =
      open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

void write_file_atomically(const fs::path& file, std::string_view bytes) {
  const fs::path target = end_of_links(file);
  struct stat there = {};
  const bool exists = stat(target.c_str(), &there) == 0;
  if (exists && !S_ISREG(there.st_mode))
    throw FileError(file.string() +
                    ": is no regular file (allowed: one, or a name that is not there)");
  fs::path beside;
  const int descriptor = open_new(target, beside);
  if (descriptor < 0) fail(file, errno);
  int error = write_all(descriptor, bytes);
  if (error == 0 && exists && fchmod(descriptor, there.st_mode & 07777) != 0) error = errno;
  if (error == 0 && fsync(descriptor) != 0) error = errno;
  if (close(descriptor) != 0 && error == 0) error = errno;
  if (error == 0 && rename(beside.c_str(), target.c_str()) != 0) error = errno;
  if (error != 0) {
    unlink(beside.c_str());
    fail(file, error);
  }
  sync_folder(target.parent_path());
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw FileError(folder.string() + ": cannot be made a folder: " + error.message());
}

}  // namespace airybench
