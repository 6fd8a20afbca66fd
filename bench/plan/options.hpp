// What a run is told: the command line of `bench`, see bench/commands/run_options.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/plan/study.hpp"
#include "solvers/base/solution.hpp"

namespace airybench {

inline constexpr int most_threads = 1024;

// Until when a mesh is adapted: one of the two.
struct AdaptGoal {
  std::optional<double> error;  // total error, relative
  std::optional<int> unknowns;  // n_φ, at least
};
// "1%" is an error, above 0 and below 100 %; "50000" a number of unknowns, 1 to 5 000 000. Empty:
// it is neither.
std::optional<AdaptGoal> adapt_goal_of(const std::string& text);
std::string text_of(const std::vector<AdaptGoal>& goals);  // the same text again: "1%,50000"

// One of `count` parts of a plan, for as many machines: the cases index, index + count, …, so that
// each has cases of every size.
struct Shard {
  int index = 1, count = 1;
};
std::string name_of(const Shard& shard);                 // "2/3"
std::optional<Shard> shard_of(const std::string& text);  // empty: not k/n with 1 ≤ k ≤ n

struct Options {
  std::string meshes = "Mesh0..Mesh3";
  std::vector<std::string>
      model_settings;   // of --mesh's Gmsh models: "--role=clamped=displacement"
  std::string methods;  // empty: all the paper's
  std::vector<std::filesystem::path> problems;   // FCLIB files, instead of meshes and scenes
  std::vector<std::filesystem::path> externals;  // declarations of other programs
  std::vector<std::filesystem::path> scenes;     // empty: the default scene
  std::filesystem::path out = "results/latest";
  std::optional<int> figure;  // of the paper, 3, 4 or 5: its meshes and methods
  Study study;
  double target_error = 1e-6;
  Stop stop = Stop::target;
  std::optional<ContactSolver> contact;  // none: see plan_cases()
  bool append = false;                   // keep the records that are in the folder
  bool resume = false;                   // and run only the cases that have none
  Shard shard;                           // the part of the plan that is run
  bool interleave = false;               // repetitions of a scene's cases in random turn
  int repetitions = 5;
  std::optional<double> precision;  // repetitions go on until the median is known to this share …
  int max_repetitions = 1000;       // … at most so many
  std::optional<double> retry_noisy;     // a case beside which the calibration loop was off by more
                                         // than this share is measured again
  int threads = 1;                       // of the scaling study the most
  std::vector<int> thread_counts = {1};  // of the scaling study, from 1 on
  double timeout_s = 900;                // per solve
  std::optional<double> tuning_budget_s;           // of a case's search for parameters, tolerances
  std::vector<double> budgets_s;                   // of the error study: --study=error:…
  double long_case_s = 30;                         // a longer solve is measured once
  std::optional<std::int64_t> memory_limit_bytes;  // of heap per solve, blocks included
  std::vector<AdaptGoal> adapt;     // refine the meshes where the error is, until each of these …
  std::optional<double> marking;    // bulk marking of this share of the squared error, per level
  std::string adapt_by = "HYBRID";  // method that solves the levels
  bool goals_only = false;          // the cases are of the levels that reach one
  bool fields = false;              // write stresses, displacements, contact points …
  bool mean_fields = false;         // … and the mean with the stresses of displacements
  bool histories = false;           // keep iteration histories in records.jsonl
  bool list = false, dry_run = false, explain = false;
  // What came after "--" for Google Benchmark:
  std::string filter;                              // --benchmark_filter=, selects cases
  std::map<std::string, std::string> own_context;  // --benchmark_context=, for the records
};

}  // namespace airybench
