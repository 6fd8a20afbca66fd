#include "mesh/interfaces.hpp"

#include <algorithm>
#include <map>

namespace airybench {
namespace {

bool is_branching(const std::vector<int>& starting, const std::vector<int>& ending, int vertex) {
  return starting[vertex] > 1 || ending[vertex] > 1;
}

void leave_out_branches(Interface& interface) {
  std::vector<int> starting(interface.line.vertices.size(), 0), ending = starting;
  for (const BoundaryEdge& edge : interface.line.boundary) {
    ++starting[edge.vertices[0]];
    ++ending[edge.vertices[1]];
  }
  std::vector<BoundaryEdge> kept;
  std::vector<std::array<TriangleSide, 2>> sides;
  for (std::size_t k = 0; k < interface.sides.size(); ++k) {
    const BoundaryEdge& edge = interface.line.boundary[k];
    if (std::ranges::any_of(edge.vertices,
                            [&](int v) { return is_branching(starting, ending, v); }))
      continue;
    kept.push_back(edge);
    sides.push_back(interface.sides[k]);
  }
  interface.line.boundary = std::move(kept);
  interface.sides = std::move(sides);
}

}  // namespace

std::vector<Interface> interfaces(const Mesh& mesh, const MeshEdges& edges) {
  if (mesh.body_names.size() < 2) return {};
  constexpr TriangleSide none = {-1, 0};
  std::vector<std::array<TriangleSide, 2>> of_edge(static_cast<std::size_t>(edges.count()),
                                                   {none, none});
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
    for (int k = 0; k < 3; ++k) {
      std::array<TriangleSide, 2>& sides = of_edge[edges.of_triangle[t][k]];
      sides[sides[0].triangle >= 0 ? 1 : 0] = {t, k};
    }
  std::map<std::array<int, 2>, Interface> found;
  std::map<std::array<int, 2>, std::map<int, int>> numbers;  // of vertices
  for (std::array<TriangleSide, 2>& sides : of_edge) {
    if (sides[1].triangle < 0) continue;
    const auto body = [&](const TriangleSide& side) { return mesh.triangle_body[side.triangle]; };
    if (body(sides[0]) > body(sides[1])) std::swap(sides[0], sides[1]);
    const std::array<int, 2> bodies = {body(sides[0]), body(sides[1])};
    if (bodies[0] == bodies[1]) continue;
    Interface& interface = found[bodies];
    const auto number = [&](int vertex) {
      auto& vertices = interface.line.vertices;
      const auto [at, is_new] =
          numbers[bodies].try_emplace(vertex, static_cast<int>(vertices.size()));
      if (is_new) vertices.push_back(mesh.vertices[vertex]);
      return at->second;
    };
    const auto& [t, k] = sides[0];
    const int start = number(mesh.triangles[t][k]), end = number(mesh.triangles[t][(k + 1) % 3]);
    interface.line.boundary.push_back({{start, end}, BoundaryRole::force});
    interface.sides.push_back(sides);
  }
  std::vector<Interface> list;
  for (auto& [bodies, interface] : found) {
    interface.bodies = bodies;
    interface.line.is_polygon = mesh.is_polygon;
    leave_out_branches(interface);
    list.push_back(std::move(interface));
  }
  return list;
}

}  // namespace airybench
