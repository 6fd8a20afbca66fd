#include "bench/commands/run_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <set>

#include "bench/plan/face_curves.hpp"
#include "bench/plan/mesh_files.hpp"
#include "bench/plan/stages.hpp"
#include "bench/problems/problem_files.hpp"
#include "mesh/model_format.hpp"
#include "mesh/model_settings.hpp"
#include "mesh/quality.hpp"
#include "mesh/selection.hpp"
#include "support/called_as.hpp"
#include "support/errors.hpp"
#include "support/sha256.hpp"
#include "support/shortened.hpp"
#include "support/sign_of_life.hpp"

namespace airybench {
namespace {

namespace fs = std::filesystem;

// Of the only mesh, if it is an input deck with one.
std::optional<SceneFile> scene_of_own_deck(const RunSettings& run) {
  const std::vector<std::string> items = expand_mesh_selection(run.meshes);
  if (items.size() != 1 || !std::ranges::all_of(run.model_settings, is_model_limit) ||
      !is_mesh_file(items.front()) || format_of(items.front()) != ModelFormat::abaqus)
    return {};
  const std::string text = scene_of_deck(items.front(), run.model_settings);
  if (text.empty()) return {};
  SceneFile own = scene_file_of(text, items.front());
  own.scene.name = model_name(items.front());
  return own;
}

void note_unused_deck(const RunSettings& run) {
  for (const std::string& item : expand_mesh_selection(run.meshes))
    if (is_mesh_file(item) && format_of(item) == ModelFormat::abaqus)
      std::cerr << fmt::format(
          "note: {}: its mesh alone is read; materials, supports, loads and contact are the "
          "scene's\n",
          item);
}

void note_out_of_reach(const PosedScene& posed) {
  const Mesh& mesh = posed.body()->mesh;
  if (const int free = edges_out_of_reach(*posed.body()); free > 0)
    std::cerr << fmt::format("note: {}/{}: {} of {} contact edges are free: {} within reach\n",
                             mesh.name, posed.scene_name, free,
                             free + mesh_sizes(mesh).contact_edges,
                             posed.body()->opposite.empty() ? "no wall" : "no other body or wall");
}

void note_matching(const PosedScene& posed) {
  const Problem::Matching& matching = posed.body()->matching;
  if (matching.inserted + matching.moved > 0)
    std::cerr << fmt::format(
        "note: {}/{}: faces in contact are matched: {} vertices inserted, {} moved, "
        "smallest angle {:.1f}°\n",
        posed.body()->mesh.name, posed.scene_name, matching.inserted, matching.moved,
        mesh_quality(posed.body()->mesh).smallest_angle_deg);
}

void note_no_wall(const Mesh& mesh, const Scene& scene) {
  if (scene.wall || scene.crown_radius_mm) return;
  std::set<std::string> without;
  for (const BoundaryEdge& edge : mesh.boundary) {
    if (edge.role != BoundaryRole::contact) continue;
    const std::string label = boundary_label(mesh, edge);
    const auto values = scene.boundary.find(label);
    if (is_paired(scene, label)) continue;
    if (values == scene.boundary.end() || !values->second.contact.wall) without.insert(label);
  }
  if (!without.empty())
    std::cerr << fmt::format("note: {}/{}: {}: no wall given, so the wall lies on the edges\n",
                             mesh.name, scene.name, fmt::join(without, ", "));
}

void note_polygons(const Mesh& mesh, const Scene& scene) {
  for (const auto& [label, degrees] : corners_of_curves(mesh, scene))
    std::cerr << fmt::format(
        "note: {}/{}: {}: a polygon with {} corners of up to {:.2g} degrees, each a peak of stress "
        "(for "
        "a curve give its \"face\")\n",
        mesh.name, scene.name, label, degrees.size(), std::ranges::max(degrees));
}

// A folder stands for its files of contact problems. Throws UsageError if it has none.
std::vector<fs::path> problem_files_of(const std::vector<fs::path>& given) {
  std::vector<fs::path> files;
  for (const fs::path& path : given) {
    std::error_code error;
    if (!fs::is_directory(path, error)) {
      files.push_back(path);
      continue;
    }
    std::vector<fs::path> inside;
    for (const fs::directory_entry& entry : fs::directory_iterator(path, error))
      if (const fs::path end = entry.path().extension();
          end == ".hdf5" || end == ".h5" || end == ".dat")
        inside.push_back(entry.path());
    if (inside.empty())
      throw UsageError(
          fmt::format("--problem: {} (allowed: a folder with .hdf5, .h5 or .dat files)",
                      shortened(path.string())));
    std::ranges::sort(inside);
    files.insert(files.end(), inside.begin(), inside.end());
  }
  return files;
}

std::vector<PosedScene> posed_problems(const Options& options) {
  std::vector<PosedScene> posed;
  for (const fs::path& file : problem_files_of(options.run.problems)) {
    const TimeLimit limit = phase_limit(file.string() + ": reading it", options.limits);
    auto problem = std::make_shared<const contact::Problem>(read_contact_problem(file));
    const auto same = [&](const PosedScene& p) { return mesh_name_of(p.problem) == problem->name; };
    if (!is_name(problem->name) || std::ranges::any_of(posed, same))
      throw UsageError(
          fmt::format("--problem: {} (allowed: problems whose names differ, in UTF-8 without "
                      "control characters: of their case, or else of their file)",
                      shortened(file.string())));
    posed.push_back({"fclib", "", recorded_path(file, options.output.folder), sha256_of_file(file),
                     "{}", std::move(problem)});
  }
  return posed;
}

bool is_newer(const fs::path& file, const fs::path& than) {
  std::error_code error;
  return fs::exists(file, error) &&
         fs::last_write_time(file, error) >= fs::last_write_time(than, error);
}

// Pictures and files for ParaView of a case with fields; of a path of load steps also how it moves.
std::string pictures_of(const std::string& name, bool is_path, const fs::path& out) {
  const fs::path grid = out / "fields" / (name + ".vtu"),
                 shown = is_path ? out / "fields" / (name + ".pvd") : grid,
                 picture = out / "figures" / ((is_path ? "load_path_" : "fields_") + name + ".png");
  if (std::error_code error; !fs::exists(grid, error)) return "";
  const std::string draw = called_as("run") + " figures " + file_operand(out.string());
  const std::string moving =
      is_path ? fmt::format("numbers of every step: {}\nmoving picture: {} --animate\n",
                            (out / "fields" / (name + ".steps.csv")).string(), draw)
              : "";
  if (is_drawn_by_caller() || is_newer(picture, grid))
    return fmt::format("picture: {}  (ParaView: {})\n{}", picture.string(), shown.string(), moving);
  return fmt::format("ParaView: {}  (a picture: {})\n{}", shown.string(), draw, moving);
}

// Of the last body outside the catalogue, or else with load steps.
std::string picture_line(const RunResult& result, const fs::path& out, bool has_fields) {
  const auto mesh_of = [](const std::string& name) { return name.substr(0, name.find('/')); };
  const auto last_mesh = [&](const auto& is_meant) -> std::string {
    for (std::size_t k = result.names.size(); k-- > 0;)
      if (result.record(k).n_phi && is_meant(k)) return mesh_of(result.names[k]);
    return "";
  };
  const auto is_path = [&](std::size_t k) { return result.record(k).load_steps.value_or(1) > 1; };
  std::string mesh =
      last_mesh([&](std::size_t k) { return !is_named_after_catalogue(mesh_of(result.names[k])); });
  if (mesh.empty() && has_fields) mesh = last_mesh(is_path);
  if (mesh.empty()) return "";
  for (std::size_t k = 0; k < result.names.size(); ++k) {
    if (!has_fields || mesh_of(result.names[k]) != mesh) continue;
    const std::string line = pictures_of(name_of(result.record(k)).file(), is_path(k), out);
    if (!line.empty()) return line;
  }
  return fmt::format("for a picture of {}: --fields\n", mesh);
}

}  // namespace

std::vector<SceneFile> read_scenes(const RunSettings& run) {
  std::vector<SceneFile> scenes;
  for (const fs::path& file : run.scenes.empty() ? scenes_of(run.study) : run.scenes) {
    SceneFile added = read_scene_file(file);
    const Scene& scene = added.scene;
    for (const SceneFile& other : scenes)
      if (other.scene.name == scene.name)
        throw UsageError(fmt::format("--scene: two scenes are named {}: {} and {}", scene.name,
                                     other.scene.source, scene.source));
    scenes.push_back(std::move(added));
  }
  if (scenes.empty())
    if (std::optional<SceneFile> own = scene_of_own_deck(run)) return {std::move(*own)};
  if (scenes.empty() && run.needs_scene && is_mesh_file(run.meshes))
    throw UsageError(
        fmt::format("{}: a SCENE is needed ({} bench new-scene {} writes one to fill in)",
                    shortened(run.meshes), called_as("run"), shell_word(run.meshes)));
  note_unused_deck(run);
  if (scenes.empty()) scenes.emplace_back();
  return scenes;
}

std::vector<PosedScene> posed_scenes(const Options& options) {
  return options.run.problems.empty() ? posed_scenes(options, read_scenes(options.run))
                                      : posed_problems(options);
}

std::vector<PosedScene> posed_scenes(const Options& options, std::vector<SceneFile> scenes) {
  if (options.run.equal_steps)
    for (SceneFile& file : scenes) file = in_equal_steps(std::move(file), *options.run.equal_steps);
  const SignsOfLife signs("reading " + shortened(options.run.meshes));
  std::vector<PosedScene> posed;
  std::map<std::vector<std::string>, std::vector<MeshFile>> meshes;  // by the scenes' settings
  for (const SceneFile& given : scenes)
    if (const auto settings = given.model_settings(); !meshes.contains(settings))
      meshes.emplace(settings, read_meshes(options.run, options.output.folder, settings));
  for (std::size_t k = 0; k < meshes.begin()->second.size(); ++k)
    for (const SceneFile& given : scenes) {
      const MeshFile& file = meshes.at(given.model_settings())[k];
      const SceneFile on_body = is_of_catalogue(file.path) ? given : on_other_bodies(given);
      const Scene& scene = on_body.scene;
      posed.push_back({scene.name, scene.group, recorded_path(file.path, options.output.folder),
                       file.sha256, on_body.definition(),
                       pose_in_time(scene, scene.name, file.mesh, options.limits)});
      note_out_of_reach(posed.back());
      note_matching(posed.back());
      if (!is_of_catalogue(file.path)) {
        note_no_wall(file.mesh, scene);
        note_polygons(file.mesh, scene);
      }
    }
  for (const MeshFile& file : meshes.begin()->second)
    for (const std::string& note : file.notes)
      std::cerr << fmt::format("note: {}: {}\n", file.path.string(), note);
  if (!options.dry_run)
    for (const auto& [settings, files] : meshes) keep_models(files);
  return posed;
}

PosedScene one_posed_scene(const Options& options) {
  std::vector<PosedScene> posed = posed_scenes(options);
  if (posed.size() != 1)
    throw UsageError(fmt::format("--mesh: {}: {} meshes (allowed: one)",
                                 shortened(options.run.meshes), posed.size()));
  return std::move(posed.front());
}

bool is_named_after_catalogue(const std::string& mesh) {
  const std::string body = mesh.substr(0, mesh.find('+'));
  return std::ranges::find(catalogue_mesh_names, body) != catalogue_mesh_names.end();
}

bool is_drawn_by_caller() {
  const char* const file = std::getenv("AIRYBENCH_TO_DRAW");
  return file != nullptr && *file != '\0';
}

bool leave_to_draw(const fs::path& out, const std::vector<std::string>& options) {
  if (!is_drawn_by_caller()) return false;
  std::ofstream file(std::getenv("AIRYBENCH_TO_DRAW"), std::ios::binary);
  for (const std::string& option : options) file << option << '\0';
  file << "--" << '\0' << out.string() << '\0';
  return static_cast<bool>(file.flush());
}

void end_run(const RunResult& result, const fs::path& out, bool has_fields) {
  bool any_figure = false;  // of bodies, and of the study of contact problems
  for (std::size_t k = 0; k < result.names.size() && !any_figure; ++k) {
    const Record record = result.record(k);
    any_figure = record.n_phi.has_value() || !record.study.empty();
  }
  if (any_figure) leave_to_draw(out);
  fmt::print("{}", picture_line(result, out, has_fields));
}

}  // namespace airybench
