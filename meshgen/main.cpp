// The `meshgen` command: see commands.hpp for what each mode does.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <iostream>

#include "meshgen/commands.hpp"

namespace {

constexpr int exit_failure = 1, exit_usage = 2;

struct Arguments {
  std::string selection, model, out;
  bool check = false, tooth = false;
  std::string repository = AIRYBENCH_MESH_DIR;
  airybench::ToothDimensions dimensions;
  airybench::EdgeCounts edges;
  int vertices = 0;
};

constexpr std::array modes = {"--mesh", "--check", "--tooth", "--convert"};

void declare(CLI::App& app, Arguments& a) {
  const std::string what = "What to do, exactly one of";
  app.add_option("--mesh", a.selection,
                 "Make catalogue meshes anew and compare them with the repository's: Mesh0..Mesh7, "
                 "a list, a glob")
      ->type_name("MESHES")
      ->group(what);
  app.add_flag("--check", a.check, "Compare the repository's meshes with the paper's Tab. 1")
      ->group(what);
  auto* tooth =
      app.add_flag("--tooth", a.tooth, "Make a tooth or rack of own dimensions")->group(what);
  app.add_option("--convert", a.model,
                 "Convert a Gmsh model (.geo, .msh, .step) with physical curves displacement, "
                 "force, contact and a physical surface per body")
      ->type_name("MODEL")
      ->group(what);

  app.add_option("--out", a.out,
                 "Where to write: a folder with --mesh; a .msh file with --tooth, --convert")
      ->type_name("PATH");
  app.add_option("--meshes", a.repository, "Folder of the repository's meshes")
      ->envname("AIRYBENCH_MESH_DIR")
      ->type_name("DIR");

  const auto of_tooth = [&](const char* name, auto& value, const char* help) {
    return app.add_option(name, value, help)->needs(tooth)->group("With --tooth");
  };
  const auto count = [&](const char* name, int& value, const char* help) {
    return of_tooth(name, value, help)->check(CLI::Range(1, 1'000'000));
  };
  const auto length = [&](const char* name, double& value, const char* help) {
    of_tooth(name, value, help)->type_name("MM")->capture_default_str();
  };
  count("--contact-edges", a.edges.contact, "Edges on the tips, all together");
  count("--force-edges", a.edges.force, "Edges on the free faces");
  count("--displacement-edges", a.edges.displacement, "Edges on the held face");
  count("--vertices", a.vertices, "Exact number of vertices (default: as it comes)");
  count("--teeth", a.dimensions.teeth, "1: a single tooth; more: a rack")->capture_default_str();
  length("--root-half-height", a.dimensions.root_half_height, "Half height of the root");
  length("--length", a.dimensions.length, "Length of a tooth");
  length("--tip-half-height", a.dimensions.tip_half_height, "Half height of the tip");
  length("--pitch", a.dimensions.pitch, "Distance between a rack's teeth");
  length("--block-depth", a.dimensions.block_depth, "Depth of a rack's block");
}

// Everything CLI11 cannot say about the arguments.
void check_usage(const CLI::App& app, const Arguments& a) {
  const auto given = std::count_if(modes.begin(), modes.end(),
                                   [&](const char* mode) { return app.count(mode) > 0; });
  if (given != 1)
    throw std::invalid_argument(fmt::format("exactly one of {} is needed ({} given); see --help",
                                            fmt::join(modes, ", "), given));
  const bool writes_a_file = a.tooth || app.count("--convert") > 0;
  if (writes_a_file && a.out.empty())
    throw std::invalid_argument("--out is missing; --tooth and --convert write the file it names");
  if (writes_a_file && !a.out.ends_with(".msh"))
    throw std::invalid_argument(
        fmt::format("--out: '{}'; a file name ending in .msh is needed", a.out));
  if (a.check && app.count("--out") > 0)
    throw std::invalid_argument("--out does not go with --check, which writes nothing");
  if (!a.tooth) return;
  for (const char* name : {"--contact-edges", "--force-edges", "--displacement-edges"})
    if (app.count(name) == 0)
      throw std::invalid_argument(fmt::format(
          "{} is missing; --tooth needs --contact-edges, --force-edges, --displacement-edges",
          name));
}

int run(const CLI::App& app, const Arguments& a) {
  check_usage(app, a);
  if (a.check) return airybench::check_command(a.repository);
  if (a.tooth)
    return airybench::tooth_command(
        a.dimensions, a.edges,
        app.count("--vertices") > 0 ? std::optional(a.vertices) : std::nullopt, a.out);
  if (app.count("--convert") > 0) return airybench::convert_command(a.model, a.out);
  return airybench::remake_command(
      a.selection, a.repository,
      a.out.empty() ? std::nullopt : std::optional<std::filesystem::path>(a.out));
}

int complain(std::string what, int exit_code) {
  std::replace(what.begin(), what.end(), '\n', ' ');
  std::cerr << "meshgen: " << what << "\n";
  return exit_code;
}

std::string valid_options(const CLI::App& app) {
  std::string names;
  for (const CLI::Option* option : app.get_options())
    names += (names.empty() ? "" : ", ") + option->get_name();
  return names;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Makes, checks and converts the meshes of airybench.", "meshgen");
  Arguments arguments;
  declare(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::cout << app.help();
    return 0;
  } catch (const CLI::ParseError& error) {
    return complain(fmt::format("{} (valid: {})", error.what(), valid_options(app)), exit_usage);
  }
  try {
    return run(app, arguments);
  } catch (const std::invalid_argument& error) {
    return complain(error.what(), exit_usage);
  } catch (const std::exception& error) {
    return complain(error.what(), exit_failure);
  }
}
