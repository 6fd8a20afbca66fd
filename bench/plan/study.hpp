// A study runs cases beyond plain meshes × scenes × methods. It is a file bench/scenes/NAME.json,
// so a new study needs no code. All keys but "about" are optional:
//
//   "about": "text"          what the study shows, for bench --help
//   "points": "accuracy"     cases of each method, see Study::Points; default: one
//   "method": "HYBRID,P2"    as --method; default: the paper's methods
//   "options": {"--mesh": "Mesh0", "--timeout": "60"}    defaults for the command line
//   "scenes": "stability"    folder of the scene files, next to this file
//   "once": true             each case is timed once
//   "condition": true        records have the condition number of the factorised matrix
//   "intervals": true        records have intervals of the contact forces
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/plan/case_settings.hpp"
#include "solvers/base/method.hpp"

namespace airybench {

struct Study {
  std::string name;  // empty: no study
  std::string about, methods, scenes;
  // accuracy: a case per value of Method::knob; contact: per contact solver; threads: per number.
  enum class Points { one, accuracy, contact, threads } points = Points::one;
  std::vector<std::pair<std::string, std::string>> options;
  bool once = false, condition = false, intervals = false;
};

std::string_view name_of(Study::Points points);     // "accuracy"; of one: ""
Study study_of(const std::filesystem::path& file);  // throws FileError
std::vector<Study> all_studies();                   // sorted by name; throws FileError
std::optional<Study> study_named(const std::string& name);
std::string default_methods(const Study& study);  // as for --method
// Sorted by name. Throws std::invalid_argument if the study's folder has no scene file.
std::vector<std::filesystem::path> scenes_of(const Study& study);

// What tells the cases of a method in a study apart.
struct Knob {
  std::string name;  // "tolerance"; empty: nothing
  std::optional<double> value;
};

// A case of a method, as a study has several.
struct StudyPoint {
  Knob knob;
  CaseSettings settings;
};

// They start from what is asked of every case. A point with a knob is not tightened, but for the
// numbers of threads.
std::vector<StudyPoint> error_points(const Method& method, const CaseSettings& asked);
std::vector<StudyPoint> contact_points(const Method& method, const CaseSettings& asked);
// The same to 1e-4 and to 1e-8, each by a separate run. All stop at a tenth of it by their own
// measure, natural map or Siconos', so that the answer's is not above it in the file's units.
std::vector<StudyPoint> precision_points(const Method& method, const CaseSettings& asked);
std::vector<StudyPoint> scaling_points(const CaseSettings& asked, const std::vector<int>& threads);

}  // namespace airybench
