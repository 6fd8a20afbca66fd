#include "bench/report/history.hpp"
#include "bench/report/judge.hpp"
#include "tests/fuzz/readers.hpp"

namespace airybench::fuzz {

void night(const std::string& text) {
  const Night night = parse_night(text, "fuzz.json");
  std::vector<Night> history = {night, night};
  judge_newest(history, TimeRules());
}

}  // namespace airybench::fuzz
