// How this program was built; cmake/build_info.cmake writes the values at every build.
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
