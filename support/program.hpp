// Other programs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace airybench {

struct ProgramEnd {
  int exit_code = -1;  // of one that ended by itself
  int signal = 0;      // that ended it
  bool timed_out = false;
  std::string out, err;
};

// Runs it to its end, or to that of the time limit, with no standard input; it ends when this
// process does, however that ends. What it starts itself is its own affair, and may not outlive it.
// Throws std::system_error: no process, or no pipe.
ProgramEnd run_program(const std::filesystem::path& program,
                       const std::vector<std::string>& arguments, double time_limit_s);

// A program of this project: "airybench-name" beside the running one where both are installed, in a
// folder of its name beside that of the running one in the build tree. Empty: it is not there.
std::optional<std::filesystem::path> program_of_ours(const std::string& name);

}  // namespace airybench
