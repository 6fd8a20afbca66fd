#include "bench/commands/commands.hpp"

#include <fmt/format.h>

#include "bench/commands/command_line.hpp"
#include "bench/commands/run_parts.hpp"
#include "bench/problems/problem_files.hpp"
#include "support/errors.hpp"

namespace airybench {
namespace {

constexpr const char* export_problem_footer = R"(
Formats  matrix-market  a .mtx file for every array
         npz            S.npz, C_F.npz, C_C.npz for scipy.sparse.load_npz(), problem.npz for
                        numpy.load()
         fclib          problem.hdf5, the condensed contact problem as Siconos and LMGC90 read it

With them problem.json: equations, signs, and of every array its file, shape, unit and meaning.
peers/scipy/solve_problem.py is a solver that reads them.

Exit status  0  written
             2  wrong usage, or a problem that cannot be exported: one line on standard error

Example
  {bench} export-problem --mesh=Mesh0 --format=npz --out=Mesh0-problem
)";

}  // namespace

int export_problem_command(int argc, const char* const* argv) {
  Options options;
  options.dry_run = true;  // no keep_models()
  std::string format;
  CLI::App app("A problem's matrices, for your own solvers.", "{bench} export-problem");
  app.footer(export_problem_footer);
  add_one_body(app, options.run);
  app.add_option("--format", format, "one of the formats below")->required();
  app.add_option("--out", options.output.folder, "folder to write, new or empty")
      ->required()
      ->default_str("");
  parse_command_line(app, argc, argv);
  check_problem_format(format);
  check_is_free(options.output.folder);
  const ProblemFiles problem = problem_files(one_posed_scene(options), format);
  write_folder_atomically(options.output.folder, problem.files);
  for (const std::string& note : problem.notes) fmt::print("note: {}\n", note);
  fmt::print("{} files in {}\n", problem.files.size(), options.output.folder.string());
  return all_ok;
}

}  // namespace airybench
