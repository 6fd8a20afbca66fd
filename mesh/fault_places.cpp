#include "mesh/fault_places.hpp"

#include <algorithm>
#include <numeric>
#include <set>
#include <vector>

#include "mesh/transform_error.hpp"
#include "support/lists.hpp"

namespace airybench {
namespace {

bool has_corner(const Mesh& mesh, int triangle, int vertex) {
  return std::ranges::count(mesh.triangles[triangle], vertex) > 0;
}

bool share_edge_at(const Mesh& mesh, int t, int other, int vertex) {
  return std::ranges::any_of(mesh.triangles[t],
                             [&](int v) { return v != vertex && has_corner(mesh, other, v); });
}

// Of the triangles around a vertex that edges join to its first one, and of the others.
std::array<std::set<std::string>, 2> bodies_around(const Mesh& mesh, int vertex) {
  std::vector<int> joined, apart;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
    if (has_corner(mesh, t, vertex)) (joined.empty() ? joined : apart).push_back(t);
  for (std::size_t k = 0; k < joined.size(); ++k) {
    const auto first = std::partition(apart.begin(), apart.end(), [&](int t) {
      return !share_edge_at(mesh, joined[k], t, vertex);
    });
    joined.insert(joined.end(), first, apart.end());
    apart.erase(first, apart.end());
  }
  std::array<std::set<std::string>, 2> bodies;
  for (const int t : joined) bodies[0].insert(mesh.body_names[mesh.triangle_body[t]]);
  for (const int t : apart) bodies[1].insert(mesh.body_names[mesh.triangle_body[t]]);
  return bodies;
}

// Between the ends of an edge, and on it.
bool hangs_on(const Mesh& mesh, int vertex, const std::array<int, 2>& edge) {
  constexpr double off = 1e-6;
  const Eigen::Vector2d along = mesh.vertices[edge[1]] - mesh.vertices[edge[0]],
                        to = mesh.vertices[vertex] - mesh.vertices[edge[0]];
  const double s = along.dot(to) / along.squaredNorm();
  return s > off && s < 1 - off && (to - s * along).norm() <= off * along.norm();
}

std::string of_two_in_one_place(const Mesh& mesh, int v, int w) {
  return "vertices " + std::to_string(v + 1) + " and " + std::to_string(w + 1) +
         " are two in one place, " + shown(mesh.vertices[v]) +
         " (allowed: one, where elements are joined)";
}

std::string of_hanging(const Mesh& mesh, int vertex, const std::array<int, 2>& edge) {
  return vertex_text(mesh, vertex) + " hangs on " + edge_text(mesh, edge[0], edge[1]) +
         " (allowed: a vertex of the elements on both sides)";
}

std::set<int> neighbours(const Mesh& mesh, int vertex) {
  std::set<int> joined;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
    if (has_corner(mesh, t, vertex))
      joined.insert(mesh.triangles[t].begin(), mesh.triangles[t].end());
  joined.erase(vertex);
  return joined;
}

}  // namespace

std::string vertex_text(const Mesh& mesh, int vertex) {
  return "vertex " + std::to_string(vertex + 1) + " at " + shown(mesh.vertices[vertex]);
}

std::string edge_text(const Mesh& mesh, int a, int b) {
  return "edge " + std::to_string(a + 1) + "-" + std::to_string(b + 1) + " at " +
         shown(Eigen::Vector2d((mesh.vertices[a] + mesh.vertices[b]) / 2));
}

std::string triangle_text(const Mesh& mesh, int triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return "triangle " + std::to_string(triangle + 1) + " at " +
         shown(Eigen::Vector2d((mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3));
}

std::string why_touching(const Mesh& mesh, int vertex) {
  for (const int v : neighbours(mesh, vertex)) {
    for (const int w : neighbours(mesh, vertex))
      if (v < w && mesh.vertices[v] == mesh.vertices[w]) return of_two_in_one_place(mesh, v, w);
    for (int w = 0; w < static_cast<int>(mesh.vertices.size()); ++w)
      if (hangs_on(mesh, w, {vertex, v})) return of_hanging(mesh, w, {vertex, v});
  }
  const std::array<std::set<std::string>, 2> bodies = bodies_around(mesh, vertex);
  const bool are_two =
      std::ranges::none_of(bodies[0], [&](const auto& b) { return bodies[1].contains(b); });
  return (are_two ? "the bodies " + joined(bodies[0]) + " and " + joined(bodies[1]) + " are"
                  : std::string("two parts of it are")) +
         " merged in this point alone (allowed: joined along edges, or with a vertex each)";
}

std::string why_meeting(const Mesh& mesh, const std::array<int, 2>& one,
                        const std::array<int, 2>& other) {
  for (const int v : one)
    for (const int w : other)
      if (v != w && mesh.vertices[v] == mesh.vertices[w]) return of_two_in_one_place(mesh, v, w);
  for (const auto& [edge, across] : {std::pair(one, other), {other, one}})
    for (const int v : across)
      if (hangs_on(mesh, v, edge)) return of_hanging(mesh, v, edge);
  return "elements overlap";
}

}  // namespace airybench
