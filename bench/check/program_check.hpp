// `bench check mine.json`: small cases that are made to test external programs, each for one
// mistake (bench/scenes/check), and which mistake a wrong answer looks like.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/plan/options.hpp"
#include "bench/plan/plan.hpp"

namespace airybench {

struct CheckedCase {
  std::string name;        // "01_sign_of_G"
  std::string made_for;    // "Sign of G"
  std::string verdict;     // "ok", or a status
  std::string looks_like;  // if it is not ok
  bool passed = false;
};

struct CheckReport {
  std::vector<CheckedCase> cases;
  std::string conclusion;  // the mistakes that explain all answers; empty: none does, or all is ok
};

// scenes: of the study `check`. ended: called after every case, the program's answer being judged.
CheckReport check_program(const Method& program, const std::vector<PosedScene>& scenes,
                          const CaseSettings& asked, const Limits& limits,
                          const std::function<void(const CheckedCase&)>& ended);

}  // namespace airybench
