// Studies: cases beyond meshes × scenes × methods as they are. A study is a file
// bench/scenes/NAME.json; another needs no code.
//
//   { "about": "what it shows, for bench --help",
//     "points": "accuracy",          of each method: see Study::Points; missing: the method as it
//     is "method": "HYBRID,P2",         as --method; missing: the paper's "options": { "--mesh":
//     "Mesh0", "--timeout": "60" },   where the command line has none "scenes": "stability", the
//     folder of its scene files, next to this file "once": true,                  each case is
//     timed once "condition": true,             records have the condition number of what is
//     factorised "bounds": true }               records have bounds of the total error
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "solvers/base/method.hpp"

namespace airybench {

struct Study {
  std::string name;  // empty: none
  std::string about, methods, scenes;
  // accuracy  its accuracy knob — tolerance of CG and SYMMLQ, iterations of ALM, sweeps of
  //           Gauss–Seidel — at every value; a direct method has one point
  // contact   every solver of the condensed contact problem
  // threads   every number of threads
  enum class Points { one, accuracy, contact, threads } points = Points::one;
  std::vector<std::pair<std::string, std::string>> options;
  bool once = false, condition = false, bounds = false;
};

std::vector<Study> all_studies();  // by name. Throws FileError.
// Empty: no such study.
std::optional<Study> study_named(const std::string& name);
// Names of methods, as --method takes them, that a study runs by default.
std::string default_methods(const Study& study);
// The study's own scene files, by name. Throws std::invalid_argument: there should be some.
std::vector<std::filesystem::path> scenes_of(const Study& study);

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

std::vector<TurnedMethod> error_points(const Method& method);
std::vector<TurnedMethod> contact_points(const Method& method);
std::vector<TurnedMethod> scaling_points(const Method& method, const std::vector<int>& threads);

}  // namespace airybench
