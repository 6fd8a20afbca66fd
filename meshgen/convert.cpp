#include "meshgen/convert.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "mesh/model_format.hpp"
#include "mesh/msh_format.hpp"
#include "meshgen/gmsh_mesher.hpp"
#include "meshgen/open_model.hpp"

namespace airybench {
namespace {

using Nodes = std::array<std::size_t, 2>;  // Gmsh node numbers of an edge, in walking order

// The elements of our two kinds as Gmsh numbers them.
struct GmshTriangle {
  std::array<std::size_t, 3> nodes;
  int body;
};
struct GmshModel {
  std::map<std::size_t, std::array<double, 3>> position;  // of the nodes in use
  std::vector<GmshTriangle> triangles;
  std::vector<std::string> body_names;
  std::map<Nodes, std::string> label_of_line;  // "force", "force:top"
  std::vector<std::string> other_curves;       // physical curves without a role
  bool is_reduced = false;                     // from elements of higher order
};

[[noreturn]] void fail(const std::string& what) { throw MeshError(what); }

std::string list_of(const std::vector<std::string>& other_groups) {
  if (other_groups.empty()) return "";
  return fmt::format(" (others found: {}; --role gives them one)", fmt::join(other_groups, ", "));
}

std::vector<int> entities_of(int dimension, int group) {
  std::vector<int> entities;
  gmsh::model::getEntitiesForPhysicalGroup(dimension, group, entities);
  return entities;
}

// Node numbers of the corners of an entity's elements, which must all have so many.
std::vector<std::size_t> corners_of(GmshModel& model, int dimension, int entity,
                                    std::size_t corners, std::string_view allowed) {
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> elements, nodes;
  gmsh::model::mesh::getElements(types, elements, nodes, dimension, entity);
  std::vector<std::size_t> kept;
  for (std::size_t k = 0; k < types.size(); ++k) {
    std::string type_name;
    int type_dimension, order, node_count, primary_nodes;
    std::vector<double> local;
    gmsh::model::mesh::getElementProperties(types[k], type_name, type_dimension, order, node_count,
                                            local, primary_nodes);
    if (static_cast<std::size_t>(primary_nodes) != corners)
      fail(fmt::format("{} {} has elements '{}'; only {} are allowed",
                       dimension == 1 ? "curve" : "surface", entity, type_name, allowed));
    model.is_reduced = model.is_reduced || order > 1;
    const auto stride = static_cast<std::size_t>(node_count);
    for (std::size_t first = 0; first < nodes[k].size(); first += stride)
      for (std::size_t corner = 0; corner < corners; ++corner)
        kept.push_back(nodes[k][first + corner]);
  }
  return kept;
}

void check_name(const std::string& name, std::string_view what, int group) {
  if (name.find_first_of("\"\n") != name.npos)
    fail(fmt::format("{} {}: its name must not hold quotes or line ends", what, group));
}

void read_triangles(GmshModel& model) {
  gmsh::vectorpair groups;
  gmsh::model::getPhysicalGroups(groups, 2);
  if (groups.empty())
    fail("no physical surface; at least one is needed (one per body; any name is allowed)");
  std::map<int, int> group_of_surface;
  for (const auto& [dimension, group] : groups) {
    std::string name;
    gmsh::model::getPhysicalName(2, group, name);
    if (name.empty()) name = groups.size() == 1 ? "body" : fmt::format("body{}", group);
    check_name(name, "physical surface", group);
    const auto known = std::find(model.body_names.begin(), model.body_names.end(), name);
    const int body = static_cast<int>(known - model.body_names.begin());
    if (known == model.body_names.end()) model.body_names.push_back(name);
    for (const int surface : entities_of(2, group)) {
      if (!group_of_surface.emplace(surface, group).second)
        fail(fmt::format("surface {} is in the physical surfaces {} and {}; one body is allowed",
                         surface, group_of_surface[surface], group));
      const auto nodes = corners_of(model, 2, surface, 3, "triangles (without Recombine in Gmsh)");
      for (std::size_t k = 0; k < nodes.size(); k += 3)
        model.triangles.push_back({{nodes[k], nodes[k + 1], nodes[k + 2]}, body});
    }
  }
  if (model.triangles.empty()) {
    std::string reason;
    gmsh::logger::getLastError(reason);
    fail("its physical surfaces hold no triangles" + (reason.empty() ? "" : "; Gmsh: " + reason));
  }
}

// The labels of physical curves by the options: each name there must be one of the model's.
class Roles {
 public:
  explicit Roles(const ModelOptions& options) : options_(options), unused_(options.roles) {}

  std::string label_of(const std::string& name) {
    names_.push_back("'" + name + "'");
    unused_.erase(name);
    const auto found = options_.roles.find(name);
    return found == options_.roles.end() ? name : found->second;
  }
  void check_all_used() const {
    if (unused_.empty()) return;
    fail(fmt::format("--role: it has no physical curve '{}' (its physical curves: {})",
                     unused_.begin()->first,
                     names_.empty() ? "none" : fmt::format("{}", fmt::join(names_, ", "))));
  }

 private:
  const ModelOptions& options_;
  std::map<std::string, std::string> unused_;
  std::vector<std::string> names_;
};

void read_lines(GmshModel& model, const ModelOptions& options) {
  gmsh::vectorpair groups;
  gmsh::model::getPhysicalGroups(groups, 1);
  Roles roles(options);
  for (const auto& [dimension, group] : groups) {
    std::string name;
    gmsh::model::getPhysicalName(1, group, name);
    if (name.empty()) name = std::to_string(group);
    const std::string label = roles.label_of(name);
    if (!parse_boundary_label(label)) {
      model.other_curves.push_back("'" + name + "'");
      continue;
    }
    check_name(label, "physical curve", group);
    for (const int curve : entities_of(1, group)) {
      const auto nodes = corners_of(model, 1, curve, 2, "lines");
      for (std::size_t k = 0; k < nodes.size(); k += 2) {
        const auto [entry, is_new] = model.label_of_line.emplace(
            Nodes{std::min(nodes[k], nodes[k + 1]), std::max(nodes[k], nodes[k + 1])}, label);
        if (!is_new)
          fail(fmt::format(
              "curve {}: an edge is in the physical curves {} and {}; one role is allowed", curve,
              entry->second, label));
      }
    }
  }
  roles.check_all_used();
  if (std::none_of(model.label_of_line.begin(), model.label_of_line.end(), [](const auto& line) {
        return parse_boundary_label(line.second)->role == BoundaryRole::displacement;
      }))
    fail(fmt::format(
        "no edges in a physical curve named displacement{}; it is needed, force and contact are "
        "allowed",
        list_of(model.other_curves)));
}

// Positions of the triangles' nodes; refuses a model that is not in a plane z = constant.
void read_positions(GmshModel& model) {
  std::vector<std::size_t> nodes;
  std::vector<double> xyz, parameters;
  gmsh::model::mesh::getNodes(nodes, xyz, parameters, -1, -1, false, false);
  std::map<std::size_t, std::size_t> row_of_node;
  for (std::size_t row = 0; row < nodes.size(); ++row) row_of_node.emplace(nodes[row], row);
  for (const GmshTriangle& triangle : model.triangles) {
    for (const std::size_t node : triangle.nodes) {
      const auto row = row_of_node.find(node);
      if (row == row_of_node.end()) fail(fmt::format("node {} does not exist", node));
      const double* p = &xyz[3 * row->second];
      model.position.emplace(node, std::array{p[0], p[1], p[2]});
    }
  }
  const double z0 = model.position.begin()->second[2];
  double extent = 0;
  for (const auto& [node, p] : model.position)
    extent = std::max({extent, std::abs(p[0]), std::abs(p[1])});
  for (const auto& [node, p] : model.position)
    if (!(std::abs(p[2] - z0) <= 1e-9 * extent))
      fail(fmt::format("node {} has z = {}, others {}; the body must lie in a plane z = constant",
                       node, p[2], z0));
}

void orient(GmshModel& model) {
  const auto point = [&](std::size_t node) {
    const auto& p = model.position.at(node);
    return Eigen::Vector2d(p[0], p[1]);
  };
  for (GmshTriangle& triangle : model.triangles) {
    auto& [a, b, c] = triangle.nodes;
    const Eigen::Vector2d pa = point(a), pb = point(b), pc = point(c);
    const double twice_area = cross_area(pa, pb, pc);
    const double longest_squared =
        std::max({(pb - pa).squaredNorm(), (pc - pb).squaredNorm(), (pa - pc).squaredNorm()});
    if (!(std::abs(twice_area) > flat_triangle_tolerance * longest_squared))
      fail(fmt::format("triangle of nodes {}, {}, {} at ({:.6g}, {:.6g}) has zero area", a, b, c,
                       pa.x(), pa.y()));
    if (twice_area < 0) std::swap(b, c);
  }
}

Mesh renumbered(const GmshModel& model) {
  Mesh mesh;
  mesh.body_names = model.body_names;
  std::map<std::size_t, int> vertex;
  for (const auto& [node, p] : model.position) {
    vertex.emplace(node, static_cast<int>(mesh.vertices.size()));
    mesh.vertices.emplace_back(p[0], p[1]);
  }
  std::set<Nodes> sides;
  for (const auto& [nodes, body] : model.triangles) {
    mesh.triangles.push_back({vertex[nodes[0]], vertex[nodes[1]], vertex[nodes[2]]});
    mesh.triangle_body.push_back(body);
    for (std::size_t k = 0; k < 3; ++k) sides.insert({nodes[k], nodes[(k + 1) % 3]});
  }

  const auto place = [&](const Nodes& line) {
    const auto &a = model.position.at(line[0]), &b = model.position.at(line[1]);
    return fmt::format("edge from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g})", a[0], a[1], b[0], b[1]);
  };
  auto without_side = model.label_of_line;
  for (const Nodes& side : sides) {
    if (sides.contains({side[1], side[0]})) continue;
    const auto line = without_side.find({std::min(side[0], side[1]), std::max(side[0], side[1])});
    if (line == without_side.end())
      fail(fmt::format("boundary {} is in no physical curve named displacement, force or contact{}",
                       place(side), list_of(model.other_curves)));
    const BoundaryLabel label = *parse_boundary_label(line->second);
    mesh.boundary.push_back(
        {{vertex[side[0]], vertex[side[1]]}, label.role, boundary_group(mesh, label.name)});
    without_side.erase(line);
  }
  if (!without_side.empty()) {
    const auto& [line, name] = *without_side.begin();
    if (!model.position.contains(line[0]) || !model.position.contains(line[1]))
      fail(fmt::format("physical curve '{}' has an edge that touches no triangle", name));
    fail(fmt::format("physical curve '{}': {} is not on the body's boundary", name, place(line)));
  }
  return mesh;
}

Mesh mesh_of_open_model(const ModelOptions& options, std::vector<std::string>& notes) {
  GmshModel model;
  read_triangles(model);
  read_lines(model, options);
  read_positions(model);
  orient(model);
  if (model.is_reduced) notes.emplace_back("elements of higher order are reduced to their corners");
  return renumbered(model);
}

// Surfaces that are not joined are a common slip.
void check(const Mesh& mesh) {
  try {
    validate(mesh);
  } catch (const MeshError& error) {
    const std::string what = error.what();
    const bool apart = what.find("separate pieces") != what.npos;
    throw MeshError(what + (apart ? " (in Gmsh, Coherence or BooleanFragments joins surfaces that "
                                    "touch or overlap)"
                                  : ""));
  }
}

// As it is, if it is one of ours.
std::optional<Mesh> own_mesh(const std::filesystem::path& file, const ModelOptions& options) {
  if (format_of(file) != ModelFormat::msh || !text_of(options).empty()) return {};
  try {
    return read_msh(file);
  } catch (const MeshError&) {
    return {};
  }
}

}  // namespace

ConvertedModel convert_model(const std::filesystem::path& model, const ModelOptions& options) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(model, error))
    throw MeshError(model.string() + ": no such file");
  if (std::optional<Mesh> own = own_mesh(model, options)) return {std::move(*own), {}};
  ConvertedModel converted;
  Mesh& mesh = converted.mesh;
  try {
    const OpenModel open(model, options);
    mesh = mesh_of_open_model(options, converted.notes);
  } catch (const InputError& complaint) {
    throw MeshError(model.string() + ": " + complaint.what());
  } catch (...) {
    const std::string message = message_of_gmsh();
    const bool starts_program = message.find("aborting system call") != message.npos;
    throw MeshError(model.string() + ": Gmsh: " + message +
                    (starts_program ? " (a model may start no programs)" : ""));
  }
  mesh.name = model.string();  // for validate() to complain about
  check(mesh);
  mesh.name = model.stem().string();
  for (std::string& note : converted.notes) note = model.string() + ": " + note;
  return converted;
}

}  // namespace airybench
