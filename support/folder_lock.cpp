#include "support/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <pthread.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <system_error>
#include <vector>

#include "support/errors.hpp"

namespace airybench {
namespace {

struct Held {
  int descriptor;
  dev_t device;
  ino_t inode;
};
std::vector<Held> held;

// A child would hold the lock beyond its parent's end.
void close_in_children() {
  static const int once = pthread_atfork(nullptr, nullptr, [] {
    for (const Held& one : held) close(one.descriptor);
    held.clear();
  });
  static_cast<void>(once);
}

// A line of /proc/locks: "1: FLOCK  ADVISORY  WRITE 4711 fe:01:1234 0 EOF".
std::string holder(int descriptor) {
  struct stat folder = {};
  fstat(descriptor, &folder);
  const std::string inode =
      fmt::format("{:02x}:{:02x}:{}", major(folder.st_dev), minor(folder.st_dev), folder.st_ino);
  std::ifstream locks("/proc/locks");
  std::string number, kind, how, access, process, file, rest;
  while (locks >> number >> kind >> how >> access >> process >> file && std::getline(locks, rest))
    if (kind == "FLOCK" && file == inode) return "process " + process;
  return "another process";
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder) {
  close_in_children();
  held.reserve(held.size() + 1);
  descriptor_ = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  struct stat there = {};
  if (descriptor_ >= 0) fstat(descriptor_, &there);
  const auto is_the_same = [&](const Held& one) {
    return one.device == there.st_dev && one.inode == there.st_ino;
  };
  if (descriptor_ >= 0 && std::ranges::any_of(held, is_the_same)) {
    close(descriptor_);
    descriptor_ = -1;
    return;
  }
  if (descriptor_ < 0 || flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    const int error = errno;
    const std::string why = descriptor_ >= 0 && error == EWOULDBLOCK
                                ? "in use by " + holder(descriptor_)
                                : "cannot be locked: " + std::generic_category().message(error);
    if (descriptor_ >= 0) close(descriptor_);
    throw FileError(fmt::format("{}: {}", folder.string(), why));
  }
  held.push_back({descriptor_, there.st_dev, there.st_ino});
}

FolderLock::~FolderLock() {
  if (descriptor_ < 0) return;
  std::erase_if(held, [&](const Held& one) { return one.descriptor == descriptor_; });
  close(descriptor_);
}

}  // namespace airybench
