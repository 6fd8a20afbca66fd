// What makes the figures of a run less certain than they look, said when it ends.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace airybench {

// What cannot be known is empty and gives no warning.
struct MachineState {
  std::string governor;        // of the CPU's frequency: "performance", "powersave"
  std::optional<double> load;  // processes that ran or wanted to, mean of the last minute
  int cpus = 0, threads = 1;
  int repetitions = 0;
  std::optional<double> noise;  // median absolute deviation over median of the noise kernel
  bool heap_probe = false;
  std::string build_type;
  bool dirty = false;  // uncommitted changes to tracked files
};

// From the keys of describe_environment() (environment.hpp), "unknown" being empty.
MachineState machine_state(const std::map<std::string, std::string>& environment, int repetitions,
                           std::optional<double> noise);

// One line each, none for a machine and a run that are as they should be.
std::vector<std::string> machine_warnings(const MachineState& state);

}  // namespace airybench
