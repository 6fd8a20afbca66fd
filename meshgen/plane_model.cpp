#include "meshgen/plane_model.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>
#include <unordered_map>

#include "mesh/mesh.hpp"
#include "meshgen/bent_sides.hpp"
#include "support/errors.hpp"

namespace airybench {
namespace {

[[noreturn]] void refuse_model(const std::string& what) { throw InputError(what); }

Nodes in_order(const Nodes& edge) {
  return {std::min(edge[0], edge[1]), std::max(edge[0], edge[1])};
}

class ModelReader {
  using Span = std::span<const std::size_t>;

 public:
  ModelReader() {
    std::vector<std::size_t> nodes;
    std::vector<double> xyz, parameters;
    gmsh::model::mesh::getNodes(nodes, xyz, parameters, -1, -1, false, false);
    for (std::size_t row = 0; row < nodes.size(); ++row)
      places_.emplace(nodes[row], Eigen::Vector3d(&xyz[3 * row]));
  }

  PlaneModel model(double mm_per_unit, std::vector<std::string>& notes) {
    read_triangles(notes);
    read_positions(mm_per_unit, notes);
    orient();
    read_curves();
    if (is_reduced_)
      notes.emplace_back(
          "of elements of higher order, sides of the boundary keep their curves; others are "
          "chords");
    if (bent_between_nodes_ > 0)
      notes.push_back(
          fmt::format("{} sides stay chords, since their curve bends between two nodes (allowed: a "
                      "finer mesh)",
                      bent_between_nodes_));
    if (quadrilaterals_ > 0)
      notes.push_back(
          fmt::format("{} quadrilaterals are split by the shorter diagonal", quadrilaterals_));
    return std::move(model_);
  }

 private:
  const Eigen::Vector3d& place(std::size_t node) const {
    const auto found = places_.find(node);
    if (found == places_.end()) refuse_model(fmt::format("node {} does not exist", node));
    return found->second;
  }

  // Calls take(corners, inside) for every element of an entity. inside: its other nodes, those of
  // its sides first.
  template <typename Take>
  void each_element(int dimension, int entity, const Take& take) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> elements, nodes;
    gmsh::model::mesh::getElements(types, elements, nodes, dimension, entity);
    for (std::size_t k = 0; k < types.size(); ++k) {
      std::string name;
      int type_dimension, order, node_count, corners;
      std::vector<double> local;
      gmsh::model::mesh::getElementProperties(types[k], name, type_dimension, order, node_count,
                                              local, corners);
      if (corners != dimension + 1 && corners != 2 * dimension)
        refuse_model(fmt::format("{} {} has elements '{}' (allowed: {})",
                                 dimension == 1 ? "curve" : "surface", entity, name,
                                 dimension == 1 ? "lines" : "triangles, quadrilaterals"));
      is_reduced_ |= order > 1;
      const auto stride = static_cast<std::size_t>(node_count);
      for (std::size_t first = 0; first < nodes[k].size(); first += stride)
        take(std::span(&nodes[k][first], static_cast<std::size_t>(corners)),
             std::span(&nodes[k][first], stride).subspan(static_cast<std::size_t>(corners)));
    }
  }

  // Through the quadrilateral's corners 0 and 2, or 1 and 3?
  bool is_split_at_0(std::span<const std::size_t> q) const {
    const std::array p = {place(q[0]), place(q[1]), place(q[2]), place(q[3])};
    const auto is_inside = [&](int a, int b, int c, int d) {
      return (p[b] - p[a]).cross(p[c] - p[a]).dot((p[c] - p[a]).cross(p[d] - p[a])) > 0;
    };
    if (!is_inside(1, 2, 3, 0)) return true;
    return is_inside(0, 1, 2, 3) && (p[2] - p[0]).norm() <= (p[3] - p[1]).norm();
  }

  void read_surface(int surface, int body) {
    const std::size_t before = model_.triangles.size();
    std::set<std::array<std::size_t, 3>> seen;  // MSH 2 has an element once for each of its groups
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      std::array<std::size_t, 3> corners = {a, b, c};
      std::ranges::sort(corners);
      const bool is_new = seen.insert(corners).second;
      if (is_new) model_.triangles.push_back({{a, b, c}, body, surface});
      return is_new;
    };
    each_element(2, surface, [&](Span n, Span inside) {
      side_nodes_.add_element(n, inside);
      if (n.size() == 3) {
        add(n[0], n[1], n[2]);
        return;
      }
      const std::size_t s = is_split_at_0(n) ? 0 : 1;
      add(n[s], n[s + 1], n[s + 2]);
      quadrilaterals_ += add(n[s], n[s + 2], n[(s + 3) % 4]);
    });
    if (model_.triangles.size() == before) empty_surfaces_.push_back(surface);
  }

  int body_named(const std::string& name, int group) {
    if (name.find_first_of("\"\n") != name.npos)
      refuse_model(
          fmt::format("physical surface {}: its name must not hold quotes or line ends", group));
    const auto known = std::ranges::find(model_.body_names, name);
    const auto body = known - model_.body_names.begin();
    if (known == model_.body_names.end()) model_.body_names.push_back(name);
    return static_cast<int>(body);
  }

  static std::string name_of(int group, std::size_t groups) {
    std::string name;
    gmsh::model::getPhysicalName(2, group, name);
    return !name.empty() ? name : groups == 1 ? "body" : fmt::format("body{}", group);
  }

  // The groups that are bodies, with their surfaces. A group that others make up ("all") is none;
  // any other surface in two is refused, for they may differ in material.
  static std::map<int, std::vector<int>> bodies_among(const gmsh::vectorpair& groups,
                                                      std::vector<std::string>& notes) {
    std::map<int, std::vector<int>> members;
    std::multimap<std::size_t, int> by_size;
    std::map<int, std::set<int>> groups_of;  // a surface's
    for (const auto& [dimension, group] : groups) {
      gmsh::model::getEntitiesForPhysicalGroup(2, group, members[group]);
      by_size.emplace(members[group].size(), group);
      for (const int surface : members[group]) groups_of[surface].insert(group);
    }
    const auto shown = [&](int group) { return name_of(group, groups.size()); };
    for (auto largest = by_size.rbegin(); largest != by_size.rend(); ++largest) {
      const int group = largest->second;
      const std::set<int> whole(members[group].begin(), members[group].end());
      const auto is_part = [&](int other) {
        return std::ranges::all_of(members[other], [&](int s) { return whole.contains(s); });
      };
      const bool is_made_up = std::ranges::all_of(whole, [&](int surface) {
        const std::set<int>& of = groups_of[surface];
        return of.size() > 1 && std::ranges::all_of(of, is_part);
      });
      if (!is_made_up || whole.empty()) continue;
      notes.push_back(
          fmt::format("physical surface '{}' is no body: each of its surfaces is in another one",
                      shown(group)));
      for (const int surface : whole) groups_of[surface].erase(group);
      members.erase(group);
    }
    for (const auto& [surface, of] : groups_of)
      if (of.size() > 1)
        refuse_model(
            fmt::format("surface {} is in the physical surfaces '{}' and '{}'; one body is allowed",
                        surface, shown(*of.begin()), shown(*std::next(of.begin()))));
    return members;
  }

  void read_triangles(std::vector<std::string>& notes) {
    gmsh::vectorpair groups, surfaces;
    gmsh::model::getPhysicalGroups(groups, 2);
    for (const auto& [group, members] : bodies_among(groups, notes)) {
      const int body = body_named(name_of(group, groups.size()), group);
      for (const int surface : members) read_surface(surface, body);
    }
    if (groups.empty()) {
      gmsh::model::getEntities(surfaces, 2);
      for (const auto& [dimension, surface] : surfaces)
        read_surface(
            surface,
            body_named(surfaces.size() == 1 ? "body" : fmt::format("body{}", surface), surface));
    }
    std::string reason;
    gmsh::logger::getLastError(reason);
    // Without an error they are parts of a compound, whose triangles are in another surface.
    if (!model_.triangles.empty() && (empty_surfaces_.empty() || reason.empty())) return;
    const std::string what = empty_surfaces_.empty()
                                 ? "it has no surface"
                                 : fmt::format("surface {} has no triangles", empty_surfaces_[0]);
    refuse_model(what + (reason.empty() ? "" : "; Gmsh: " + reason));
  }

  void read_positions(double mm_per_unit, std::vector<std::string>& notes) {
    Eigen::AlignedBox3d box;
    for (const ModelTriangle& triangle : model_.triangles)
      for (const std::size_t node : triangle.nodes) box.extend(place(node));
    constexpr std::string_view names = "xyz";
    constexpr double tolerance = 1e-6;  // of coordinates in single precision
    const auto is_constant = [&](int axis) {
      double extent = 0;
      for (int other = 0; other < 3; ++other)
        if (other != axis)
          extent = std::max({extent, std::abs(box.min()[other]), std::abs(box.max()[other])});
      return box.sizes()[axis] <= tolerance * extent;
    };
    int normal = 2;
    while (normal >= 0 && !is_constant(normal)) --normal;
    if (normal < 0)
      refuse_model(
          fmt::format("it lies in no plane x, y or z = constant (x from {:.6g} to {:.6g}, y from "
                      "{:.6g} to {:.6g}, z from {:.6g} to {:.6g})",
                      box.min().x(), box.max().x(), box.min().y(), box.max().y(), box.min().z(),
                      box.max().z()));
    const int first = normal == 0 ? 1 : 0, second = normal == 2 ? 1 : 2;
    if (normal != 2)
      notes.push_back(
          fmt::format("it lies in the plane {} = {:.6g}: its {} and {} are x and y here",
                      names[normal], box.min()[normal], names[first], names[second]));
    model_.mm_per_unit = mm_per_unit;
    axes_ = {first, second};
    for (const ModelTriangle& triangle : model_.triangles)
      for (const std::size_t node : triangle.nodes)
        model_.position.emplace(node, in_plane(place(node)));
  }
  Eigen::Vector2d in_plane(const Eigen::Vector3d& p) const {  // mm
    return model_.mm_per_unit * Eigen::Vector2d(p[axes_[0]], p[axes_[1]]);
  }

  void orient() {
    for (ModelTriangle& triangle : model_.triangles) {
      auto& [a, b, c] = triangle.nodes;
      const Eigen::Vector2d &pa = model_.position[a], &pb = model_.position[b],
                            &pc = model_.position[c];
      const double twice_area = cross_area(pa, pb, pc);
      const double longest_squared =
          std::max({(pb - pa).squaredNorm(), (pc - pb).squaredNorm(), (pa - pc).squaredNorm()});
      if (!(std::abs(twice_area) > flat_triangle_tolerance * longest_squared))
        throw FlatTriangleError(
            fmt::format("triangle of nodes {}, {}, {} at ({:.6g}, {:.6g}) has zero area", a, b, c,
                        pa.x(), pa.y()));
      if (twice_area < 0) std::swap(b, c);
    }
  }

  // Sides of one triangle only, by their nodes in order.
  std::map<Nodes, Nodes> boundary() const {
    std::map<Nodes, int> triangles;
    std::map<Nodes, Nodes> sides;
    for (const ModelTriangle& triangle : model_.triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const Nodes side = {triangle.nodes[k], triangle.nodes[(k + 1) % 3]};
        if (++triangles[in_order(side)] == 1)
          sides.emplace(in_order(side), side);
        else
          sides.erase(in_order(side));
      }
    return sides;
  }

  void read_curves() {
    std::map<Nodes, Nodes> left = boundary();  // without a curve so far
    std::map<int, ModelCurve> curves;
    gmsh::vectorpair groups, entities;
    gmsh::model::getEntities(entities, 1);
    for (const auto& [dimension, number] : entities) {
      ModelCurve& curve = curves[number];
      curve.number = number;
      std::set<Nodes> seen;
      const CurveGeometry geometry(number);
      each_element(1, number, [&](Span n, Span inside) {
        const Nodes edge = in_order({n[0], n[1]});
        if (!seen.insert(edge).second) return;
        side_nodes_.add_side(n[0], n[1], inside);
        if (const auto side = left.extract(edge)) {
          curve.sides.push_back(side.mapped());
          bend(side.mapped(), geometry.between(side.mapped()[0], side.mapped()[1]));
        } else {
          curve.inner.push_back(edge);
        }
      });
    }
    for (const auto& [edge, side] : boundary()) bend_as_elements(side);
    gmsh::model::getPhysicalGroups(groups, 1);
    for (const auto& [dimension, group] : groups) {
      std::string name;
      gmsh::model::getPhysicalName(1, group, name);
      std::vector<int> of_group;
      gmsh::model::getEntitiesForPhysicalGroup(1, group, of_group);
      for (const int number : of_group)
        curves[number].names.push_back(name.empty() ? std::to_string(group) : name);
    }
    for (auto& [number, curve] : curves) {
      curve.number = number;
      if (is_only_of_elements(curve))
        for (const Nodes& side : curve.sides) left.emplace(in_order(side), side);
      else
        model_.curves.push_back(std::move(curve));
    }
    add_curves_of(left);
  }

  void bend(const Nodes& side, const std::vector<Eigen::Vector3d>& points) {
    std::vector<Eigen::Vector2d> points_mm;
    for (const Eigen::Vector3d& p : points) points_mm.push_back(in_plane(p));
    if (points_mm.empty()) return;
    points_mm.front() = model_.position.at(side[0]);
    points_mm.back() = model_.position.at(side[1]);
    const std::optional<EdgeCurve> curve = curve_through(points_mm, model_.mm_per_unit);
    if (!curve)
      ++bent_between_nodes_;
    else if (!curve->is_straight())
      model_.bent_sides.emplace(side, *curve);
  }
  // Where there is no geometry.
  void bend_as_elements(const Nodes& side) {
    const std::vector<std::size_t> inside = side_nodes_.between(side[0], side[1]);
    if (inside.empty() || model_.bent_sides.contains(side)) return;
    std::vector<Eigen::Vector3d> points = {place(side[0])};
    for (const std::size_t node : inside) points.push_back(place(node));
    points.push_back(place(side[1]));
    bend(side, points);
  }

  // All lines of some formats are one such curve.
  bool is_only_of_elements(const ModelCurve& curve) {
    std::string type;
    gmsh::model::getType(1, curve.number, type);
    if (type != "Discrete curve" || curve.is_named()) return false;
    for (const std::vector<std::size_t>& walk : walks_of(curve))
      for (std::size_t k = 1; k + 1 < walk.size(); ++k)
        if (is_corner(walk[k - 1], walk[k], walk[k + 1])) return true;
    return false;
  }

  bool is_corner(std::size_t before, std::size_t node, std::size_t next) {
    constexpr double cos_40_degrees = 0.766;
    const Eigen::Vector2d& p = model_.position[node];
    return (p - model_.position[before])
               .normalized()
               .dot((model_.position[next] - p).normalized()) < cos_40_degrees;
  }

  // Each from a corner to the next, the first from the lowest one.
  void add_curves_of(const std::map<Nodes, Nodes>& sides) {
    std::map<std::size_t, std::size_t> next, before;
    for (const auto& [edge, side] : sides) {
      next[side[0]] = side[1];
      before[side[1]] = side[0];
    }
    const auto ends_at = [&](std::size_t node) {
      return !before.contains(node) || !next.contains(node) ||
             is_corner(before[node], node, next[node]);
    };
    std::vector<std::size_t> starts;
    for (const auto& [node, end] : next) starts.push_back(node);
    std::ranges::sort(starts, [&](std::size_t a, std::size_t b) {
      const Eigen::Vector2d &p = model_.position[a], &q = model_.position[b];
      return std::tuple(!ends_at(a), p.y(), p.x()) < std::tuple(!ends_at(b), q.y(), q.x());
    });
    std::set<std::size_t> walked;
    for (const std::size_t start : starts)
      for (std::size_t node = start; next.contains(node) && walked.insert(node).second;
           node = next[node]) {
        if (node == start || ends_at(node)) {
          const int number = model_.curves.empty() ? 0 : model_.curves.back().number;
          model_.curves.push_back(
              {.number = number + 1, .names = {}, .sides = {}, .inner = {}, .label = {}});
        }
        model_.curves.back().sides.push_back({node, next[node]});
      }
  }

  std::unordered_map<std::size_t, Eigen::Vector3d> places_;
  SideNodes side_nodes_;
  std::array<int, 2> axes_ = {0, 1};  // that are x and y here
  PlaneModel model_;
  std::vector<int> empty_surfaces_;
  int quadrilaterals_ = 0, bent_between_nodes_ = 0;
  bool is_reduced_ = false;
};

}  // namespace

PlaneModel read_plane_model(double mm_per_unit, std::vector<std::string>& notes) {
  return ModelReader().model(mm_per_unit, notes);
}

std::vector<std::vector<std::size_t>> walks_of(const ModelCurve& curve) {
  std::map<std::size_t, std::size_t> next;
  std::set<std::size_t> ends;
  for (const auto& [start, end] : curve.sides) {
    next.emplace(start, end);
    ends.insert(end);
  }
  std::vector<std::vector<std::size_t>> walks;
  const auto walk_from = [&](std::size_t node) {
    std::vector<std::size_t>& walk = walks.emplace_back(1, node);
    for (auto found = next.find(node); found != next.end(); found = next.find(walk.back())) {
      walk.push_back(found->second);
      next.erase(found);
    }
  };
  for (const auto& [start, end] : curve.sides)
    if (!ends.contains(start)) walk_from(start);
  for (const auto& [start, end] : curve.sides)
    if (next.contains(start)) walk_from(start);
  return walks;
}

}  // namespace airybench
