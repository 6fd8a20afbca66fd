#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "bench/commands/command_line.hpp"
#include "bench/commands/commands.hpp"
#include "bench/commands/planned_cases.hpp"
#include "bench/plan/mesh_files.hpp"
#include "bench/plan/study.hpp"
#include "mesh/selection.hpp"
#include "solvers/methods.hpp"
#include "support/errors.hpp"
#include "support/this_process.hpp"

namespace airybench {
namespace {

void print_list(const std::vector<Method>& others) {
  fmt::print("meshes ({}):\n", mesh_directory().string());
  for (const std::string_view name : catalogue_mesh_names) fmt::print("  {}\n", name);
  fmt::print("methods (* of the paper, run by default):\n");
  std::vector<Method> all = methods();
  std::ranges::copy(others, std::back_inserter(all));
  for (const Method& method : all) {
    const std::string same =
        method.general_name.empty() ? "" : fmt::format(" (= {})", method.general_name);
    fmt::print("  {}{:<16}  {}{}\n", method.in_paper ? "*" : " ", method.name, method.summary,
               same);
  }
  fmt::print(
      "also: {};\n"
      "      preconditioners: DTIC3..DTIC6, FLIC1..FLIC5, SSOR<0..2>, SKY, NONE;\n"
      "      EXTERNAL:<name> of the declarations of --external;\n"
      "      with --problem CONDENSED, the contact law alone by {}, and "
      "CONDENSED/contact=<solver>\n"
      "contact solvers (--contact, {} by default): {}\n"
      "studies (--study):\n",
      fmt::join(general_names(), ", "), name_of(ContactSolver::newton),
      name_of(ContactSolver::newton), fmt::join(names_of(all_contact_solvers), ", "));
  for (const Study& study : all_studies()) fmt::print("  {:<16}  {}\n", study.name, study.about);
}

}  // namespace

int list_command(int argc, const char* const* argv) {
  std::vector<std::filesystem::path> externals;
  CLI::App app("The names that a run takes: meshes, methods, contact solvers and studies.",
               "{bench} list");
  add_files(app, "--external", externals,
            "declarations of other programs, files or globs, which are listed, too");
  parse_command_line(app, argc, argv);
  require_standard_output();
  print_list(other_programs(externals));
  return all_ok;
}

}  // namespace airybench
