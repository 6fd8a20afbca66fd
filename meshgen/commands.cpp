#include "meshgen/meshgen_commands.hpp"

#include <fmt/format.h>

#include "mesh/model_format.hpp"
#include "mesh/msh_format.hpp"
#include "mesh/selection.hpp"
#include "meshgen/catalogue.hpp"
#include "meshgen/checksums.hpp"
#include "meshgen/convert.hpp"
#include "meshgen/deck_scene.hpp"
#include "meshgen/gmsh_input.hpp"
#include "meshgen/gmsh_mesher.hpp"
#include "meshgen/in_a_child.hpp"
#include "meshgen/last_words.hpp"
#include "meshgen/mesh_cache.hpp"
#include "meshgen/mesh_check.hpp"
#include "meshgen/shown_model.hpp"
#include "meshgen/tooth_mesh.hpp"
#include "support/atomic_file.hpp"
#include "support/data_folder.hpp"
#include "support/file_text.hpp"
#include "support/messages.hpp"
#include "support/process.hpp"
#include "support/sha256.hpp"
#include "support/temporary_folder.hpp"

namespace airybench {
namespace {

void print_summary(const std::filesystem::path& file, const Mesh& mesh) {
  const MeshSizes sizes = mesh_sizes(mesh);
  const MeshQuality quality = mesh_quality(mesh);
  fmt::print(
      "{}: n_phi {}, n_f {}, n_C {}; edges displacement {}, force {}, contact {}; vertices {}, "
      "triangles {}, bodies {}; smallest angle {:.2f} degrees, mean ratio min {:.3f} mean {:.3f}\n",
      file.string(), sizes.n_phi, sizes.n_f, sizes.n_c, sizes.displacement_edges, sizes.force_edges,
      sizes.contact_edges, mesh.vertices.size(), mesh.triangles.size(), mesh.body_names.size(),
      quality.smallest_angle_deg, quality.min_mean_ratio, quality.mean_mean_ratio);
}

void print_notes(const std::filesystem::path& model, const std::vector<std::string>& notes) {
  for (const std::string& note : notes) fmt::print(stderr, "note: {}: {}\n", model.string(), note);
}

std::string last_line_of(std::string text) {
  while (text.ends_with('\n')) text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

constexpr const char* curves_file = "curves.json";

void draw_curves(const std::filesystem::path& curves_json, const std::filesystem::path& out) {
  constexpr double time_limit_s = 300;
  const std::filesystem::path drawing = data_folder("plots") / "curves.py";
  const ProgramEnd end = run_program("/usr/bin/env",
                                     {"PATH=/usr/bin:/bin:/usr/local/bin", "python3",
                                      drawing.string(), "--", curves_json.string(), out.string()},
                                     time_limit_s);
  if (end.exit_code != 0)
    throw FileError(fmt::format("{}: no picture (Debian: python3-matplotlib, python3-pandas): {}",
                                out.string(), last_line_of(end.err)));
  fmt::print("picture: {}\n", out.string());
}

}  // namespace

int remake_command(const std::string& selection, const std::filesystem::path& repository,
                   const std::optional<std::filesystem::path>& out) {
  const std::vector<std::string> names = expand_mesh_selection(selection);
  for (const std::string& name : names)
    if (is_mesh_file(name))
      throw std::invalid_argument(
          fmt::format("--mesh: '{}' is a file; only Mesh0..Mesh7 can be made again", name));
  if (out) std::filesystem::create_directories(*out);

  const GmshSession session;
  bool all_identical = true;
  for (const std::string& name : names) {
    const std::string text = msh_text(make_catalogue_mesh(catalogue_row(name)));
    const std::string hash = sha256_hex(text);
    const std::filesystem::path file = repository / (name + ".msh");
    const bool present = std::filesystem::exists(file);
    const bool identical = present && sha256_of_file(file) == hash;
    all_identical = all_identical && identical;
    fmt::print("{}  {}  {}\n", name, hash,
               identical ? "identical" : (present ? "differs from " : "missing: ") + file.string());
    std::fflush(stdout);
    if (out) write_file_atomically(*out / (name + ".msh"), text);
  }
  if (out) write_file_atomically(*out / checksums_file_name, checksums_of_folder(*out));
  if (!all_identical)
    fmt::print("The catalogue was made with Gmsh {}; this library is Gmsh {}.\n",
               catalogue_gmsh_version, gmsh_version());
  return all_identical ? 0 : 1;
}

int check_command(const std::filesystem::path& repository) {
  const std::vector<CheckedMesh> meshes = check_folder(repository);
  fmt::print(
      "            |     n_phi     |    n_f    |    n_C    |               |     edges on     |"
      " smallest |  mean ratio\n"
      "mesh  teeth |  ours  Tab. 1 | ours Tab.1| ours Tab.1|     V    tri. | disp force cont. |"
      "    angle |   min   mean\n");
  bool fine = true;
  for (const CheckedMesh& mesh : meshes) {
    const CatalogueRow& row = *mesh.row;
    fmt::print(
        "{:<6}{:>5} | {:>5}  {:>6} | {:>4} {:>4} | {:>4} {:>4} | {:>5}  {:>6} | {:>4} {:>5} {:>5} |"
        " {:>8.2f} | {:>5.3f}  {:>5.3f}\n",
        row.name, row.teeth, mesh.sizes.n_phi, row.paper_n_phi, mesh.sizes.n_f, row.paper_n_f,
        mesh.sizes.n_c, row.paper_n_c, mesh.vertices, mesh.triangles, mesh.sizes.displacement_edges,
        mesh.sizes.force_edges, mesh.sizes.contact_edges, mesh.quality.smallest_angle_deg,
        mesh.quality.min_mean_ratio, mesh.quality.mean_mean_ratio);
    fine = fine && mesh.differences.empty();
  }
  fmt::print(
      "Angles in degrees; mean ratio 4 sqrt(3) area / (sum of squared edges), 1 is equilateral.\n"
      "Mesh0: Tab. 1 prints n_C = {}, which is no multiple of 4 (4 per contact edge); the mesh has "
      "{}.\n",
      catalogue[0].paper_n_c, mesh0_n_c);
  for (const CheckedMesh& mesh : meshes)
    for (const std::string& difference : mesh.differences) fmt::print("{}\n", difference);
  fmt::print("{}\n", fine ? "All meshes are as they should be." : "Some meshes differ.");
  return fine ? 0 : 1;
}

int tooth_command(const ToothDimensions& dimensions, const EdgeCounts& edges,
                  std::optional<int> vertices, const std::filesystem::path& out) {
  const GmshSession session;
  const Mesh mesh = tooth_mesh(dimensions, edges, vertices, out.stem().string());
  write_file_atomically(out, msh_text(mesh));
  print_summary(out, mesh);
  return 0;
}

int convert_command(const std::filesystem::path& model, const ModelOptions& options,
                    const std::filesystem::path& out) {
  constexpr const char *made = "made.msh", *place = "cached_file";
  std::optional<ConvertedModel> converted;
  const auto convert = [&](const ModelOptions& used, const AboutToMesh& about_to_mesh,
                           const std::filesystem::path& folder) {
    const LastWords last_words(model.string());
    const std::filesystem::path kept = cached_file(model, options);
    write_file_atomically(folder / place, kept.string());
    if (!kept.empty() && cached_model(kept)) return;
    if (const auto why_not = keep_model(folder / made, convert_model(model, used, about_to_mesh)))
      throw FileError(*why_not);
  };
  const auto take = [&](const std::filesystem::path& folder) {
    const std::filesystem::path kept = file_text(folder / place);
    const bool is_made = std::filesystem::exists(folder / made);
    converted = cached_model(is_made ? folder / made : kept);
    if (!converted) throw FileError(model.string() + ": the mesh that was made cannot be read");
    if (!is_made || kept.empty()) return;
    if (const auto why_not = keep_model(kept, *converted))
      fmt::print(stderr, "note: the mesh is not kept for next time: {}\n", *why_not);
  };
  if (const int code = in_a_child(model, options, convert, take); code != 0) return code;
  print_notes(model, converted->notes);
  if (out == "-") {
    print_data(msh_text(converted->mesh));
    return 0;
  }
  write_file_atomically(out, msh_text(converted->mesh));
  print_summary(out, converted->mesh);
  return 0;
}

int show_command(const std::filesystem::path& model, const ModelOptions& options,
                 const std::filesystem::path& out) {
  const auto show = [&](const ModelOptions& used, const AboutToMesh& about_to_mesh,
                        const std::filesystem::path& folder) {
    const LastWords last_words(model.string());
    std::vector<std::string> notes;
    ModelOptions all_shown = used;
    all_shown.roles.emplace("rest", "force");  // the table tells which are free
    const PlaneModel plane = read_model(model, all_shown, about_to_mesh, notes);
    print_notes(model, notes);
    const std::string json = json_of(plane, model_name(model));
    if (out == "-")
      print_data(json + "\n");
    else
      fmt::print("{}\n", table_of(plane));
    write_file_atomically(folder / curves_file, json);
  };
  const auto draw = [&](const std::filesystem::path& folder) {
    if (out != "-") draw_curves(folder / curves_file, out);
  };
  return in_a_child(model, options, show, draw);
}

int scene_command(const std::filesystem::path& deck, const ModelOptions& options) {
  if (format_of(deck) != ModelFormat::abaqus)
    throw std::invalid_argument(fmt::format("--scene: '{}' (allowed: an .inp)", deck.string()));
  const auto print = [&](const ModelOptions&, const AboutToMesh&, const std::filesystem::path&) {
    try {
      const std::optional<DeckScene> scene = scene_of(read_deck_of(deck));
      if (!scene) return;
      print_notes(deck, scene->notes);
      print_data(scene->json);
    } catch (const FileError&) {
      throw;
    } catch (const InputError& error) {
      throw FileError(fmt::format("{}: {}", deck.string(), error.what()));
    }
  };
  return in_a_child(deck, options, print, [](const std::filesystem::path&) {});
}

int modify_command(const std::string& name, const std::filesystem::path& repository,
                   const MeshTransform& transform, const Layers& layers,
                   const std::filesystem::path& out) {
  const std::vector<std::string> selected = expand_mesh_selection(name);
  if (selected.size() != 1)
    throw std::invalid_argument(
        fmt::format("--modify: '{}' are {} meshes; one is needed", name, selected.size()));
  const std::string& mesh_name = selected.front();
  Mesh mesh = read_msh(is_mesh_file(mesh_name) ? std::filesystem::path(mesh_name)
                                               : repository / (mesh_name + ".msh"));
  mesh = layered(transformed(std::move(mesh), transform), layers);
  mesh.name = out.stem().string();
  write_file_atomically(out, msh_text(mesh));
  print_summary(out, mesh);
  return 0;
}

}  // namespace airybench
