#include "bench/commands/commands.hpp"

#include <fmt/format.h>

namespace airybench {
namespace {

constexpr Command commands[] = {
    {"solve", "MODEL", "forces, pressure, stress and displacement of a part", solve_command},
    {"advise", "", "the mesh and the method for a given total error", advise_command},
    {"list", "", "meshes, methods, contact solvers and studies", list_command},
    {"explain", "", "the stages of each case, and why others are left out", explain_command},
    {"new-scene", "MODEL", "a scene for a model, to fill in", new_scene_command},
    {"new-external", "NAME", "a template of an external solver, and its declaration",
     new_external_command},
    {"check", "DECLARATION", "finds the mistakes of another program by small cases", check_command},
    {"compare", "A,… B,…", "runs of two programs, case by case: faster, slower, or undecided",
     compare_command},
    {"track", "", "a run that is added to a history, and its regressions", track_command},
    {"validate", "", "comparison with published values, closed forms, benchmarks",
     validate_command},
    {"export", "DIR", "tables for papers; Google Benchmark's JSON, CSV", export_command},
    {"export-problem", "", "the matrices of a problem, for your own solver",
     export_problem_command},
    {"merge", "DIR...", "joins the shards of a run", merge_command},
    {"profile", "MODEL", "where the time of the adaptive loop goes", profile_command},
    {"replay", "RECORD", "runs a recorded case again", replay_command},
};

constexpr const char* usage = R"(
Usage: {bench} [OPTIONS]            a run: every mesh, scene and method chosen
       {bench} COMMAND [OPTIONS]    one of these, each with --help

)";

constexpr const char* main_options = R"(
Main options of a run ({bench} --help-all: every option, the exit codes, more examples)
  --mesh=MESHES      Mesh0..Mesh3, Mesh1,Mesh4, a glob, or files: meshes and CAD models
  --scene=FILES      loads, friction, materials; default: the documented tooth or rack
  --method=METHODS   names or globs; default: the paper's, for your own bodies HYBRID and P2
  --adapt=GOALS      refine where the error is, until it is below 1%, or until 50000 unknowns
  --study=NAME       cases that answer one question: contact, error, stability, adapted, ...
  --external=FILES   other programs next to ours
  --fields           stresses, displacements and total errors, too
  --dry-run          what would run, and how long it would take
  --out=FOLDER       records, tables and figures; default: results/latest

Examples
  {bench} --mesh=Mesh0..Mesh3 --method='3STEPD*,HYBRID'
  {bench} --mesh=part.geo --role=clamped=displacement --scene=load.json --adapt=1%
  {bench} solve part.step scene.json --error=1%
)";

}  // namespace

std::span<const Command> all_commands() { return commands; }

std::string list_of_commands() {
  std::string text = "Commands\n";
  for (const Command& command : commands)
    text += fmt::format("  {:<19}  {}\n", fmt::format("{} {}", command.name, command.operand),
                        command.about);
  return text;
}

std::string overview() {
  return "Time, memory and error of methods for contact with friction solved in stresses.\n" +
         std::string(usage) + list_of_commands() + main_options;
}

}  // namespace airybench
