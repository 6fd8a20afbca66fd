// The options of a run. bench/commands/run_options.cpp reads them from the command line of `bench`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/plan/case_settings.hpp"
#include "bench/plan/study.hpp"
#include "support/time_limit.hpp"

namespace airybench {

inline constexpr int max_threads = 1024;

// When to stop adapting a mesh; exactly one member is set.
struct AdaptGoal {
  std::optional<double> error;  // relative total error
  std::optional<int> unknowns;  // least n_φ
};
// "1%": an error above 0 % and below 100 %. "50000": 100 to 5 000 000 unknowns. Else empty.
std::optional<AdaptGoal> adapt_goal_of(const std::string& text);
std::string text_of(const std::vector<AdaptGoal>& goals);  // "1%,50000"

// The cases index, index + count, … of a plan, so that every shard has cases of every size.
struct Shard {
  int index = 1, count = 1;
};
std::string name_of(const Shard& shard);                 // "2/3"
std::optional<Shard> shard_of(const std::string& text);  // empty unless k/n with 1 ≤ k ≤ n

// How meshes are adapted: until each of the goals in turn; no goal: they are not.
struct Adaptation {
  std::vector<AdaptGoal> goals;
  std::optional<double> marking;  // bulk marking: share of the squared error, per level
  // Largest relative error of the largest stress, by its own estimate, where an error is a goal.
  std::optional<double> stress_error;
  std::string by = "HYBRID";  // method that solves the levels
  bool goals_only = false;    // make cases only of levels that reach a goal
};

// What is solved, by which methods, and what is asked of it.
struct RunSettings {
  std::string meshes = "Mesh0..Mesh3";
  std::vector<std::string>
      model_settings;   // options for `meshgen --convert`: "--role=clamped=displacement"
  std::string methods;  // empty: those of the paper
  std::vector<std::filesystem::path> problems;   // FCLIB files instead of meshes and scenes
  std::vector<std::filesystem::path> externals;  // declarations of other programs
  std::vector<std::filesystem::path> scenes;     // empty: a deck's own, or the default scene
  bool needs_scene = false;                      // no default scene of another body than ours
  std::optional<int> equal_steps;                // of a scene without load steps
  std::optional<int> figure;  // 3, 4 or 5: meshes and methods of the paper's figure
  Study study;
  CaseSettings cases;                    // what its cases are asked, but for a study's points
  std::vector<int> thread_counts = {1};  // scaling study: ascending from 1
  std::vector<double> budgets_s;         // error study: --study=error:…
  Adaptation adapt;
  std::optional<int> degree;  // --degree: of HYBRID's stresses, on the levels and in cases
  Shard shard;
  std::string filter;  // --benchmark_filter=, selects cases
};

// How often a case is measured, and what bounds a solve.
struct Limits {
  int repetitions = 5;
  std::optional<double> precision;        // repeat until the median is known to this share …
  int max_repetitions = 1000;             // … but at most so often
  std::optional<double> retry_noisy;      // share: measure a case again if the calibration loop
                                          // deviates by more
  bool interleave = false;                // repetitions of a scene's cases in random order
  double long_case_s = 30;                // a longer solve is measured once
  double timeout_s = 900;                 // per solve
  std::optional<double> tuning_budget_s;  // per case, to find parameters and tolerances
  std::optional<double> others_s;         // each phase that is no solve: see phase_limit_s()
  std::optional<std::int64_t> memory_limit_bytes;  // heap per solve, blocks included
};

// Of posing a scene, assembly, reference, verification, errors, fields; unless given, that of a
// solve, but at least 900 s.
double phase_limit_s(const Limits& limits);
// The same for a phase of this process, which ends when it is passed. what: "a.dat: reading it".
TimeLimit phase_limit(const std::string& what, const Limits& limits);

// Where records go.
struct Output {
  std::filesystem::path folder = "results/latest";
  std::vector<std::string> columns;            // of the printed table (report/results_table.hpp)
  bool append = false;                         // keep the records in the folder
  bool resume = false;                         // run only the cases without a record
  std::map<std::string, std::string> context;  // --benchmark_context=, added to records
};

struct Options {
  RunSettings run;
  Limits limits;
  Output output;
  bool dry_run = false;  // plans only: writes no mesh, adapts none
};

}  // namespace airybench
