#include "mesh/mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "mesh/fault_places.hpp"
#include "mesh/outline.hpp"
#include "support/wide.hpp"

namespace airybench {
namespace {

// One side of one triangle. Sorted by its low and high vertex, both sides of an edge are
// neighbours.
struct Side {
  int low, high;
  int triangle, local;  // local: from the triangle's vertex `local` to the next one
  bool forward;         // walked from low to high
};

// In time linear in the triangles: a bucket per low vertex, each of a few sides.
std::vector<Side> sorted_sides(const Mesh& mesh) {
  const auto corner = [&](int t, int k) { return mesh.triangles[t][k % 3]; };
  std::vector<int> end(mesh.vertices.size() + 1, 0);  // of each bucket, once it is filled
  const int triangles = static_cast<int>(mesh.triangles.size());
  for (int t = 0; t < triangles; ++t)
    for (int k = 0; k < 3; ++k) ++end[std::min(corner(t, k), corner(t, k + 1)) + 1];
  std::partial_sum(end.begin(), end.end(), end.begin());
  std::vector<Side> sides(3 * mesh.triangles.size());
  for (int t = 0; t < triangles; ++t)
    for (int k = 0; k < 3; ++k) {
      const int a = corner(t, k), b = corner(t, k + 1);
      sides[end[std::min(a, b)]++] = {std::min(a, b), std::max(a, b), t, k, a < b};
    }
  int start = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); start = end[v++])
    std::sort(sides.begin() + start, sides.begin() + end[v],
              [](const Side& x, const Side& y) { return x.high < y.high; });
  return sides;
}

[[noreturn]] void fail(const Mesh& mesh, const std::string& what) {
  throw MeshError(mesh.name + ": " + what);
}

void check_triangles(const Mesh& mesh) {
  const int n = static_cast<int>(mesh.vertices.size());
  if (mesh.triangles.empty()) fail(mesh, "no triangles; at least one is needed");
  if (mesh.triangle_body.size() != mesh.triangles.size())
    fail(mesh, "every triangle needs a body: " + std::to_string(mesh.triangle_body.size()) +
                   " bodies for " + std::to_string(mesh.triangles.size()) + " triangles");
  for (int v = 0; v < n; ++v)
    if (!mesh.vertices[v].allFinite())
      fail(mesh, "vertex " + std::to_string(v + 1) + ": coordinates must be finite numbers");

  std::vector<bool> used(n, false);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& triangle = mesh.triangles[t];
    const std::string name = "triangle " + std::to_string(t + 1);
    for (const int v : triangle) {
      if (v < 0 || v >= n)
        fail(mesh, name + ": vertex " + std::to_string(v + 1) + " does not exist (1.." +
                       std::to_string(n) + ")");
      used[v] = true;
    }
    const int body = mesh.triangle_body[t];
    if (body < 0 || body >= static_cast<int>(mesh.body_names.size()))
      fail(mesh, name + ": body " + std::to_string(body + 1) + " does not exist (1.." +
                     std::to_string(mesh.body_names.size()) + ")");
    const auto& [a, b, c] = std::tie(mesh.vertices[triangle[0]], mesh.vertices[triangle[1]],
                                     mesh.vertices[triangle[2]]);
    const double twice_area = cross_area(a, b, c);
    const double longest_squared =
        std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    const auto place = [&] { return triangle_text(mesh, static_cast<int>(t)); };
    if (!(std::abs(twice_area) > flat_triangle_tolerance * longest_squared))
      fail(mesh, place() + (a == b || b == c || c == a ? ": two of its vertices are in one place"
                                                       : ": zero area"));
    if (twice_area < 0)
      fail(mesh, place() + ": inverted (its vertices must run counter-clockwise)");
  }
  const auto unused = std::find(used.begin(), used.end(), false);
  if (unused != used.end())
    fail(mesh, vertex_text(mesh, static_cast<int>(unused - used.begin())) +
                   ": dangling (in no triangle)");
}

// Checks the roles against the triangulation; returns the end vertex of the boundary edge that
// starts at each vertex (−1: none starts there).
std::vector<int> check_boundary(const Mesh& mesh, const std::vector<Side>& sides) {
  const int n = static_cast<int>(mesh.vertices.size());
  std::vector<int> next(n, -1);
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t j = i + 1;
    while (j < sides.size() && sides[j].low == sides[i].low && sides[j].high == sides[i].high) ++j;
    const auto name = [&] { return edge_text(mesh, sides[i].low, sides[i].high); };
    if (j - i > 2)
      fail(mesh, name() + ": shared by " + std::to_string(j - i) +
                     " triangles; at most two can meet: elements overlap, or are given twice");
    if (j - i == 2 && sides[i].forward == sides[i + 1].forward)
      fail(mesh, name() + ": its two triangles overlap");
    if (j - i == 1) {
      const int start = sides[i].forward ? sides[i].low : sides[i].high;
      if (next[start] != -1)
        fail(mesh, vertex_text(mesh, start) +
                       ": the boundary touches itself there: " + why_touching(mesh, start));
      next[start] = sides[i].low + sides[i].high - start;
    }
    i = j;
  }

  std::vector<bool> has_role(n, false);
  for (const BoundaryEdge& edge : mesh.boundary) {
    const auto [a, b] = edge.vertices;
    if (a < 0 || a >= n || b < 0 || b >= n)
      fail(mesh, "boundary edge " + std::to_string(a + 1) + "-" + std::to_string(b + 1) +
                     ": a vertex does not exist (1.." + std::to_string(n) + ")");
    const auto name = [&, from = a, to = b] { return "boundary " + edge_text(mesh, from, to); };
    if (next[a] != b) {
      if (next[b] == a) fail(mesh, name() + ": walked clockwise; the body must lie on its left");
      fail(mesh, name() + ": not on the boundary of the triangles");
    }
    if (has_role[a]) fail(mesh, name() + ": given twice");
    has_role[a] = true;
    if (edge.group < BoundaryEdge::no_group ||
        edge.group >= static_cast<int>(mesh.boundary_groups.size()))
      fail(mesh, name() + ": group " + std::to_string(edge.group + 1) + " does not exist (1.." +
                     std::to_string(mesh.boundary_groups.size()) + ")");
    if (!edge.curve.is_straight() && (edge.curve.points_mm.front() != mesh.vertices[a] ||
                                      edge.curve.points_mm.back() != mesh.vertices[b]))
      fail(mesh, name() + ": its curve does not start and end at its vertices");
  }
  for (int v = 0; v < n; ++v)
    if (next[v] != -1 && !has_role[v])
      fail(mesh, edge_text(mesh, v, next[v]) +
                     ": a boundary edge without a role (displacement, force or contact)");
  return next;
}

// Contact edges of one piece that lie on each other are the faces of a crack: without them, and
// with the vertices that they join as one, the boundary is simple.
std::vector<int> without_cracks(const Mesh& mesh, const MeshPieces& pieces, std::vector<int> next) {
  using Place = std::array<double, 4>;
  const auto place = [&](int a, int b) {
    const Eigen::Vector2d &x = mesh.vertices[a], &y = mesh.vertices[b];
    return Place{x.x(), x.y(), y.x(), y.y()};
  };
  std::map<Place, std::vector<int>> starts;
  for (const BoundaryEdge& edge : mesh.boundary)
    if (edge.role == BoundaryRole::contact)
      starts[place(edge.vertices[0], edge.vertices[1])].push_back(edge.vertices[0]);
  std::vector<int> as(next.size());
  std::iota(as.begin(), as.end(), 0);
  std::vector<bool> is_crack(next.size(), false);
  for (const auto& [ends, of_first] : starts) {
    const auto reversed = starts.find({ends[2], ends[3], ends[0], ends[1]});
    if (reversed == starts.end()) continue;
    for (const int a : of_first)
      for (const int c : reversed->second) {
        if (pieces.of_vertex[a] != pieces.of_vertex[c]) continue;
        is_crack[a] = is_crack[c] = true;
        as[std::max(a, next[c])] = std::min(a, next[c]);
        as[std::max(next[a], c)] = std::min(next[a], c);
      }
  }
  std::vector<int> rest(next.size(), -1);
  for (int v = 0; v < static_cast<int>(next.size()); ++v)
    if (next[v] != -1 && !is_crack[v]) rest[as[v]] = as[next[v]];
  return rest;
}

// The vertices of each closed curve of the boundary.
std::vector<std::vector<int>> boundary_curves(const std::vector<int>& next) {
  std::vector<std::vector<int>> curves;
  std::vector<bool> seen(next.size(), false);
  for (std::size_t start = 0; start < next.size(); ++start) {
    if (next[start] == -1 || seen[start]) continue;
    auto& curve = curves.emplace_back();
    for (int v = static_cast<int>(start); !seen[v]; v = next[v]) {
      seen[v] = true;
      curve.push_back(v);
    }
  }
  return curves;
}

// Triangles that all run counter-clockwise cover a point as often as their boundary winds around
// it: at most once where its curves are simple and apart and only one runs counter-clockwise, the
// outer one.
void check_overlap(const Mesh& mesh, const std::vector<int>& next,
                   const std::vector<std::vector<int>>& curves) {
  std::vector<std::vector<Eigen::Vector2d>> polygons;
  int outer = 0;
  for (const std::vector<int>& curve : curves) {
    auto& polygon = polygons.emplace_back();
    for (const int v : curve) polygon.push_back(mesh.vertices[v]);
    Wide twice_area = 0;
    for (std::size_t i = 2; i < polygon.size(); ++i)
      twice_area += cross_area<Wide>(polygon[0], polygon[i - 1], polygon[i]);
    outer += twice_area > 0;
  }
  if (const auto edges = where_they_meet(polygons)) {
    const auto ends = [&](const PolygonEdge& edge) -> std::array<int, 2> {
      const int v = curves[edge.polygon][edge.corner];
      return {v, next[v]};
    };
    const std::array<int, 2> one = ends(edges->front()), other = ends(edges->back());
    fail(mesh, "boundary " + edge_text(mesh, one[0], one[1]) + ": crosses or touches boundary " +
                   edge_text(mesh, other[0], other[1]) +
                   "; the body must not overlap itself: " + why_meeting(mesh, one, other));
  }
  if (outer > 1)
    fail(mesh, std::to_string(outer) + " outer boundaries; the body must not overlap itself");
}

void check_overlap(const Mesh& mesh, const std::vector<int>& of_boundary) {
  const MeshPieces pieces = pieces_of(mesh);
  const std::vector<int> next = without_cracks(mesh, pieces, of_boundary);
  std::vector<std::vector<std::vector<int>>> curves(static_cast<std::size_t>(pieces.count));
  for (std::vector<int>& curve : boundary_curves(next))
    curves[pieces.of_vertex[curve.front()]].push_back(std::move(curve));
  for (const auto& of_piece : curves) check_overlap(mesh, next, of_piece);
}

// Three sides per triangle; an inner edge has two.
int edge_count(const Mesh& mesh) {
  return static_cast<int>((3 * mesh.triangles.size() + mesh.boundary.size()) / 2);
}

}  // namespace

std::string boundary_label(const Mesh& mesh, const BoundaryEdge& edge) {
  std::string label(boundary_role_names[static_cast<std::size_t>(edge.role)]);
  if (edge.group != BoundaryEdge::no_group)
    label += ":" + mesh.boundary_groups[static_cast<std::size_t>(edge.group)];
  return label;
}

double turning_angle(const Eigen::Vector2d& in, const Eigen::Vector2d& out) {
  constexpr double rounding = 1e-6;  // no triangle has so small an angle
  const double turn = std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
  return turn < std::numbers::pi - rounding ? turn : -std::numbers::pi;
}

Eigen::Vector2d point_on(const Mesh& mesh, const BoundaryEdge& edge, double t) {
  if (!edge.curve.is_straight()) return edge.curve.at(t);
  return (1 - t) * mesh.vertices[edge.vertices[0]] + t * mesh.vertices[edge.vertices[1]];
}

BoundaryEdge cut_at(BoundaryEdge& edge, int vertex, double t) {
  BoundaryEdge second = edge;
  edge.vertices[1] = second.vertices[0] = vertex;
  if (edge.curve.is_straight()) return second;
  second.curve = edge.curve.between(t, 1);
  edge.curve = edge.curve.between(0, t);
  return second;
}

Mesh with_roles(Mesh mesh, const std::vector<BoundaryRole>& roles) {
  for (std::size_t row = 0; row < roles.size(); ++row) mesh.boundary[row].role = roles[row];
  return mesh;
}

int boundary_group(Mesh& mesh, std::string_view name) {
  if (name.empty()) return BoundaryEdge::no_group;
  auto& names = mesh.boundary_groups;
  const auto known = std::find(names.begin(), names.end(), name);
  const auto row = known - names.begin();
  if (known == names.end()) names.emplace_back(name);
  return static_cast<int>(row);
}

std::optional<BoundaryLabel> parse_boundary_label(std::string_view label) {
  const auto colon = label.find(':');
  const auto role =
      std::find(boundary_role_names.begin(), boundary_role_names.end(), label.substr(0, colon));
  if (role == boundary_role_names.end() || colon == label.size() - 1) return std::nullopt;
  const auto row = static_cast<std::size_t>(role - boundary_role_names.begin());
  return BoundaryLabel{static_cast<BoundaryRole>(row),
                       colon == label.npos ? std::string_view() : label.substr(colon + 1)};
}

void validate(const Mesh& mesh) {
  check_triangles(mesh);
  const std::vector<Side> sides = sorted_sides(mesh);
  const std::vector<int> next = check_boundary(mesh, sides);
  check_overlap(mesh, next);
}

MeshEdges number_edges(const Mesh& mesh) {
  MeshEdges edges;
  edges.of_triangle.resize(mesh.triangles.size());
  edges.vertices.reserve(mesh.vertices.size() + mesh.triangles.size());
  for (const Side& side : sorted_sides(mesh)) {
    if (edges.vertices.empty() || edges.vertices.back() != std::array{side.low, side.high})
      edges.vertices.push_back({side.low, side.high});
    edges.of_triangle[side.triangle][side.local] = edges.count() - 1;
  }
  edges.vertices.shrink_to_fit();
  edges.of_boundary.reserve(mesh.boundary.size());
  for (const BoundaryEdge& edge : mesh.boundary) {
    const auto [low, high] = std::minmax(edge.vertices[0], edge.vertices[1]);
    const auto found =
        std::lower_bound(edges.vertices.begin(), edges.vertices.end(), std::array{low, high});
    edges.of_boundary.push_back(static_cast<int>(found - edges.vertices.begin()));
  }
  return edges;
}

std::vector<std::vector<int>> boundary_chains(const Mesh& mesh, BoundaryRole role) {
  std::vector<int> starting_at(mesh.vertices.size(), -1), ending_at(mesh.vertices.size(), -1);
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row) {
    if (mesh.boundary[row].role != role) continue;
    starting_at[mesh.boundary[row].vertices[0]] = row;
    ending_at[mesh.boundary[row].vertices[1]] = row;
  }
  std::vector<bool> taken(mesh.boundary.size(), false);
  std::vector<std::vector<int>> chains;
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row) {
    if (mesh.boundary[row].role != role || taken[row]) continue;
    int first = row;
    for (int before = ending_at[mesh.boundary[first].vertices[0]]; before != -1;
         before = ending_at[mesh.boundary[first].vertices[0]]) {
      first = before;
      if (before == row) break;  // once around a closed chain
    }
    auto& chain = chains.emplace_back();
    for (int next = first; next != -1 && !taken[next];
         next = starting_at[mesh.boundary[next].vertices[1]]) {
      taken[next] = true;
      chain.push_back(next);
    }
  }
  return chains;
}

MeshPieces pieces_of(const Mesh& mesh) {
  std::vector<int> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    parent[root(a)] = root(b);
    parent[root(b)] = root(c);
  }
  MeshPieces pieces;
  pieces.of_vertex.resize(mesh.vertices.size());
  std::vector<int> number(mesh.vertices.size(), -1);
  for (int v = 0; v < static_cast<int>(mesh.vertices.size()); ++v) {
    int& own = number[root(v)];
    if (own < 0) own = pieces.count++;
    pieces.of_vertex[v] = own;
  }
  return pieces;
}

int hole_count(const Mesh& mesh) {
  return pieces_of(mesh).count - static_cast<int>(mesh.vertices.size()) + edge_count(mesh) -
         static_cast<int>(mesh.triangles.size());
}

MeshSizes mesh_sizes(const Mesh& mesh) {
  MeshSizes sizes;
  for (const BoundaryEdge& edge : mesh.boundary) {
    sizes.displacement_edges += edge.role == BoundaryRole::displacement;
    sizes.force_edges += edge.role == BoundaryRole::force;
    sizes.contact_edges += edge.role == BoundaryRole::contact;
  }
  sizes.n_phi = 3 * static_cast<int>(mesh.vertices.size()) + edge_count(mesh);
  sizes.n_f = 4 * sizes.force_edges;
  sizes.n_c = 4 * sizes.contact_edges;
  return sizes;
}

MeshExtent extent_of(const Mesh& mesh) {
  MeshExtent extent;
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& vertex : mesh.vertices) box.extend(vertex);
  for (const auto& [a, b, c] : mesh.triangles)
    extent.area_mm2 += cross_area(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]) / 2;
  for (const BoundaryEdge& edge : mesh.boundary)
    if (edge.role == BoundaryRole::contact)
      extent.contact_length_mm +=
          (mesh.vertices[edge.vertices[1]] - mesh.vertices[edge.vertices[0]]).norm();
  extent.width_mm = box.sizes().x();
  extent.height_mm = box.sizes().y();
  return extent;
}

}  // namespace airybench
