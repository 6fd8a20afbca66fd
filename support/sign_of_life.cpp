#include "support/sign_of_life.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string_view>
#include <system_error>
#include <thread>

#include "support/numbers.hpp"
#include "support/seconds_since.hpp"
#include "support/text_table.hpp"

namespace airybench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::string_view start_of_sign = "... ";

double max_silent_s() {
  constexpr double preset_s = 10, min_s = 0.01;
  const char* const given = std::getenv("AIRYBENCH_SILENT_S");
  const std::optional<double> seconds = parse_number(given != nullptr ? given : "");
  return std::max(seconds.value_or(preset_s), min_s);
}

auto& last() {
  static Clock::time_point heard = Clock::now();
  return heard;
}

void print(const std::string& line) { std::cerr << line + "\n" << std::flush; }

}  // namespace

void sign_of_life(const std::function<std::string()>& what) {
  if (seconds_since(last()) < max_silent_s()) return;
  print(what());
  was_heard();
}

void was_heard() { last() = Clock::now(); }

SignsOfLife::SignsOfLife(const std::string& what) {
  const auto tell = [&](Channel&) {
    const Clock::time_point start = Clock::now();
    for (;;) {
      std::this_thread::sleep_for(std::chrono::duration<double>(max_silent_s()));
      print(fmt::format("{}{}, for {}", start_of_sign, what, show_duration(seconds_since(start))));
    }
  };
  try {
    process_.emplace(tell);
  } catch (const std::system_error&) {  // what needs a process itself reports that there is none
  }
}

std::string without_signs_of_life(const std::string& printed) {
  std::istringstream lines(printed);
  std::string kept;
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with(start_of_sign)) kept += line + "\n";
  return kept;
}

}  // namespace airybench
