#include "bench/run/sign_of_life.hpp"

#include <chrono>
#include <iostream>

#include "support/seconds_since.hpp"

namespace airybench {
namespace {

constexpr double most_silent_s = 10;

auto& last() {
  static std::chrono::steady_clock::time_point heard = std::chrono::steady_clock::now();
  return heard;
}

}  // namespace

void sign_of_life(const std::function<std::string()>& what) {
  if (seconds_since(last()) < most_silent_s) return;
  std::cerr << what() + "\n" << std::flush;
  was_heard();
}

void was_heard() { last() = std::chrono::steady_clock::now(); }

}  // namespace airybench
