// What this program was made from and how; written by cmake/build_info.cmake at every build.
#pragma once

namespace airybench {

struct BuildInfo {
  const char* version;
  const char* git_revision;
  const char* git_dirty;  // "yes", "no", "unknown"
  const char* build_type;
  const char* compiler;
  const char* compiler_flags;
  const char* benchmark_version;
};
extern const BuildInfo build_info;

}  // namespace airybench
