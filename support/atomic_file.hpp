// Files and folders that are written whole or not at all, also after a power failure.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace airybench {

// Writes to a temporary file in the same folder, waits until it is on disk, renames. A link stays,
// and what it points to is replaced, with its permissions. Throws FileError "file: why", also where
// there is anything but a regular file; what was there is untouched then.
void write_file_atomically(const std::filesystem::path& file, std::string_view bytes);

using Files = std::map<std::string, std::string>;  // bytes by name

// The same of a folder with its files. Throws FileError "folder: why", also where there is anything
// but an empty folder; nothing is left then.
void write_folder_atomically(const std::filesystem::path& folder, const Files& files);
// Throws as the same would of a folder that is in the way: before the work for its files.
void check_is_free(const std::filesystem::path& folder);

// With all above it, unless it is there. Throws FileError.
void make_folder(const std::filesystem::path& folder);

// A new folder; removed with all in it when the object is.
class TemporaryFolder {
 public:
  TemporaryFolder();  // below $TMPDIR; throws FileError
  explicit TemporaryFolder(std::filesystem::path folder) : path_(std::move(folder)) {}
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// All bytes, however often the kernel takes only a part. 0, or errno.
int write_all(int descriptor, std::string_view bytes);
// Is what is open the file of that name, not one that was removed or replaced since?
bool is_open_as(int descriptor, const std::filesystem::path& file);
// Waits until names made or removed in the folder are on disk, where the file system can say so.
void sync_folder(const std::filesystem::path& folder);

}  // namespace airybench
