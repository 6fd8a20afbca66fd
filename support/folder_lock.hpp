// One writer per folder.
#pragma once

#include <filesystem>

namespace airybench {

// Locks the folder until the object or the process ends, even by a crash: flock() on the folder
// itself, which leaves no file and needs only the right to read the folder. A network file system
// may keep such a lock within one machine. A second one of a folder in a process is part of the
// first, which must outlive it.
class FolderLock {
 public:
  // Throws FileError if another process has the lock (it is named where the kernel lists it), or if
  // the folder is unusable.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;  // -1: part of another
};

}  // namespace airybench
