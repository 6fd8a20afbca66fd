#include "bench/plan/new_scene.hpp"

#include <fmt/format.h>

#include "bench/commands/command_line.hpp"
#include "bench/commands/commands.hpp"
#include "support/called_as.hpp"
#include "support/errors.hpp"

namespace airybench {
namespace {

constexpr const char* new_scene_footer = R"(
The scene has the model's groups, a wall that each contact face just touches, the faces of arcs, pairs of faces that
touch, and values to fill in; for an input deck (.inp) it has what the deck prescribes.

Exit status  0  written
             2  wrong usage, a model that cannot be read, or a file that is there already: one line on standard
                error

Example
  {bench} new-scene part.geo --role=clamped=displacement
)";

}  // namespace

int new_scene_command(int argc, const char* const* argv) {
  std::filesystem::path model;
  std::vector<std::string> settings;
  CLI::App app("Writes a scene for a model, MODEL.json in this folder, for you to fill in.",
               "{bench} new-scene");
  app.footer(new_scene_footer);
  app.add_option("MODEL", model, "a model or an input deck")->required();
  add_model_settings(app, settings);
  parse_command_line(app, argc, argv);
  const std::string scene = write_new_scene(model, settings);
  fmt::print(
      "{0}: fill it in, then for its answer: {1} solve {2} {3}\n"
      "to compare methods: {1} --mesh={2} --scene={3}\n",
      scene, called_as("bench"), shell_word(model.string()), shell_word(scene));
  return all_ok;
}

}  // namespace airybench
