#include "meshgen/convert.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <set>

#include "mesh/mend.hpp"
#include "mesh/model_format.hpp"
#include "mesh/msh_format.hpp"
#include "meshgen/geo_script.hpp"
#include "meshgen/gmsh_mesher.hpp"
#include "meshgen/open_model.hpp"
#include "meshgen/roles.hpp"
#include "meshgen/shown_model.hpp"

namespace airybench {
namespace {

[[noreturn]] void fail(const std::string& what) { throw InputError(what); }

Mesh mesh_of(const PlaneModel& model) {
  Mesh mesh;
  mesh.body_names = model.body_names;
  std::map<std::size_t, int> vertex;
  for (const auto& [node, p] : model.position) {
    vertex.emplace(node, static_cast<int>(mesh.vertices.size()));
    mesh.vertices.push_back(p);
  }
  for (const auto& [nodes, body, surface] : model.triangles) {
    mesh.triangles.push_back({vertex[nodes[0]], vertex[nodes[1]], vertex[nodes[2]]});
    mesh.triangle_body.push_back(body);
  }
  std::map<Nodes, const ModelCurve*> curve_of_side;  // a mesh is the same whatever its curves
  for (const ModelCurve& curve : model.curves)
    for (const Nodes& side : curve.sides) curve_of_side.emplace(side, &curve);
  for (const auto& [side, curve] : curve_of_side) {
    const BoundaryLabel label = *parse_boundary_label(curve->label);
    const auto bent = model.bent_sides.find(side);
    mesh.boundary.push_back({{vertex[side[0]], vertex[side[1]]},
                             label.role,
                             boundary_group(mesh, label.name),
                             bent == model.bent_sides.end() ? EdgeCurve() : bent->second});
  }
  return mesh;
}

// A curve with a role is on the boundary, and on no other curve with another role.
void check_curves(const PlaneModel& model) {
  std::map<Nodes, const ModelCurve*> curve_of_edge;
  for (const ModelCurve& curve : model.curves)
    for (const auto& [a, b] : curve.sides) {
      curve_of_edge.emplace(Nodes{a, b}, &curve);
      curve_of_edge.emplace(Nodes{b, a}, &curve);
    }
  for (const ModelCurve& curve : model.curves) {
    if (curve.label.empty()) continue;
    for (const Nodes& edge : curve.inner) {
      const auto other = curve_of_edge.find(edge);
      if (other != curve_of_edge.end() && other->second->label == curve.label) continue;
      if (other != curve_of_edge.end())
        fail(
            fmt::format("curve {}: an edge is in curve {} too, and their roles are {} and {}; one "
                        "role is allowed",
                        curve.number, other->second->number, curve.label, other->second->label));
      const auto a = model.position.find(edge[0]), b = model.position.find(edge[1]);
      if (a == model.position.end() || b == model.position.end())
        fail(fmt::format("physical curve '{}' has an edge that touches no triangle", curve.label));
      fail(
          fmt::format("physical curve '{}': edge from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}) is not "
                      "on the body's boundary but inside it (allowed: a role on curves of the "
                      "boundary; a hole, or bodies that this line parts and contacts join, make "
                      "one there)",
                      curve.label, a->second.x(), a->second.y(), b->second.x(), b->second.y()));
    }
  }
}

// By a displacement or by contact; else by points of the scene, if all curves are given a role.
void check_is_held(const PlaneModel& model, const ModelOptions& options) {
  if (options.roles.contains("rest")) return;
  std::set<std::string> others;
  for (const ModelCurve& curve : model.curves) {
    const BoundaryRole role = parse_boundary_label(curve.label)->role;
    if (!curve.sides.empty() && role != BoundaryRole::force) return;
    for (const std::string& name : curve.names)
      if (!parse_boundary_label(name) && curve.is_unnamed_role) others.insert("'" + name + "'");
  }
  fail(fmt::format(
      "no edges in a physical curve named displacement{}; --role=NUMBER=displacement "
      "holds one of its curves:\n{}",
      others.empty()
          ? ""
          : fmt::format(" (others found: {}; --role gives them one)", fmt::join(others, ", ")),
      table_of(model)));
}

// Pieces may press on each other, if all have contact edges.
void check_pieces(const PlaneModel& model) {
  std::map<std::size_t, std::size_t> parent;
  const auto root = [&](std::size_t node) {
    while (parent[node] != node) node = parent[node] = parent[parent[node]];
    return node;
  };
  for (const auto& [node, place] : model.position) parent.emplace(node, node);
  for (const ModelTriangle& triangle : model.triangles)
    for (const std::size_t node : triangle.nodes) parent[root(node)] = root(triangle.nodes[0]);
  struct Piece {
    std::set<int> surfaces;
    Eigen::AlignedBox2d box;
  };
  std::map<std::size_t, Piece> pieces;
  for (const ModelTriangle& triangle : model.triangles) {
    Piece& piece = pieces[root(triangle.nodes[0])];
    piece.surfaces.insert(triangle.surface);
    for (const std::size_t node : triangle.nodes) piece.box.extend(model.position.at(node));
  }
  std::set<std::size_t> in_contact;
  for (const ModelCurve& curve : model.curves)
    if (const auto label = parse_boundary_label(curve.label);
        label && label->role == BoundaryRole::contact)
      for (const Nodes& side : curve.sides) in_contact.insert(root(side[0]));
  if (pieces.size() < 2 || in_contact.size() == pieces.size()) return;
  std::multimap<int, Piece> by_surface;
  for (auto& [node, piece] : pieces) by_surface.emplace(*piece.surfaces.begin(), piece);
  constexpr std::size_t most = 6;
  std::vector<std::string> texts;
  for (const auto& [surface, piece] : by_surface)
    if (texts.size() < most)
      texts.push_back(fmt::format("surface {} from ({:.4g}, {:.4g}) to ({:.4g}, {:.4g})",
                                  fmt::join(piece.surfaces, ", "), piece.box.min().x(),
                                  piece.box.min().y(), piece.box.max().x(), piece.box.max().y()));
  fail(
      fmt::format("{} separate pieces, which do not join: {}{}; the body must be one (in Gmsh, "
                  "Coherence or BooleanFragments joins surfaces that touch or overlap; Delete, or "
                  "a Physical Surface of the others, removes one; or contact edges on every piece, "
                  "with contacts in the scene)",
                  pieces.size(), fmt::join(texts, "; "), pieces.size() > most ? "; …" : ""));
}

// As it is, if it is one of ours. Throws MeshError, with the line, if it is none and no other's.
std::optional<Mesh> own_mesh(const std::filesystem::path& file, const ModelOptions& options) {
  if (format_of(file) != ModelFormat::msh || is_gzipped(file)) return {};
  try {
    Mesh mesh = read_msh(file);
    if (text_of(options).empty()) return mesh;
  } catch (const ForeignMeshError&) {
  }
  return {};
}

PlaneModel open_and_read(const std::filesystem::path& file, const ModelOptions& options,
                         const AboutToMesh& about_to_mesh, std::vector<std::string>& notes) {
  const auto plane_model = [&](const ModelOptions& used) {
    notes.clear();
    const OpenModel open(file, used, about_to_mesh, notes);
    return read_plane_model(open.mm_per_unit(), notes);
  };
  PlaneModel model;
  try {
    model = plane_model(options);
  } catch (const FlatTriangleError& error) {  // of Gmsh, at sizes that differ very much
    if (options.algorithm) throw;
    ModelOptions with_1 = options;
    with_1.algorithm = 1;
    model = plane_model(with_1);
    notes.push_back(fmt::format("{}: meshed with Mesh.Algorithm=1", error.what()));
  }
  give_roles(model, options, notes);
  return model;
}

// What Gmsh's parser stumbles over may be of a later version.
std::string about_version(const std::string& message, const std::filesystem::path& file) {
  const bool is_of_parser =
      message.find("syntax error") != message.npos || message.find("nknown ") != message.npos;
  if (!is_of_parser) return "";
  std::string place;
  const std::size_t quote = message.find('\''), end = message.find('\'', quote + 1);
  if (message.find(", line ") == message.npos && end != message.npos) {
    std::string word = message.substr(quote + 1, end - quote - 1);
    if (const int line = line_with(file, word); line > 0) place = fmt::format(" in line {}", line);
  }
  return fmt::format("{} (read by Gmsh {}; a newer one may know it)", place, version_of_gmsh());
}

}  // namespace

PlaneModel read_model(const std::filesystem::path& file, const ModelOptions& options,
                      const AboutToMesh& about_to_mesh, std::vector<std::string>& notes) {
  const std::string place = file.string() + ": ";
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) throw MeshError(place + "no such file");
  try {
    return open_and_read(file, options, about_to_mesh, notes);
  } catch (const InputError& complaint) {
    const std::string why = complaint.what();  // reading the file itself: names it
    throw MeshError(why.starts_with(place) ? why : place + why);
  } catch (...) {
    const std::string message = message_of_gmsh();
    const bool starts_program = message.find("aborting system call") != message.npos;
    throw MeshError(
        place + "Gmsh: " + message +
        (starts_program ? " (a model may start no programs)" : about_version(message, file)));
  }
}

ConvertedModel convert_model(const std::filesystem::path& file, const ModelOptions& options,
                             const AboutToMesh& about_to_mesh) {
  if (std::optional<Mesh> own = own_mesh(file, options)) return {std::move(*own), {}};
  ConvertedModel converted;
  const PlaneModel model = read_model(file, options, about_to_mesh, converted.notes);
  Mesh& mesh = converted.mesh;
  try {
    check_pieces(model);
    refuse_misspelt_roles(model);
    check_curves(model);
    check_is_held(model, options);
    mesh = mesh_of(model);
  } catch (const InputError& complaint) {
    throw MeshError(file.string() + ": " + complaint.what());
  }
  mesh.name = file.string();  // for validate() to complain about
  validate(mesh);
  for (std::string& note : mend(mesh, model.mm_per_unit))
    converted.notes.push_back(std::move(note));
  mesh.name = model_name(file);
  return converted;
}

}  // namespace airybench
