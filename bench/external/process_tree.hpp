// Another's program, with all that it starts: run, watched, and ended together.
//
// Between this process and the program stands a guardian, a fork: it adopts what the program leaves
// behind (PR_SET_CHILD_SUBREAPER), looks at the tree every one to ten milliseconds, and kills all
// of it when a limit is passed, when the program ends, or when this process does, however that
// ends.
//
// Memory is the sum of the resident peaks (VmHWM) of the processes that are alive at once, its
// largest value at any look: of one process its own peak, but for what it added since the last
// look; of several no less than what they had together. 0: it was too short to be seen.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace airybench {

struct ProcessLimits {
  double time_s = 0;
  std::optional<std::int64_t> memory_bytes = {};
  // Of each file that it writes, what it prints included (RLIMIT_FSIZE): SIGXFSZ ends who goes on.
  std::int64_t file_bytes = std::int64_t{4} << 30;
};

struct ProcessTreeEnd {
  int exit_code = -1;                           // of a program that ended by itself
  int signal = 0;                               // that ended it
  int start_error = 0;                          // errno: it could not be started
  bool timed_out = false, over_memory = false;  // it was ended for that
  double wall_s = 0;
  std::int64_t peak_bytes = 0;
};

struct Program {
  std::vector<std::string> command;  // its file, or a name to look for in PATH; arguments
  std::filesystem::path folder;      // that it runs in
  std::map<std::string, std::string> environment = {};  // besides ours
  std::filesystem::path output;                         // file for what it prints
  std::filesystem::path scratch = {};  // gone with this process, should it end first
};

// Throws std::system_error: no process, or no pipe; std::runtime_error: no guardian any more.
ProcessTreeEnd run_process_tree(const Program& program, const ProcessLimits& limits);

}  // namespace airybench
