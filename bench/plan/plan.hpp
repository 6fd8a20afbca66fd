// The cases of a run: meshes × scenes × methods, and in a study × points of a knob.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "assembly/contact_problem.hpp"
#include "assembly/problem/problem.hpp"
#include "assembly/problem/scene.hpp"
#include "bench/plan/options.hpp"
#include "bench/records/record.hpp"
#include "solvers/base/method.hpp"

namespace airybench {

struct AdaptedMesh {
  int level = 0;
  double time_s = 0;                // of the loop, up to this level
  std::optional<double> goal = {};  // the total error that it meets
};

using PosedProblem =
    std::variant<std::shared_ptr<const Problem>, std::shared_ptr<const contact::Problem>>;
// What is posed, if it is of this type; else null.
template <typename Wanted>
std::shared_ptr<const Wanted> held(const PosedProblem& problem) {
  const auto* const found = std::get_if<std::shared_ptr<const Wanted>>(&problem);
  return found != nullptr ? *found : nullptr;
}
const Problem* body_of(const PosedProblem& problem);  // null without a body
std::string mesh_name_of(const PosedProblem& problem);

struct PosedScene {
  std::string scene_name, scene_group;
  std::string mesh_file, mesh_sha256;
  std::string scene_definition = "{}";  // the scene file's JSON
  PosedProblem problem;
  std::optional<AdaptedMesh> adapted = {};

  const std::shared_ptr<const Problem>& body() const { return std::get<0>(problem); }
};

// pose(), within phase_limit().
std::shared_ptr<const Problem> pose_in_time(const Scene& scene, const std::string& scene_name,
                                            Mesh mesh, const Limits& limits);

struct Case {
  PosedScene posed;
  Method method;
  CaseSettings settings = {};
  Knob knob = {};
  int number = 0;          // in the whole plan, from 1, also in a shard
  std::string study = {};  // its name
  Study::Points points = Study::Points::one;
  CaseName name() const;
};

// What every case is asked, but for what a study's points change.
CaseSettings common_settings(const RunSettings& run);

// Orders cases by scene, so that methods on the same blocks run one after another. Without
// --contact, bodies take Newton, and problems without a body one case per contact solver.
std::vector<Case> plan_cases(const std::vector<PosedScene>& scenes,
                             const std::vector<Method>& methods, const RunSettings& run = {});

std::string fingerprint(const std::vector<Case>& plan);  // SHA-256 of names, meshes, scenes

std::vector<Case> part_of(const std::vector<Case>& plan, const Shard& shard);

// The record of a case before anything runs: names, sizes, what is asked, stages and the reason to
// skip it.
Record blank_record(const Case& planned, const Limits& limits);

void describe(const Method& method, Record& record);

}  // namespace airybench
