#include "bench/run/oom_kills.hpp"

#include <fstream>
#include <string>

namespace airybench {
namespace {

// The number behind a word at the start of a line.
std::optional<std::int64_t> number_of(const std::string& word, const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string name;
  for (std::int64_t number = 0; in >> name >> number;)
    if (name == word) return number;
  return {};
}

std::filesystem::path control_group(const std::filesystem::path& root) {
  std::ifstream in(root / "proc/self/cgroup");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("0::/")) return root / "sys/fs/cgroup" / line.substr(4);
  return {};
}

}  // namespace

std::optional<std::int64_t> oom_kills(const std::filesystem::path& root) {
  const auto of_group = number_of("oom_kill", control_group(root) / "memory.events");
  return of_group ? of_group : number_of("oom_kill", root / "proc/vmstat");
}

}  // namespace airybench
