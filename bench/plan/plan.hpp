// The cases of a run: meshes × scenes × methods, in a study × points of a knob.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "assembly/contact_problem.hpp"
#include "assembly/problem.hpp"
#include "bench/plan/options.hpp"
#include "bench/records/case_name.hpp"
#include "solvers/base/method.hpp"

namespace airybench {

// A level of an adaptive loop.
struct AdaptedMesh {
  int level = 0;
  double time_s = 0;          // of the loop up to this level
  double estimate_share = 0;  // of that time
  double smallest_angle_deg = 0;
};

// What a case solves.
using PosedProblem =
    std::variant<std::shared_ptr<const Problem>, std::shared_ptr<const contact::Problem>>;
const Problem* body_of(const PosedProblem& problem);  // null: there is none
std::string mesh_name_of(const PosedProblem& problem);

struct PosedScene {
  std::string scene_name, scene_group;
  std::string mesh_file, mesh_sha256;
  std::string scene_definition = "{}";  // the scene file's JSON
  PosedProblem problem;
  std::optional<AdaptedMesh> adapted = {};

  const std::shared_ptr<const Problem>& body() const { return std::get<0>(problem); }
};

struct Case {
  PosedScene posed;
  Method method;
  Knob knob = {};            // of a study
  int number = 0;            // in the whole plan, from 1, whatever part of it is run
  std::string study;         // its name
  Stop stop = Stop::target;  // the knob's, where it has one
  // Of the condensed contact problem; none: there is no such problem.
  std::optional<ContactSolver> contact = {};
  CaseName name() const;
};

// Scene by scene, so that methods on the same blocks run after one another. Without --contact:
// Newton, and of contact problems without a body all solvers.
std::vector<Case> plan_cases(const std::vector<PosedScene>& scenes,
                             const std::vector<Method>& methods, const Options& options = {});

// SHA-256 of the cases' names, meshes and scenes: two machines have the same plan.
std::string fingerprint(const std::vector<Case>& plan);

// The shard of a plan.
std::vector<Case> part_of(const std::vector<Case>& plan, const Shard& shard);

}  // namespace airybench
