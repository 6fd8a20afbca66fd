#include "assembly/problem/bonded_faces.hpp"

#include <algorithm>
#include <numeric>

#include "assembly/problem/contact_pairs.hpp"
#include "mesh/transform_error.hpp"

namespace airybench {
namespace {

// The vertex that each becomes.
using Union = std::vector<int>;

// Vertices of the second face become those of the first that they face.
Union unite(Mesh& mesh, const ContactPair& pair, const std::vector<std::array<int, 2>>& edges) {
  constexpr double allowed = 0.1;  // of an edge
  Union into(mesh.vertices.size());
  std::iota(into.begin(), into.end(), 0);
  for (const auto& [row, other] : edges)
    for (const std::size_t end : {0U, 1U}) {
      const auto& [a, b] = mesh.boundary[row].vertices;
      const double allowed_mm = allowed * (mesh.vertices[b] - mesh.vertices[a]).norm();
      const int v = mesh.boundary[row].vertices[end], twin = mesh.boundary[other].vertices[1 - end];
      const double apart_mm = (mesh.vertices[v] - mesh.vertices[twin]).norm();
      if (apart_mm > allowed_mm)
        refuse(place_of(pair), "are " + shown(apart_mm) + " mm apart",
               "at " + shown(mesh.vertices[v]) +
                   " (allowed for bonded faces: up to a tenth of an edge, " + shown(allowed_mm) +
                   " mm)");
      into[twin] = v;
    }
  for (std::size_t v = 0; v < into.size(); ++v)
    if (const int first = into[v]; first != static_cast<int>(v))
      mesh.vertices[first] = mesh.vertices[v] = (mesh.vertices[first] + mesh.vertices[v]) / 2;
  return into;
}

void renumber(Mesh& mesh, const Union& into) {
  std::vector<int> number(into.size());
  int count = 0;
  for (std::size_t v = 0; v < into.size(); ++v)
    if (into[v] == static_cast<int>(v)) {
      mesh.vertices[count] = mesh.vertices[v];
      number[v] = count++;
    }
  mesh.vertices.resize(count);
  const auto renumbered = [&](int& v) { v = number[into[v]]; };
  for (auto& triangle : mesh.triangles) std::ranges::for_each(triangle, renumbered);
  for (BoundaryEdge& edge : mesh.boundary) {
    std::ranges::for_each(edge.vertices, renumbered);
    if (!edge.curve.is_straight())
      edge.curve.move_ends(mesh.vertices[edge.vertices[0]], mesh.vertices[edge.vertices[1]]);
  }
}

void check_boundary(const Mesh& mesh, const ContactPair& pair) {
  std::vector<bool> starts(mesh.vertices.size(), false);
  for (const BoundaryEdge& edge : mesh.boundary) {
    const int v = edge.vertices[0];
    if (starts[v])
      refuse(place_of(pair), "make the boundary touch itself", "at " + shown(mesh.vertices[v]));
    starts[v] = true;
  }
}

void bond(Mesh& mesh, const ContactPair& pair, const Scene& scene) {
  const FaceMatching matching = match_faces(mesh, pair, scene);
  const std::vector<std::array<int, 2>> edges = facing_edges(mesh, pair, matching);
  renumber(mesh, unite(mesh, pair, edges));
  std::vector<bool> is_bonded(mesh.boundary.size(), false);
  for (const auto& both : edges)
    for (const int row : both) is_bonded[row] = true;
  free_unmet_edges(mesh, pair, is_bonded);
  std::size_t row = 0;
  std::erase_if(mesh.boundary, [&](const BoundaryEdge&) { return is_bonded[row++]; });
  check_boundary(mesh, pair);
}

}  // namespace

Mesh with_bonded_faces(Mesh mesh, const Scene& scene) {
  if (std::ranges::none_of(scene.contacts, &ContactPair::is_bonded)) return mesh;
  check_labels(mesh, scene.contacts);
  for (const ContactPair& pair : scene.contacts)
    if (pair.is_bonded()) bond(mesh, pair, scene);
  return mesh;
}

}  // namespace airybench
