// The command line of `bench`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace airybench {

struct Options {
  std::string meshes = "Mesh0..Mesh3";
  std::string methods;                        // empty: all the paper's
  std::vector<std::filesystem::path> scenes;  // empty: the default scene
  std::filesystem::path out = "results/latest";
  double target_error = 1e-6;
  int repetitions = 5;
  int threads = 1;
  double timeout_s = 900;                          // per solve
  std::optional<std::int64_t> memory_limit_bytes;  // of heap per solve, blocks included
  bool fields = false;                             // write stresses and contact points
  bool histories = false;                          // keep iteration histories in records.jsonl
  bool list = false, dry_run = false, explain = false;
  std::vector<std::string> benchmark_arguments;  // what came after "--"
};

// Wrong usage: what() is one line that names the argument and what is valid. Exit code 2.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};
// Asked for help or version: what() is the text. Exit code 0.
struct HelpRequested : std::runtime_error {
  using std::runtime_error::runtime_error;
};

Options parse_options(int argc, const char* const* argv);

}  // namespace airybench
