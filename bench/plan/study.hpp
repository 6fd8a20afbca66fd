// Studies: cases beyond meshes × scenes × methods as they are.
//
//   error      every method over its accuracy knob — tolerance of CG and SYMMLQ, iterations of ALM,
//              sweeps of Gauss–Seidel; one point for a direct method — each point with time, memory
//              and error: what a digit costs
//   stability  every method on the extreme scenes of bench/scenes/stability, one outcome each:
//              where a method works, where it says that it does not, and where it is wrong
//              without saying
//   contact    HYBRID with every solver of the condensed contact problem, under the frictions of
//              bench/scenes/contact: the same D, to the bit, for all of them
//   adapted    methods of every kind on meshes that are adapted to three total errors: which of
//              them stand edges of a ten-thousandth of the body's size
//   load-steps methods that condense, and that do not, along paths of 1 to 50 equal steps
//              (bench/scenes/load-steps): what a body costs once, and what every load case
//   scaling    every method on 1, 2, … threads, on every mesh: the same problem on more threads
//              (strong scaling) and, between meshes, more unknowns on more threads (weak scaling)
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/records/record.hpp"
#include "solvers/base/method.hpp"

namespace airybench {

enum class Study { none, error, stability, contact, adapted, load_steps, scaling };
inline constexpr std::array<Study, 6> all_studies = {Study::error,      Study::stability,
                                                     Study::contact,    Study::adapted,
                                                     Study::load_steps, Study::scaling};
// Its records have the condition number of what the method factorises.
constexpr bool asks_for_condition(Study study) {
  return study == Study::stability || study == Study::adapted;
}
std::string name_of(Study study);       // empty: none
Study study_of(std::string_view name);  // none: no such study

// What a study turns in one case. The record shows it.
struct Knob {
  std::string name;  // "tolerance"; empty: nothing is turned
  std::optional<double> value;
  std::optional<Stop> stop;  // another than the run's
  std::optional<ContactSolver> contact;
  std::optional<int> threads = {};  // another number than the run's
};

struct TurnedMethod {
  Method method;  // does what the knob says, whatever the harness would have it do
  Knob knob;
};

// The points of one method in the error study.
std::vector<TurnedMethod> error_points(const Method& method);
// With every contact solver.
std::vector<TurnedMethod> contact_points(const Method& method);
// On each of these numbers of threads.
std::vector<TurnedMethod> scaling_points(const Method& method, const std::vector<int>& threads);

// What a study measures, and how long it waits, where it is not told.
struct StudyDefaults {
  std::string meshes;
  double timeout_s;
};
std::optional<StudyDefaults> defaults_of(Study study);  // empty: those of any run
// Names of methods, as --method takes them, that a study runs by default.
std::string default_methods(Study study);

// The scene files of a study that has its own, by name; else empty. Throws std::invalid_argument
// when there should be some.
std::vector<std::filesystem::path> scenes_of(Study study);

}  // namespace airybench
