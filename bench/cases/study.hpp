// Studies: cases beyond meshes × scenes × methods as they are.
//
//   error      every method over its accuracy knob — tolerance of CG and SYMMLQ, iterations of ALM,
//              sweeps of Gauss–Seidel; one point for a direct method — each point with time, memory
//              and error: what a digit costs
//   stability  every method on the extreme scenes of bench/scenes/stability, one outcome each:
//   where
//              a method works, where it says that it does not, and where it is wrong without saying
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/records/record.hpp"
#include "solvers/base/method.hpp"

namespace airybench {

enum class Study { none, error, stability };
std::string name_of(Study study);  // empty: none

// What a study turns in one case. The record shows it.
struct Knob {
  std::string name;  // "tolerance"; empty: nothing is turned
  std::optional<double> value;
  std::optional<Stop> stop;  // another than the run's
};

struct TurnedMethod {
  Method method;  // does what the knob says, whatever the harness would have it do
  Knob knob;
};

// The points of one method in the error study.
std::vector<TurnedMethod> error_points(const Method& method);

// Names of methods, as --method takes them, that a study runs by default.
std::string default_methods(Study study);

// The scene files of the atlas, by name. Throws std::invalid_argument when there are none.
std::vector<std::filesystem::path> stability_scenes();

}  // namespace airybench
