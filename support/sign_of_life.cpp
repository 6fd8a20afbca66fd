#include "support/sign_of_life.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <sstream>
#include <string_view>
#include <utility>

#include "support/numbers.hpp"
#include "support/seconds_since.hpp"
#include "support/terminal.hpp"
#include "support/text_table.hpp"

namespace airybench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::string_view start_of_sign = "... ";

double most_silent_s() {
  constexpr double preset_s = 10, least_s = 0.01;
  const char* const given = std::getenv("AIRYBENCH_SILENT_S");
  const std::optional<double> seconds = parse_number(given != nullptr ? given : "");
  return std::max(seconds.value_or(preset_s), least_s);
}

auto& last() {
  static std::atomic<Clock::time_point> heard = Clock::now();
  return heard;
}

}  // namespace

void sign_of_life(const std::function<std::string()>& what) {
  if (seconds_since(last()) < most_silent_s()) return;
  std::string line = what() + "\n";
  if (isatty(STDERR_FILENO) != 0) line = escaped_for_terminal(line);
  // Not by a stream, whose lock a fork of another thread would keep.
  if (write(STDERR_FILENO, line.data(), line.size()) < 0) return;
  was_heard();
}

void was_heard() { last() = Clock::now(); }

SignsOfLife::SignsOfLife(std::string what) {
  was_heard();
  thread_ = std::thread([this, text = std::move(what), start = Clock::now()] {
    const std::chrono::duration<double> pause(std::min(most_silent_s(), 1.0));
    std::unique_lock lock(mutex_);
    while (!ended_.wait_for(lock, pause, [this] { return has_ended_; }))
      sign_of_life([&] {
        return fmt::format("{}{}, for {}", start_of_sign, text,
                           show_duration(seconds_since(start)));
      });
  });
}

SignsOfLife::~SignsOfLife() {
  {
    const std::lock_guard lock(mutex_);
    has_ended_ = true;
  }
  ended_.notify_one();
  thread_.join();
}

std::string without_signs_of_life(const std::string& printed) {
  std::istringstream lines(printed);
  std::string kept;
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with(start_of_sign)) kept += line + "\n";
  return kept;
}

}  // namespace airybench
