#include "meshgen/confinement.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>

namespace airybench {

#if defined(__x86_64__)
constexpr unsigned architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr unsigned architecture = AUDIT_ARCH_AARCH64;
#else
constexpr unsigned architecture = 0;
#endif

bool start_no_programs() {
  if (architecture == 0) return false;
  constexpr unsigned load = BPF_LD | BPF_W | BPF_ABS, jump = BPF_JMP | BPF_JEQ | BPF_K,
                     end = BPF_RET | BPF_K;
  // Jumps count the instructions that are passed over: if equal, if not.
  constexpr unsigned other_calls = 0x40000000;  // of x32
  std::array<sock_filter, 8> program = {{
      {load, 0, 0, offsetof(seccomp_data, arch)},
      {jump, 0, 5, architecture},
      {load, 0, 0, offsetof(seccomp_data, nr)},
      {BPF_JMP | BPF_JGE | BPF_K, 3, 0, other_calls},
      {jump, 2, 0, SYS_execve},
      {jump, 1, 0, SYS_execveat},
      {end, 0, 0, SECCOMP_RET_ALLOW},
      {end, 0, 0, SECCOMP_RET_KILL_PROCESS},
  }};
  const sock_fprog filter = {program.size(), program.data()};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0;
}

namespace {

bool writes_nowhere = false;

// A rule of rights beneath a path.
bool allow(int rules, const char* path, std::uint64_t rights) {
  const int opened = open(path, O_PATH | O_CLOEXEC);
  if (opened < 0) return false;
  const landlock_path_beneath_attr beneath = {rights, opened};
  const bool is_added =
      syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &beneath, 0) == 0;
  close(opened);
  return is_added;
}

}  // namespace

bool write_only_in(const std::filesystem::path& folder) {
  const long version =
      syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  if (version < 1) return false;
  constexpr std::uint64_t refer = 1U << 13, truncate = 1U << 14;  // since versions 2 and 3
  const std::uint64_t of_file = LANDLOCK_ACCESS_FS_WRITE_FILE | (version >= 3 ? truncate : 0);
  const std::uint64_t all =
      of_file | LANDLOCK_ACCESS_FS_REMOVE_DIR | LANDLOCK_ACCESS_FS_REMOVE_FILE |
      LANDLOCK_ACCESS_FS_MAKE_CHAR | LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_REG |
      LANDLOCK_ACCESS_FS_MAKE_SOCK | LANDLOCK_ACCESS_FS_MAKE_FIFO | LANDLOCK_ACCESS_FS_MAKE_BLOCK |
      LANDLOCK_ACCESS_FS_MAKE_SYM | (version >= 2 ? refer : 0);
  landlock_ruleset_attr handled = {};  // newer headers have more members
  handled.handled_access_fs = all;
  const int rules = static_cast<int>(
      syscall(SYS_landlock_create_ruleset, &handled, sizeof handled.handled_access_fs, 0));
  if (rules < 0) return false;
  const bool is_confined = allow(rules, folder.c_str(), all) &&
                           allow(rules, "/dev/null", of_file) &&
                           prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
                           syscall(SYS_landlock_restrict_self, rules, 0) == 0;
  close(rules);
  writes_nowhere = is_confined;
  return is_confined;
}

// Gmsh gives up where it cannot open a file for writing. Of what it may not write nothing stays.
FILE* open_or_discard(FILE* (*real)(const char*, const char*), const char* name, const char* mode) {
  FILE* const opened = real(name, mode);
  const bool is_refused = opened == nullptr && (errno == EACCES || errno == EPERM);
  return is_refused && writes_nowhere && std::strpbrk(mode, "wa") != nullptr
             ? real("/dev/null", mode)
             : opened;
}

}  // namespace airybench

// In place of the C library's, for Gmsh, too.
extern "C" {
FILE* fopen(const char* name, const char* mode) {
  static const auto real =
      reinterpret_cast<FILE* (*)(const char*, const char*)>(dlsym(RTLD_NEXT, "fopen"));
  return airybench::open_or_discard(real, name, mode);
}
FILE* fopen64(const char* name, const char* mode) {
  static const auto real =
      reinterpret_cast<FILE* (*)(const char*, const char*)>(dlsym(RTLD_NEXT, "fopen64"));
  return airybench::open_or_discard(real, name, mode);
}
}
