#include "bench/run_command.hpp"

#include <fmt/format.h>

#include "assembly/mesh_selection.hpp"
#include "bench/cases/mesh_files.hpp"
#include "bench/cases/scene_file.hpp"
#include "bench/cases/stages.hpp"
#include "bench/measuring/environment.hpp"
#include "bench/measuring/runner.hpp"
#include "bench/options.hpp"
#include "bench/records/record_files.hpp"
#include "bench/terminal.hpp"

namespace airybench {
namespace {

// The paper shows SYMMLQ and says that the other is alike; both are run.
constexpr const char* figure_3_methods = "SYMMLQ:*,3STEPCG:*";

void print_list() {
  fmt::print("meshes ({}):\n", mesh_directory().string());
  for (const std::string_view name : catalogue_mesh_names) fmt::print("  {}\n", name);
  fmt::print("methods (* of the paper, run by default):\n");
  for (const Method& method : methods()) {
    const std::string same =
        method.general_name.empty() ? "" : fmt::format(" (= {})", method.general_name);
    fmt::print("  {}{:<16}  {}{}\n", method.in_paper ? "*" : " ", method.name, method.summary,
               same);
  }
  fmt::print(
      "also: 3STEPCG:<preconditioner>[,refine=yes][,lanes=1],\n"
      "      SYMMLQ:<preconditioner>[,refine=yes][,schur=sparse][,lanes=1], ALM:r=<r>,rho=<rho>;\n"
      "      preconditioners: DTIC3..DTIC6, FLIC1..FLIC5, SSOR<0..2>, SKY, NONE\n");
}

std::vector<PosedScene> pose_all(const Options& options) {
  std::vector<Scene> scenes;
  const bool atlas = options.study == Study::stability && options.scenes.empty();
  for (const auto& file : atlas ? stability_scenes() : options.scenes) {
    scenes.push_back(read_scene(file));
    for (std::size_t i = 0; i + 1 < scenes.size(); ++i)
      if (scenes[i].name == scenes.back().name)
        throw UsageError(fmt::format("--scene: two scenes are named {}: {} and {}", scenes[i].name,
                                     scenes[i].source, scenes.back().source));
  }
  if (scenes.empty()) scenes.emplace_back();
  std::vector<PosedScene> posed;
  for (const MeshFile& file : read_meshes(options.meshes))
    for (const Scene& scene : scenes)
      posed.push_back({scene.name, scene.group, file.sha256,
                       std::make_shared<const Problem>(pose(scene, file.mesh))});
  return posed;
}

void print_plan(const std::vector<Case>& cases, bool explain) {
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const Case& c = cases[k];
    const MeshSizes sizes = solved_sizes(*c.posed.problem);
    fmt::print("[{}/{}] {}  n_phi {}, n_f {}, n_c {}\n", k + 1, cases.size(), c.name(), sizes.n_phi,
               sizes.n_f, sizes.n_c);
    if (!explain) continue;
    for (const StageDecision& decision : decide_stages(*c.posed.problem, c.method, false))
      fmt::print("    {:<9} {}{}{}\n", decision.run ? "run" : "left out", decision.stage,
                 decision.run ? "" : ": ", decision.reason);
  }
}

}  // namespace

int run_command(int argc, const char* const* argv) {
  constexpr int all_ok = 0, some_case_failed = 1;
  Options options = parse_options(argc, argv);
  if (options.figure) {
    options.meshes = *options.figure == 3 ? "Mesh3" : "Mesh0..Mesh7";
    options.methods = *options.figure == 3 ? figure_3_methods : default_methods(Study::none);
  }
  if (options.list) {
    print_list();
    return all_ok;
  }
  const std::vector<Method> selected =
      select_methods(options.methods.empty() ? default_methods(options.study) : options.methods);
  const std::vector<Case> cases = plan_cases(pose_all(options), selected, options.study);
  if (options.dry_run || options.explain) {
    print_plan(cases, options.explain);
    return all_ok;
  }
  set_threads(options.threads);
  const std::vector<Record> records =
      run_cases(cases, options, describe_environment(options.threads));
  fmt::print("\n{}\nrecords.jsonl, results.csv, results.json in {}\n", results_table(records),
             options.out.string());
  for (const Record& record : records)
    if (record.status != Status::ok && record.status != Status::skipped) return some_case_failed;
  return all_ok;
}

}  // namespace airybench
