// A part's answer to an error that is asked for, as `bench solve` and `bench validate` want it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "bench/plan/options.hpp"
#include "bench/plan/plan.hpp"
#include "bench/run/runner.hpp"

namespace airybench {

enum class PartQuantity { energy, force, pressure };
struct PartGoal {
  double error = 0;
  PartQuantity of = PartQuantity::energy;
};

// One case with fields, intervals and no repetitions, of the last level alone.
Options options_of_part();
// Goals of its loop: the error and, where it is one of energy, that of the largest stress. degree:
// as of --degree. Throws UsageError.
void ask_for(const PartGoal& goal, const std::string& degree, Options& options);

struct SolvedPart {
  Record record;
  RunResult result;
  std::string short_of;
  std::filesystem::path fields;  // without extensions
  Json part;                     // its answer; null: there is none
};
// By HYBRID; more: other methods on its last level, whose records follow in the result. Where
// CaseSettings::in_eight_steps finds a change above the goal, and no number of steps is asked for,
// the load is applied in eight. Empty: no level has an answer. Prints progress to standard error.
std::optional<SolvedPart> solved_part(const PosedScene& start, const Options& options,
                                      const PartGoal& goal, const std::vector<Method>& more = {});

// The error that a quantity has now; none: it is not known. of: "contact:sole"; empty: all faces.
struct Reached {
  std::optional<double> error;
  std::string of = {};
};
// The worst of all faces together and of each that carries a share of the load.
Reached reached(const SolvedPart& solved, PartQuantity of);

}  // namespace airybench
