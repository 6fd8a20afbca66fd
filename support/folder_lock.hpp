// One writer per folder.
#pragma once

#include <filesystem>

namespace airybench {

// Locks the folder until the object or the process ends, even by a crash: a POSIX record lock on
// the file .lock, which works over NFS and is not inherited. At most one per folder and process.
class FolderLock {
 public:
  // Throws FileError if another process has the lock (it is named), or if the folder is unusable.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_;
};

}  // namespace airybench
