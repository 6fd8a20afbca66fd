#include "mesh/refinement.hpp"

#include <algorithm>
#include <map>
#include <tuple>

namespace airybench {
namespace {

// Longest-edge bisection of one mesh.
class Bisection {
 public:
  explicit Bisection(const Mesh& mesh) : mesh_(mesh) {
    for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t) join(t);
    for (int row = 0; row < static_cast<int>(mesh_.boundary.size()); ++row)
      row_of_[key(mesh_.boundary[row].vertices[0], mesh_.boundary[row].vertices[1])] = row;
  }

  void at_vertex(int v, double length) {
    std::vector<int> here;
    for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t)
      if (std::ranges::count(mesh_.triangles[t], v) > 0) here.push_back(t);
    while (!here.empty()) {
      const int t = here.back();
      if (!too_long(t, v, length)) {
        here.pop_back();
        continue;
      }
      const std::size_t before = mesh_.triangles.size();
      cut_terminal_edge(t);
      for (std::size_t born = before; born < mesh_.triangles.size(); ++born)
        if (std::ranges::count(mesh_.triangles[born], v) > 0)
          here.push_back(static_cast<int>(born));
    }
  }
  Mesh take() { return std::move(mesh_); }

 private:
  using Edge = std::array<int, 2>;  // low vertex, high vertex
  static constexpr int none = -1;

  static Edge key(int a, int b) { return {std::min(a, b), std::max(a, b)}; }
  double length_squared(const Edge& edge) const {
    return (mesh_.vertices[edge[1]] - mesh_.vertices[edge[0]]).squaredNorm();
  }
  bool too_long(int t, int v, double length) const {
    const auto& triangle = mesh_.triangles[t];
    return std::ranges::count(triangle, v) > 0 && std::ranges::any_of(triangle, [&](int w) {
             return length_squared(key(v, w)) > length * length;
           });
  }
  Edge side(int t, int k) const {
    return key(mesh_.triangles[t][k], mesh_.triangles[t][(k + 1) % 3]);
  }
  int longest_side(int t) const {
    const auto rank = [&](int k) { return std::tuple(length_squared(side(t, k)), side(t, k)); };
    return std::max({0, 1, 2}, [&](int i, int j) { return rank(i) < rank(j); });
  }
  std::array<int, 2>& triangles_of(const Edge& edge) {
    return triangles_of_.try_emplace(edge, std::array{none, none}).first->second;
  }
  void replace(const Edge& edge, int before, int after) {
    auto& two = triangles_of(edge);
    (two[0] == before ? two[0] : two[1]) = after;
  }
  void join(int t) {
    for (int k = 0; k < 3; ++k) replace_first_none(side(t, k), t);
  }
  void replace_first_none(const Edge& edge, int t) {
    auto& two = triangles_of(edge);
    (two[0] == none ? two[0] : two[1]) = t;
  }

  // Walks from t across longest edges to one that is the longest of both its triangles, or on the
  // boundary, and cuts it.
  void cut_terminal_edge(int t) {
    for (;;) {
      const Edge edge = side(t, longest_side(t));
      const auto two = triangles_of(edge);
      const int across = two[0] == t ? two[1] : two[0];
      if (across == none || side(across, longest_side(across)) == edge) return cut(edge);
      t = across;
    }
  }

  void cut(const Edge& edge) {
    const int middle = static_cast<int>(mesh_.vertices.size());
    mesh_.vertices.emplace_back((mesh_.vertices[edge[0]] + mesh_.vertices[edge[1]]) / 2);
    const auto two = triangles_of(edge);
    triangles_of_.erase(edge);
    for (const int t : two)
      if (t != none) halve(t, edge, middle);
    const auto row = row_of_.find(edge);
    if (row == row_of_.end()) return;
    const auto [start, end] = mesh_.boundary[row->second].vertices;
    mesh_.boundary[row->second].vertices = {start, middle};
    row_of_[key(start, middle)] = row->second;
    row_of_[key(middle, end)] = static_cast<int>(mesh_.boundary.size());
    BoundaryEdge second = mesh_.boundary[row->second];
    second.vertices = {middle, end};
    mesh_.boundary.push_back(second);
    row_of_.erase(edge);
  }

  // abc with ab = edge becomes a m c, and m b c behind all others.
  void halve(int t, const Edge& edge, int middle) {
    int k = 0;
    while (side(t, k) != edge) ++k;
    const auto triangle = mesh_.triangles[t];
    const int a = triangle[k], b = triangle[(k + 1) % 3], c = triangle[(k + 2) % 3];
    const int born = static_cast<int>(mesh_.triangles.size());
    mesh_.triangles[t] = {a, middle, c};
    mesh_.triangles.push_back({middle, b, c});
    mesh_.triangle_body.push_back(mesh_.triangle_body[t]);
    replace(key(b, c), t, born);
    replace_first_none(key(a, middle), t);
    replace_first_none(key(middle, b), born);
    triangles_of(key(middle, c)) = {t, born};
  }

  Mesh mesh_;
  std::map<Edge, std::array<int, 2>> triangles_of_;
  std::map<Edge, int> row_of_;
};

}  // namespace

Mesh uniformly_refined(const Mesh& mesh) {
  const MeshEdges edges = number_edges(mesh);
  const int vertices = static_cast<int>(mesh.vertices.size());
  Mesh fine;
  fine.name = mesh.name;
  fine.body_names = mesh.body_names;
  fine.boundary_groups = mesh.boundary_groups;
  fine.vertices.reserve(mesh.vertices.size() + edges.vertices.size());
  fine.vertices = mesh.vertices;
  for (const auto& [a, b] : edges.vertices)
    fine.vertices.emplace_back((mesh.vertices[a] + mesh.vertices[b]) / 2);
  fine.triangles.reserve(4 * mesh.triangles.size());
  fine.triangle_body.reserve(4 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    const int ab = vertices + edges.of_triangle[t][0], bc = vertices + edges.of_triangle[t][1],
              ca = vertices + edges.of_triangle[t][2];
    fine.triangles.insert(fine.triangles.end(),
                          {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    fine.triangle_body.insert(fine.triangle_body.end(), 4, mesh.triangle_body[t]);
  }
  for (std::size_t row = 0; row < mesh.boundary.size(); ++row) {
    BoundaryEdge first = mesh.boundary[row], second = first;
    first.vertices[1] = second.vertices[0] = vertices + edges.of_boundary[row];
    fine.boundary.insert(fine.boundary.end(), {first, second});
  }
  return fine;
}

Mesh bisected_at_vertex(const Mesh& mesh, int v, double length_mm) {
  Bisection bisection(mesh);
  bisection.at_vertex(v, length_mm);
  return bisection.take();
}

void split_at_point(Mesh& mesh, int triangle, int k, const Eigen::Vector2d& p) {
  const auto corners = mesh.triangles[triangle];
  const int a = corners[k], b = corners[(k + 1) % 3], c = corners[(k + 2) % 3];
  const int inner = static_cast<int>(mesh.vertices.size());
  mesh.vertices.push_back(p);
  mesh.triangles[triangle] = {a, b, inner};
  mesh.triangles.push_back({b, c, inner});
  mesh.triangles.push_back({c, a, inner});
  mesh.triangle_body.insert(mesh.triangle_body.end(), 2, mesh.triangle_body[triangle]);
}

}  // namespace airybench
