// Folders below $TMPDIR, or /tmp. A process that is killed leaves its folder behind, and the next
// run removes it: every folder is locked while a process that may use it lives.
#pragma once

#include <filesystem>

namespace airybench {

// The destructor removes the folder with all its content.
class TemporaryFolder {
 public:
  TemporaryFolder();  // new; throws FileError
  explicit TemporaryFolder(std::filesystem::path folder) : path_(std::move(folder)) {}
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int lock_ = -1;  // an open folder; forks share it, other programs do not
};

// Follows no links. Removes whatever the permissions of our folders are, at any depth.
void remove_folder(const std::filesystem::path& folder);

// Of processes that were killed. Leaves alone those in use and those of other users.
void remove_abandoned_folders();

}  // namespace airybench
