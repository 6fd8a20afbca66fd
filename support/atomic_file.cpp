#include "support/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <random>
#include <system_error>
#include <utility>

#include "support/errors.hpp"
#include "support/temporary_folder.hpp"

namespace airybench {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view part_mark = ".part";
constexpr std::size_t part_digits = 20;

[[noreturn]] void fail_to_write(const fs::path& file, int error) {
  throw FileError(file.string() + ": cannot be written: " + std::generic_category().message(error));
}

fs::path end_of_links(const fs::path& file) {
  constexpr int max_links = 40;  // the kernel's limit
  fs::path target = file;
  std::error_code error;
  for (int links = 0; fs::is_symlink(target, error); ++links) {
    if (links == max_links) fail_to_write(file, ELOOP);
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
    made += fmt::format("{}{:010}{:010}", part_mark, random(), random());
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

void check_can_write(const fs::path& file) {
  const fs::path target = end_of_links(file), folder = target.parent_path();
  struct stat there = {};
  const bool exists = stat(target.c_str(), &there) == 0;
  if (!exists && errno != ENOENT) fail_to_write(file, errno);
  if (exists && !S_ISREG(there.st_mode))
    throw FileError(file.string() +
                    ": is no regular file (allowed: one, or a name that is not there)");
  const auto check = [&](const char* name, int how) {
    if (faccessat(AT_FDCWD, name, how, AT_EACCESS) != 0) fail_to_write(file, errno);
  };
  if (exists) check(target.c_str(), W_OK);
  check(folder.empty() ? "." : folder.c_str(), W_OK | X_OK);
}

NewFile::NewFile(const fs::path& file) : file_(file), target_(end_of_links(file)) {
  check_can_write(file);
  const bool is_made = make_beside(target_, beside_, [&](const char* name) {
    descriptor_ = open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    return descriptor_ >= 0;
  });
  if (!is_made) fail_to_write(file, errno);
}

NewFile::~NewFile() {
  if (descriptor_ >= 0) close(descriptor_);
  if (!beside_.empty()) unlink(beside_.c_str());
}

void NewFile::write(std::string_view bytes) {
  if (const int error = write_all(descriptor_, bytes); error != 0) fail_to_write(file_, error);
}

void NewFile::complete() {
  struct stat there = {};
  const bool exists = stat(target_.c_str(), &there) == 0;
  if ((exists && fchmod(descriptor_, there.st_mode & 07777) != 0) || fsync(descriptor_) != 0 ||
      close(std::exchange(descriptor_, -1)) != 0)
    fail_to_write(file_, errno);
}

void NewFile::take_place() {
  if (rename(beside_.c_str(), target_.c_str()) != 0) fail_to_write(file_, errno);
  beside_.clear();
  sync_folder(target_.parent_path());
}

void write_file_atomically(const fs::path& file, std::string_view bytes) {
  NewFile next(file);
  next.write(bytes);
  next.complete();
  next.take_place();
}

void remove_leftovers(const fs::path& folder) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    const std::size_t mark = name.rfind(part_mark);
    if (mark == name.npos || !entry.is_regular_file(error) || entry.is_symlink(error)) continue;
    const std::string number = name.substr(mark + part_mark.size());
    if (number.size() == part_digits && number.find_first_not_of("0123456789") == number.npos)
      fs::remove(entry.path(), error);
  }
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
