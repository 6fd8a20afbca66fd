# Writes build_info.cpp at every build; it changes only when its content does.
# Sources that were unpacked inside another repository are none of it.
execute_process(COMMAND git -C "${SOURCE_DIR}" ls-files --error-unmatch CMakeLists.txt
                OUTPUT_QUIET ERROR_QUIET RESULT_VARIABLE not_tracked)
execute_process(COMMAND git -C "${SOURCE_DIR}" rev-parse HEAD
                OUTPUT_VARIABLE revision OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET
                RESULT_VARIABLE no_git)
if(not_tracked OR no_git)
  set(revision "unknown")
  set(dirty "unknown")
else()
  execute_process(COMMAND git -C "${SOURCE_DIR}" status --porcelain --untracked-files=no
                  OUTPUT_VARIABLE changes OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(changes)
    set(dirty "yes")
  else()
    set(dirty "no")
  endif()
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" @ONLY CONTENT [[// Made by cmake/build_info.cmake.
#include "bench/measure/build_info.hpp"

namespace airybench {

const BuildInfo build_info = {
    .version = "@VERSION@",
    .git_revision = "@revision@",
    .git_dirty = "@dirty@",
    .build_type = "@BUILD_TYPE@",
    .compiler = "@COMPILER@",
    .compiler_flags = "@FLAGS@",
    .benchmark_version = "@BENCHMARK_VERSION@",
};

}  // namespace airybench
]])
