// Runs the cases meshes × scenes × methods through Google Benchmark: one registered benchmark a
// case, manual time, one iteration per repetition.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bench/options.hpp"
#include "bench/records/record.hpp"
#include "solvers/methods.hpp"

namespace airybench {

struct PosedScene {
  std::string scene_name, scene_group, mesh_sha256;
  std::shared_ptr<const Problem> problem;
};

struct Case {
  PosedScene posed;
  Method method;
  Knob knob = {};             // of a study
  std::string name() const {  // "Mesh0/default/3STEPD", "Mesh0/default/SSKY/tolerance=0.01"
    return posed.problem->mesh.name + "/" + posed.scene_name + "/" + method.name + knob.suffix();
  }
};

// Scene by scene, so that methods on the same blocks run after one another.
std::vector<Case> plan_cases(const std::vector<PosedScene>& scenes,
                             const std::vector<Method>& methods, Study study = Study::none);

// Prints progress to standard error, writes the output folder, returns the records in the order of
// the cases that ran. Throws UsageError (arguments for Google Benchmark), OutputError.
std::vector<Record> run_cases(const std::vector<Case>& cases, const Options& options,
                              const std::map<std::string, std::string>& context);

}  // namespace airybench
