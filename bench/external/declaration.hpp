// An external solver program, declared by a small JSON file:
//
//   { "name": "scipy",
//     "summary": "sparse LU, Newton's method",
//     "reads": "airy", "format": "npz", "returns": "airy_function",
//     "command": ["python3", "solve.py", "{input}", "{output}"],
//     "version": ["python3", "-c", "import scipy; print('scipy', scipy.__version__)"],
//     "first_tolerance": 0.01 }   (and "print_precision": 5e-7, for seven printed digits)
//
//   reads, returns   airy (S, C_F, C_C and loads): airy_function; condensed (D, G): contact_forces;
//                    body (mesh, material, boundary data): displacement, or edge_displacements of
//                    hybridized elements with their contact forces
//   components       optional, of condensed: how many per contact the program takes, of 1 (without
//                    friction; in FCLIB 2), 2 (plane), 3 (space), as [2] or [2, 3]; else all
//   command          runs in this file's folder. {input}: folder of the problem's files; {output}:
//                    empty folder for the answer (answer.hpp). Also {threads}, {tolerance},
//                    {time_limit_s}
//   parameter        optional, {"penalty": [5000, 500]}: a program for every value of {penalty} in
//                    the command; the first has the plain name, others NAME:penalty=500.
//                    Record::parameters begins with it
//   version          optional, like summary; prints one line
//   first_tolerance  optional, with {tolerance}: the first tolerance per target error, tightened
//                    until the program's own error estimate is below the target
//   print_precision  optional, of displacement: the largest relative rounding of a printed number,
//                    5e-7 for seven digits. Unbalanced forces that it explains do not count
//   allowed_penetration  optional, of displacement: u_n − g0 at nodes over the largest
//                    displacement; 1e-3
//   weak_contact     optional, of displacement: true of a contact law (Nitsche's) that also loads
//                    inner nodes next to Γ_C; contact forces are then asked for their sum
//   other_elements   optional, of displacement: true of a program whose elements are not quadratic
//                    (linear, cubic, other meshes): it returns its displacements at vertices and
//                    middles of edges, and is judged by their total error alone
//   joins_bodies     optional, of displacement: true if it takes bodies that press on each other
//                    (contact_opposite)
//   load_steps       optional, of displacement: true if it measures slip from slid_mm
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "solvers/base/solution.hpp"
#include "support/process.hpp"

namespace airybench {

namespace placeholder {
inline constexpr const char *input = "{input}", *output = "{output}", *threads = "{threads}",
                            *tolerance = "{tolerance}", *time_limit_s = "{time_limit_s}";
inline constexpr std::array<std::string_view, 5> all = {input, output, threads, tolerance,
                                                        time_limit_s};
}  // namespace placeholder

inline constexpr double usual_penetration = 1e-3;

struct Declaration {
  enum class Returns { airy_function, displacement, edge_displacements, contact_forces };

  std::filesystem::path folder;
  std::string name, summary, format;
  Returns returns = Returns::airy_function;  // also tells what it reads
  std::vector<int> components;               // that it takes; empty: all
  std::string parameter;                     // its name; empty: none
  std::vector<std::string> values;           // of it
  std::vector<std::string> command;
  std::string version = "unknown version";  // printed by its version command
  double first_tolerance = 0;
  ProgramTolerances tolerances = {.allowed_penetration = usual_penetration};
  bool joins_bodies = false, load_steps = false;
};

// Excludes globs, lists and parts of paths, so that a user can select the name.
bool is_plain_program_name(const std::string& name);

// Also runs the version command. Throws FileError, one line: file, key, value, what is allowed.
Declaration read_declaration(const std::filesystem::path& file);

// One for every value of its parameter, with that value, its only one, in its command.
std::vector<Declaration> for_every_value(const Declaration& declaration);

// The program's non-empty lines, shortened: the first, and the last if there are more.
std::vector<std::string> printed_lines(const std::filesystem::path& file);
std::string how_it_ended(const ChildEnd& end, double limit_s,
                         const std::vector<std::string>& printed);

}  // namespace airybench
