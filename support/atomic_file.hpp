// Writes files and folders completely or not at all, even after a power failure.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace airybench {

// Throws FileError "file: why" if the file cannot be written: it is not a regular file, or file or
// folder are read-only for this user. Follows links.
void check_can_write(const std::filesystem::path& file);

// The new content of a file, next to it under a temporary name. Until take_place() succeeds, the
// old file is untouched. Follows links and keeps the permissions of the file that it replaces. All
// throw FileError "file: why", the constructor as check_can_write().
class NewFile {
 public:
  explicit NewFile(const std::filesystem::path& file);
  ~NewFile();  // removes it unless it has taken its place
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  void write(std::string_view bytes);
  void complete();    // returns when it is on disk
  void take_place();  // after complete()

 private:
  std::filesystem::path file_, target_, beside_;
  int descriptor_ = -1;
};

void write_file_atomically(const std::filesystem::path& file, std::string_view bytes);

// Removes the temporary files that killed processes left in this folder. The caller holds its lock.
void remove_leftovers(const std::filesystem::path& folder);

using Files = std::map<std::string, std::string>;  // bytes by name

// Throws FileError "folder: why", also for anything but an empty folder; leaves nothing then.
void write_folder_atomically(const std::filesystem::path& folder, const Files& files);
// Throws FileError as write_folder_atomically() would, before the work for its files.
void check_is_free(const std::filesystem::path& folder);

// Also makes its parents. Throws FileError.
void make_folder(const std::filesystem::path& folder);

// Continues after partial writes. Returns 0 or errno.
int write_all(int descriptor, std::string_view bytes);
// False if the file of that name was removed or replaced since it was opened.
bool is_open_as(int descriptor, const std::filesystem::path& file);
// Waits until names made or removed in the folder are on disk, where the file system supports it.
void sync_folder(const std::filesystem::path& folder);

}  // namespace airybench
