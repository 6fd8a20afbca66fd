#include "bench/commands/export_problem_command.hpp"

#include <fmt/format.h>

#include "bench/commands/command_line.hpp"
#include "bench/commands/posed_scenes.hpp"
#include "bench/problems/problem_files.hpp"
#include "support/errors.hpp"

namespace airybench {
namespace {

constexpr const char* export_problem_footer = R"(
Formats  matrix-market  a .mtx file for every array
         npz            S.npz, C_F.npz, C_C.npz for scipy.sparse.load_npz(), problem.npz for
                        numpy.load()
         fclib          problem.hdf5, the condensed contact problem as Siconos and LMGC90 read it

With them problem.json: equations, signs, and of every array its file, shape, unit and meaning. In
docs/exporting-problems.md is a solver that reads them.

Exit status  0  written
             2  wrong usage, or a problem that cannot be exported: one line on standard error

Example
  bench export-problem --mesh=Mesh0 --format=npz --out=Mesh0-problem
)";

struct ExportProblemOptions {
  Options run;  // meshes, model_settings, scenes
  std::string format;
  std::filesystem::path out;
};

ExportProblemOptions parse_export_problem(int argc, const char* const* argv) {
  ExportProblemOptions options;
  options.run.dry_run = true;  // a model's mesh is not kept
  CLI::App app("A problem's matrices, for solvers of one's own.", "bench export-problem");
  app.footer(export_problem_footer);
  app.add_option("--mesh", options.run.meshes, "one mesh: a name or a file, as for a run")
      ->required()
      ->default_str("");
  add_model_settings(app, options.run.model_settings);
  std::filesystem::path scene;
  app.add_option("--scene", scene, "scene file; default: the default scene");
  app.add_option("--format", options.format, "of the formats below")->required();
  app.add_option("--out", options.out, "folder to write, which is not there yet or empty")
      ->required();
  parse_command_line(app, argc, argv);
  check_problem_format(options.format);
  check_is_free(options.out);
  if (!scene.empty()) options.run.scenes = {scene};
  return options;
}

}  // namespace

int export_problem_command(int argc, const char* const* argv) {
  const ExportProblemOptions options = parse_export_problem(argc, argv);
  const std::vector<PosedScene> posed = pose_all(options.run);
  if (posed.size() != 1)
    throw UsageError(
        fmt::format("--mesh: {}: {} meshes (allowed: one)", options.run.meshes, posed.size()));
  const ProblemFiles problem = problem_files(posed.front(), options.format);
  write_folder_atomically(options.out, problem.files);
  for (const std::string& note : problem.notes) fmt::print("note: {}\n", note);
  fmt::print("{} files in {}\n", problem.files.size(), options.out.string());
  return all_ok;
}

}  // namespace airybench
