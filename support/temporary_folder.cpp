#include "support/temporary_folder.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>

#include "support/atomic_file.hpp"
#include "support/errors.hpp"

namespace airybench {
namespace {

namespace fs = std::filesystem;

// With the machine's name: a lock may be unknown to others that see the folder.
const std::string& prefix() {
  static const std::string of_machine = [] {
    std::array<char, 65> host{};
    if (gethostname(host.data(), host.size() - 1) != 0) host[0] = '\0';
    return "airybench-scratch-" + std::string(host.data()) + "-";
  }();
  return of_machine;
}

fs::path parent_of_all() {
  const char* given = std::getenv("TMPDIR");
  return fs::absolute(given == nullptr || *given == '\0' ? "/tmp" : given);
}

// -1: it is no folder, or somebody else's.
int open_folder(int parent, const char* name) {
  return openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

int open_to_remove(int parent, const char* name) {
  fchmodat(parent, name, S_IRWXU, AT_SYMLINK_NOFOLLOW);
  return open_folder(parent, name);
}

bool lock(int folder) { return flock(folder, LOCK_EX | LOCK_NB) == 0; }

bool remove_entry(int folder, const char* name) {
  return unlinkat(folder, name, 0) == 0 || unlinkat(folder, name, AT_REMOVEDIR) == 0;
}

template <typename Visit>
void for_each_entry(int folder, const Visit& visit) {
  DIR* const entries = fdopendir(openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (entries == nullptr) return;
  while (const dirent* entry = readdir(entries))
    if (const std::string name = entry->d_name; name != "." && name != "..") visit(name.c_str());
  closedir(entries);
}

// What is in a folder of `top` and cannot be removed yet moves to `top`: the depth of folders takes
// neither stack nor descriptors nor long paths.
void remove_folder(int parent, const char* folder) {
  const int top = open_to_remove(parent, folder);
  int moved = 0;
  for (bool removes = top >= 0; removes;) {
    removes = false;
    for_each_entry(top, [&](const char* name) {
      if (!remove_entry(top, name)) {
        const int inner = open_to_remove(top, name);
        if (inner < 0) return;
        for_each_entry(inner, [&](const char* entry) {
          if (remove_entry(inner, entry)) return;
          fchmodat(inner, entry, S_IRWXU, AT_SYMLINK_NOFOLLOW);  // or it cannot be moved
          renameat(inner, entry, top, (prefix() + std::to_string(++moved)).c_str());
        });
        close(inner);
        if (!remove_entry(top, name)) return;
      }
      removes = true;
    });
  }
  if (top >= 0) close(top);
  remove_entry(parent, folder);
}

}  // namespace

void remove_folder(const fs::path& folder) { remove_folder(AT_FDCWD, folder.c_str()); }

void remove_abandoned_folders() {
  const int parent = open(parent_of_all().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  for_each_entry(parent, [&](const char* name) {
    struct stat found = {};
    if (!std::string_view(name).starts_with(prefix()) ||
        fstatat(parent, name, &found, AT_SYMLINK_NOFOLLOW) != 0 || found.st_uid != geteuid())
      return;
    int folder = open_folder(parent, name);  // which may be in use: its permissions stay
    if (folder < 0 && errno == EACCES) folder = open_to_remove(parent, name);
    if (folder < 0) return;
    if (lock(folder)) remove_folder(parent, name);
    close(folder);
  });
  if (parent >= 0) close(parent);
}

TemporaryFolder::TemporaryFolder() {
  const fs::path parent = parent_of_all();
  const auto fail = [&] {
    throw FileError("TMPDIR: " + parent.string() +
                    ": no folder can be made there: " + std::generic_category().message(errno));
  };
  for (;;) {
    std::string name = (parent / (prefix() + "XXXXXX")).string();
    if (mkdtemp(name.data()) == nullptr) fail();
    path_ = name;
    lock_ = open(name.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock_ < 0 && errno == ENOENT) continue;  // another run has removed it
    if (lock_ < 0) {
      const int why = errno;
      rmdir(name.c_str());
      errno = why;
      fail();
    }
    // Without locks (some network file systems) nobody takes it for abandoned.
    const bool is_ours = lock(lock_) || errno != EWOULDBLOCK;
    if (is_ours && is_open_as(lock_, path_)) return;
    close(lock_);  // another run is removing it
  }
}

TemporaryFolder::~TemporaryFolder() {
  remove_folder(path_);
  if (lock_ >= 0) close(lock_);
}

}  // namespace airybench
