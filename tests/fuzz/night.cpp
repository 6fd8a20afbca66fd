#include "bench/report/history.hpp"
#include "bench/report/track.hpp"
#include "tests/fuzz/readers.hpp"

namespace airybench::fuzz {

void night(const std::string& text) {
  const TrackedRun run = parse_tracked_run(text, "fuzz.json");
  std::vector<TrackedRun> history = {run, run};
  track_newest(history, TimeRules());
}

}  // namespace airybench::fuzz
