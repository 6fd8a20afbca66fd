// The `meshgen` command: see commands.hpp for what each mode does.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>

#include "mesh/model_format.hpp"
#include "mesh/model_settings.hpp"
#include "meshgen/complaints.hpp"
#include "meshgen/meshgen_commands.hpp"
#include "support/called_as.hpp"
#include "support/data_folder.hpp"
#include "support/lists.hpp"
#include "support/messages.hpp"
#include "support/numbers.hpp"
#include "support/sign_of_life.hpp"
#include "support/this_process.hpp"

namespace {

struct Arguments {
  std::string selection, model, to_show, deck, to_modify, out;
  bool check = false, tooth = false;
  std::string repository = airybench::data_folder("meshes");
  airybench::ToothDimensions dimensions;
  airybench::EdgeCounts edges;
  int vertices = 0;
  airybench::MeshTransform transform;
  std::vector<double> grade, slivers, stretch, move_mm, layers;
  std::vector<std::string> roles, parameters;
  std::string mesh_size, length_unit, model_time, model_memory;
};

constexpr std::array modes = {"--mesh", "--check", "--tooth", "--convert",
                              "--show", "--scene", "--modify"};

void declare_modify(CLI::App& app, CLI::Option* modify, Arguments& a) {
  const auto option = [&](const char* name, auto& value, const char* type, const char* help) {
    return app.add_option(name, value, help)
        ->needs(modify)
        ->type_name(type)
        ->group("With --modify, in this order");
  };
  const auto numbers = [&](const char* name, std::vector<double>& value, int count,
                           const char* type, const char* help) {
    option(name, value, type, help)->delimiter(',')->expected(count);
  };
  option("--refine", a.transform.refine, "K", "K times each triangle into four");
  numbers("--grade", a.grade, 3, "X,Y,RATIO",
          "Bisect at the vertex nearest to (X, Y) mm until edges there are RATIO times smaller");
  numbers("--slivers", a.slivers, 2, "ASPECT,COUNT",
          "A flat triangle of longest edge/height = ASPECT into COUNT triangles");
  option("--scale", a.transform.scale, "S", "All lengths times S");
  numbers("--stretch", a.stretch, 2, "SX,SY", "x times SX, y times SY");
  numbers("--move", a.move_mm, 2, "DX,DY", "Move by (DX, DY) mm");
  option("--keep-contact-edges", a.transform.keep_contact_edges, "N",
         "Only the middle N contact edges stay; the others become force edges");
  option("--keep-displacement-edges", a.transform.keep_displacement_edges, "N",
         "Only the middle N displacement edges stay; the others become force edges");
  option("--keep-force-edges", a.transform.keep_force_edges, "N",
         "Only the middle N force edges stay; the others become displacement edges");
  numbers("--layers", a.layers, 3, "NX,NY,COUNT",
          "COUNT layers of equal thickness in the direction (NX, NY) as bodies \"layer 1\", ...");
}

void declare_model_settings(CLI::App& app, Arguments& a) {
  const auto declare = [&](const airybench::ModelSetting& setting, auto& value) {
    return app.add_option(setting.option, value, setting.help)
        ->type_name(setting.type)
        ->group("With --convert, --show");  // the last two with --scene, too
  };
  declare(airybench::role_setting, a.roles)->allow_extra_args(false);
  declare(airybench::parameter_setting, a.parameters)->allow_extra_args(false);
  declare(airybench::mesh_size_setting, a.mesh_size);
  declare(airybench::length_unit_setting, a.length_unit);
  declare(airybench::model_time_setting, a.model_time);
  declare(airybench::model_memory_setting, a.model_memory);
}

void declare(CLI::App& app, Arguments& a) {
  const std::string what = "What to do, exactly one of";
  app.add_option(
         "--mesh", a.selection,
         "Make catalogue meshes again and compare them with the repository's: Mesh0..Mesh7, "
         "a list, a glob")
      ->type_name("MESHES")
      ->group(what);
  app.add_flag("--check", a.check, "Compare the repository's meshes with the paper's Tab. 1")
      ->group(what);
  auto* tooth =
      app.add_flag("--tooth", a.tooth, "Make a tooth or rack of given dimensions")->group(what);
  app.add_option("--convert", a.model,
                 "Make a mesh of a model: " + std::string(airybench::model_extensions))
      ->type_name("MODEL")
      ->group(what);
  app.add_option("--show", a.to_show,
                 "Print a model's curves as a table and draw them with their numbers")
      ->type_name("MODEL")
      ->group(what);
  app.add_option("--scene", a.deck, "Print what an input deck (.inp) prescribes as a scene")
      ->type_name("DECK")
      ->group(what);
  auto* modify =
      app.add_option("--modify", a.to_modify, "Change a mesh: a .msh file or one of Mesh0..Mesh7")
          ->type_name("MESH")
          ->group(what);

  app.add_option("--out", a.out,
                 "Where to write: a folder with --mesh; a .msh file with --tooth, --convert, "
                 "--modify (--convert: - is standard output); with --show a picture, MODEL.png by "
                 "default (- is what it shows, as JSON)")
      ->type_name("PATH");
  app.add_option("--meshes", a.repository, "Folder of the repository's meshes")
      ->envname("AIRYBENCH_MESH_DIR")
      ->type_name("DIR");

  const auto of_tooth = [&](const char* name, auto& value, const char* help) {
    return app.add_option(name, value, help)->needs(tooth)->group("With --tooth");
  };
  const auto count = [&](const char* name, int& value, const char* help) {
    return of_tooth(name, value, help)->check([](const std::string& text) {
      const auto number = airybench::parse_whole(text);  // CLI11 says what is none
      return !number || (*number >= 1 && *number <= 1'000'000)
                 ? ""
                 : fmt::format("Value {} not in range 1 to 1000000", text);
    });
  };
  const auto length = [&](const char* name, double& value, const char* help) {
    of_tooth(name, value, help)->type_name("MM")->capture_default_str();
  };
  count("--contact-edges", a.edges.contact, "Edges on the tips, all together");
  count("--force-edges", a.edges.force, "Edges on the free faces");
  count("--displacement-edges", a.edges.displacement, "Edges on the held face");
  count("--vertices", a.vertices, "Exact number of vertices (default: as many as Gmsh makes)");
  count("--teeth", a.dimensions.teeth, "1: a single tooth; more: a rack")->capture_default_str();
  length("--root-half-height", a.dimensions.root_half_height, "Half height of the root");
  length("--length", a.dimensions.length, "Length of a tooth");
  length("--tip-half-height", a.dimensions.tip_half_height, "Half height of the tip");
  length("--pitch", a.dimensions.pitch, "Distance between a rack's teeth");
  length("--block-depth", a.dimensions.block_depth, "Depth of a rack's block");
  declare_model_settings(app, a);
  declare_modify(app, modify, a);
}

// A count among numbers that may be fractions.
int whole(const char* name, double value) {
  if (!(value >= 1 && value <= 1e6) || value != std::floor(value))
    throw std::invalid_argument(fmt::format(
        "{}: {}: a whole number from 1 to 1000000 is needed for its count", name, value));
  return static_cast<int>(value);
}

// The transformation that the options of --modify ask for.
airybench::MeshTransform transform_of(const Arguments& a) {
  airybench::MeshTransform transform = a.transform;
  if (!a.grade.empty()) transform.grade = {{a.grade[0], a.grade[1]}, a.grade[2]};
  if (!a.slivers.empty()) transform.slivers = {a.slivers[0], whole("--slivers", a.slivers[1])};
  if (!a.stretch.empty()) transform.stretch = {a.stretch[0], a.stretch[1]};
  if (!a.move_mm.empty()) transform.move_mm = {a.move_mm[0], a.move_mm[1]};
  return transform;
}

airybench::Layers layers_of(const Arguments& a) {
  airybench::Layers layers;
  if (a.layers.empty()) return layers;
  layers.normal = {a.layers[0], a.layers[1]};
  layers.count = whole("--layers", a.layers[2]);
  return layers;
}

// Everything CLI11 cannot say about the arguments.
void check_usage(const CLI::App& app, const Arguments& a) {
  const auto given = std::count_if(modes.begin(), modes.end(),
                                   [&](const char* mode) { return app.count(mode) > 0; });
  if (given != 1)
    throw std::invalid_argument(fmt::format("exactly one of {} is needed ({} given); see --help",
                                            fmt::join(modes, ", "), given));
  const bool writes_a_file = a.tooth || app.count("--convert") > 0 || app.count("--modify") > 0;
  if (writes_a_file && a.out.empty())
    throw std::invalid_argument(
        "--out is missing; --tooth, --convert and --modify write the file it names");
  const bool to_stdout = a.out == "-" && app.count("--convert") > 0;
  if (writes_a_file && !to_stdout && !a.out.ends_with(".msh"))
    throw std::invalid_argument(
        fmt::format("--out: '{}'; a file name ending in .msh is needed", a.out));
  if (!a.to_show.empty() && !a.out.empty() && a.out != "-" && !a.out.ends_with(".png"))
    throw std::invalid_argument(
        fmt::format("--out: '{}'; a file name ending in .png is needed, or -", a.out));
  for (const airybench::ModelSetting& setting : airybench::model_settings)
    if (app.count(setting.option) > 0 && a.model.empty() && a.to_show.empty() &&
        (a.deck.empty() || !airybench::is_model_limit(setting.option)))
      throw std::invalid_argument(fmt::format("{}: it needs --convert or --show", setting.option));
  if (a.check && app.count("--out") > 0)
    throw std::invalid_argument("--out does not go with --check, which writes nothing");
  if (!a.tooth) return;
  for (const char* name : {"--contact-edges", "--force-edges", "--displacement-edges"})
    if (app.count(name) == 0)
      throw std::invalid_argument(fmt::format(
          "{} is missing; --tooth needs --contact-edges, --force-edges, --displacement-edges",
          name));
}

std::string subject_of(const Arguments& a) {
  for (const std::string& given : {a.model, a.to_show, a.deck, a.to_modify, a.selection})
    if (!given.empty()) return given;
  return a.tooth ? a.out : "the repository's meshes";
}

int run(const CLI::App& app, const Arguments& a) {
  check_usage(app, a);
  const airybench::SignsOfLife signs("meshgen works on " + subject_of(a));
  if (a.check) return airybench::check_command(a.repository);
  if (a.tooth)
    return airybench::tooth_command(
        a.dimensions, a.edges,
        app.count("--vertices") > 0 ? std::optional(a.vertices) : std::nullopt, a.out);
  airybench::ModelOptions options =
      airybench::model_options_of(a.roles, a.parameters, a.mesh_size, a.length_unit);
  options.limits = airybench::model_limits_of(a.model_time, a.model_memory);
  if (app.count("--convert") > 0) return airybench::convert_command(a.model, options, a.out);
  if (app.count("--show") > 0)
    return airybench::show_command(
        a.to_show, options, a.out.empty() ? airybench::model_name(a.to_show) + ".png" : a.out);
  if (app.count("--scene") > 0) return airybench::scene_command(a.deck, options);
  if (app.count("--modify") > 0)
    return airybench::modify_command(a.to_modify, a.repository, transform_of(a), layers_of(a),
                                     a.out);
  return airybench::remake_command(
      a.selection, a.repository,
      a.out.empty() ? std::nullopt : std::optional<std::filesystem::path>(a.out));
}

std::vector<std::string> valid_options(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) names.push_back(option->get_name());
  return names;
}

int parse_and_run(int argc, char** argv) {
  CLI::App app("Makes, checks and converts the meshes of airybench.", "{meshgen}");
  Arguments arguments;
  declare(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::cout << airybench::with_commands(app.help());
    return 0;
  } catch (const CLI::ParseError& error) {
    const std::vector<std::string> valid = valid_options(app), unexpected = app.remaining();
    return airybench::complain(
        fmt::format(
            "{}{} (valid: {})", error.what(),
            unexpected.empty()
                ? ""
                : airybench::perhaps(airybench::first_item(unexpected.front(), '=').item, valid),
            fmt::join(valid, ", ")),
        airybench::exit_usage);
  }
  return run(app, arguments);
}

}  // namespace

int main(int argc, char** argv) {
  airybench::open_standard_streams();
  const auto whole_run = [&] {
    airybench::show_messages_escaped();
    return parse_and_run(argc, argv);
  };
  return airybench::checked_exit_code(airybench::complained(whole_run), "meshgen");
}
