// A solver that is a program of somebody else's, as a small JSON file declares it:
//
//   { "name": "scipy",
//     "summary": "sparse LU, Newton's method",
//     "reads": "airy", "format": "npz", "returns": "airy_function",
//     "command": ["python3", "solve.py", "{input}", "{output}"],
//     "version": ["python3", "-c", "import scipy; print('scipy', scipy.__version__)"],
//     "first_tolerance": 0.01 }
//
// reads      airy (S, C_F, C_C and loads), condensed (D, G), body (mesh, material, boundary data)
// returns    airy_function, contact_forces, displacement: what belongs to each of these; of a body
//            edge_displacements, too: those of hybridized elements, with their contact forces
// command    runs in the folder of this file. {input}: folder of the problem's files; {output}:
//            empty folder for the answer (answer.hpp); {threads}, {tolerance}, {time_limit_s}
// version    prints one line
// first_tolerance  only with {tolerance}: the first one, per target error; it is tightened until
//            the program's own error estimate is below the target
// summary, version and first_tolerance may be left out.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "support/process.hpp"

namespace airybench {

// Of commands, filled in for each run.
namespace placeholder {
inline constexpr const char *input = "{input}", *output = "{output}", *threads = "{threads}",
                            *tolerance = "{tolerance}", *time_limit_s = "{time_limit_s}";
inline constexpr std::array<std::string_view, 5> all = {input, output, threads, tolerance,
                                                        time_limit_s};
}  // namespace placeholder

struct Declaration {
  enum class Returns { airy_function, displacement, edge_displacements, contact_forces };

  std::filesystem::path folder;
  std::string name, summary, format;
  Returns returns = Returns::airy_function;  // which tells what it reads
  std::vector<std::string> command;
  std::string version = "unknown version";  // what its command printed
  double first_tolerance = 0;
};

// And asks the program for its version. Throws FileError, one line: file, key, value, what is
// allowed.
Declaration read_declaration(const std::filesystem::path& file);

// Lines that a program printed and that are not empty, each shortened: the first, and the last if
// there are more.
std::vector<std::string> printed_lines(const std::filesystem::path& file);
// "ended with exit code 3: the last line".
std::string how_it_ended(const ChildEnd& end, double limit_s,
                         const std::vector<std::string>& printed);

}  // namespace airybench
