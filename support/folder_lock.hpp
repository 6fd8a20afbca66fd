// One writer a folder.
#pragma once

#include <filesystem>

namespace airybench {

// Holds the folder until the object or the process ends, however that ends: the kernel keeps the
// lock (a POSIX record lock on the file .lock, which works over NFS and which children do not
// inherit). One lock a folder in a process.
class FolderLock {
 public:
  // Throws FileError: another process holds it, with that process's number and machine; or the
  // folder is not there or cannot be written.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_;
};

}  // namespace airybench
