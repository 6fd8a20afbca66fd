#include "support/atomic_folder.hpp"

#include <system_error>

#include "support/atomic_file.hpp"
#include "support/errors.hpp"

namespace airybench {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& folder, const std::error_code& error) {
  throw FileError(folder.string() + ": cannot be written: " + error.message());
}

// Gone with what is in it, unless it has been renamed.
class FolderInTheMaking {
 public:
  explicit FolderInTheMaking(const fs::path& folder) {
    std::error_code error;
    do path_ = name_beside(folder);
    while (!fs::create_directory(path_, error) && !error);
    if (error) fail(folder, error);
  }
  ~FolderInTheMaking() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  FolderInTheMaking(const FolderInTheMaking&) = delete;
  FolderInTheMaking& operator=(const FolderInTheMaking&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

fs::path without_slash_at_end(const fs::path& folder) {
  return folder.has_filename() ? folder : folder.parent_path();
}

}  // namespace

void check_is_free(const fs::path& folder) {
  std::error_code error;
  const fs::file_status there = fs::symlink_status(folder, error);
  if (!fs::exists(there)) return;
  if (!fs::is_directory(there) || !fs::is_empty(folder, error) || error)
    throw FileError(folder.string() +
                    ": is there already (allowed: an empty folder, or a name that is not there)");
}

void write_folder_atomically(const fs::path& asked, const Files& files) {
  const fs::path folder = without_slash_at_end(asked);
  check_is_free(folder);
  if (folder.has_parent_path()) make_folder(folder.parent_path());
  const FolderInTheMaking beside(folder);
  for (const auto& [name, bytes] : files) write_file_atomically(beside.path() / name, bytes);
  std::error_code error;
  fs::rename(beside.path(), folder, error);  // takes the place of an empty one
  if (error) fail(folder, error);
  sync_folder(folder.parent_path());
}

}  // namespace airybench
