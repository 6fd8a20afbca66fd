# Writes bench/build_info.hpp at every build; it changes only when its content does.
execute_process(COMMAND git -C "${SOURCE_DIR}" rev-parse HEAD
                OUTPUT_VARIABLE revision OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET
                RESULT_VARIABLE no_git)
if(no_git)
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
#pragma once

namespace airybench::build_info {

inline constexpr const char* git_revision = "@revision@";
inline constexpr const char* git_dirty = "@dirty@";
inline constexpr const char* build_type = "@BUILD_TYPE@";
inline constexpr const char* compiler = "@COMPILER@";
inline constexpr const char* compiler_flags = "@FLAGS@";
inline constexpr const char* benchmark_version = "@BENCHMARK_VERSION@";

}  // namespace airybench::build_info
]])
