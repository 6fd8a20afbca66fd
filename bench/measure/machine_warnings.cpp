#include "bench/measure/machine_warnings.hpp"

#include <fmt/format.h>

#include "support/numbers.hpp"

namespace airybench {
namespace {

constexpr double most_load_per_cpu = 0.2;
constexpr double most_noise = 0.05;
constexpr int fewest_repetitions =
    5;  // two samples of five differ at p < 0.01, of four they cannot

}  // namespace

MachineState machine_state(const std::map<std::string, std::string>& environment, int repetitions,
                           std::optional<double> noise) {
  const auto known = [&](const char* key) {
    const auto found = environment.find(key);
    return found == environment.end() || found->second == "unknown" ? "" : found->second;
  };
  MachineState state;
  state.governor = known("cpu_governor");
  const std::optional<double> load = parse_number(known("load_1min_at_start"));
  if (load && *load >= 0) state.load = *load;
  state.cpus = static_cast<int>(parse_whole(known("cpus")).value_or(0));
  state.threads = static_cast<int>(parse_whole(known("threads")).value_or(1));
  state.repetitions = repetitions;
  state.noise = noise;
  state.heap_probe = known("heap_probe") == "on";
  state.build_type = known("build_type");
  state.dirty = known("git_dirty") == "yes";
  return state;
}

std::vector<std::string> machine_warnings(const MachineState& s) {
  std::vector<std::string> lines;
  if (!s.governor.empty() && s.governor != "performance")
    lines.push_back(fmt::format(
        "the CPU's frequency follows its load (governor {}, steady with performance)", s.governor));
  if (s.load && s.cpus > 0 && *s.load > most_load_per_cpu * s.cpus)
    lines.push_back(
        fmt::format("other work on the machine: load {:.2f} on {} CPUs (quiet: at most {:.1f})",
                    *s.load, s.cpus, most_load_per_cpu * s.cpus));
  if (s.cpus > 0 && s.threads > s.cpus)
    lines.push_back(fmt::format("--threads={}: more than the {} CPUs: they wait for one another",
                                s.threads, s.cpus));
  if (s.noise && *s.noise > most_noise)
    lines.push_back(
        fmt::format("times scatter by {:.1f} % in a loop that is always the same (quiet: at most "
                    "{:.0f} %)",
                    100 * *s.noise, 100 * most_noise));
  if (s.repetitions < fewest_repetitions)
    lines.push_back(fmt::format(
        "--repetitions={}: too few for a sound interval, and for two methods to differ at "
        "p < 0.01 (both from {} on)",
        s.repetitions, fewest_repetitions));
  if (!s.heap_probe) lines.push_back("the heap is not counted: this build has no heap probe");
  if (!s.build_type.empty() && s.build_type != "Release")
    lines.push_back(fmt::format("build type {}: times are those of Release only", s.build_type));
  if (s.dirty) lines.push_back("the sources have changes that are in no git revision");
  return lines;
}

}  // namespace airybench
