#include "support/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <random>
#include <system_error>

#include "support/errors.hpp"
#include "support/temporary_folder.hpp"

namespace airybench {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_to_write(const fs::path& file, int error) {
  throw FileError(file.string() + ": cannot be written: " + std::generic_category().message(error));
}

fs::path end_of_links(const fs::path& file) {
  constexpr int most_links = 40;  // the kernel's limit
  fs::path target = file;
  std::error_code error;
  for (int links = 0; fs::is_symlink(target, error); ++links) {
    if (links == most_links) fail_to_write(file, ELOOP);
    target = target.parent_path() / fs::read_symlink(target, error);  // absolute: it alone
  }
  return target;
}

// Creates a file or folder with a new random name, left in `made`. False: see errno.
template <typename Make>
bool make_beside(const fs::path& target, fs::path& made, const Make& make) {
  do {
    std::random_device random;
    made = target;
    made += ".part" + std::to_string(random()) + std::to_string(random());
    if (make(made.c_str())) return true;
  } while (errno == EEXIST);
  return false;
}

}  // namespace

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
  int descriptor = -1;
  const bool is_made = make_beside(target, beside, [&](const char* name) {
    descriptor = open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    return descriptor >= 0;
  });
  if (!is_made) fail_to_write(file, errno);
  int error = write_all(descriptor, bytes);
  if (error == 0 && exists && fchmod(descriptor, there.st_mode & 07777) != 0) error = errno;
  if (error == 0 && fsync(descriptor) != 0) error = errno;
  if (close(descriptor) != 0 && error == 0) error = errno;
  if (error == 0 && rename(beside.c_str(), target.c_str()) != 0) error = errno;
  if (error != 0) {
    unlink(beside.c_str());
    fail_to_write(file, error);
  }
  sync_folder(target.parent_path());
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw FileError(folder.string() + ": cannot be made a folder: " + error.message());
}

void check_is_free(const fs::path& folder) {
  std::error_code error;
  const fs::file_status there = fs::symlink_status(folder, error);
  if (!fs::exists(there)) return;
  if (!fs::is_directory(there) || !fs::is_empty(folder, error) || error)
    throw FileError(folder.string() +
                    ": is there already (allowed: an empty folder, or a name that is not there)");
}

void write_folder_atomically(const fs::path& asked, const Files& files) {
  const fs::path folder =
      asked.has_filename() ? asked : asked.parent_path();  // without a slash at the end
  check_is_free(folder);
  if (folder.has_parent_path()) make_folder(folder.parent_path());
  fs::path made;
  if (!make_beside(folder, made, [](const char* name) { return mkdir(name, 0777) == 0; }))
    fail_to_write(folder, errno);
  const TemporaryFolder beside(made);
  for (const auto& [name, bytes] : files) write_file_atomically(made / name, bytes);
  if (rename(made.c_str(), folder.c_str()) != 0)  // replaces an empty folder
    fail_to_write(folder, errno);
  sync_folder(folder.parent_path());
}

}  // namespace airybench
