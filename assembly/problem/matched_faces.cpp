#include "assembly/problem/matched_faces.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "assembly/problem/contact_pairs.hpp"
#include "assembly/problem/face_curve.hpp"
#include "mesh/transform_error.hpp"
#include "support/lists.hpp"

namespace airybench {
namespace {

using Point = Eigen::Vector2d;

// Of all load steps.
double largest_interference_mm(const Scene& scene, const ContactPair& pair) {
  double least = std::min(0.0, pair.clearance_mm.value_or(0));
  for (const LoadStep& step : scene.later_steps)
    for (const ContactPair& changed : step.contacts)
      if (changed.between == pair.between)
        least = std::min(least, changed.clearance_mm.value_or(0));
  return -least;
}

std::set<int> vertices_on_rollers(const Mesh& mesh, const Scene& scene) {
  std::set<int> vertices;
  for (const BoundaryEdge& edge : mesh.boundary)
    if (const auto values = scene.boundary.find(boundary_label(mesh, edge));
        values != scene.boundary.end() && values->second.support == BoundaryValues::Support::normal)
      vertices.insert(edge.vertices.begin(), edge.vertices.end());
  return vertices;
}

class PairedEdges {
 public:
  PairedEdges(const Mesh& mesh, const ContactPair& pair, const Scene& scene,
              const FaceMatching& matching)
      : mesh_(mesh),
        pair_(pair),
        scene_(scene),
        matching_(matching),
        interference_mm_(largest_interference_mm(scene, pair)),
        on_rollers_(vertices_on_rollers(mesh, scene)) {}

  // Sets the edges of both groups.
  void put_into(std::vector<std::optional<MatchedEdge>>& edges, double size_mm) const {
    for (const auto& [row, other] : facing_edges(mesh_, pair_, matching_))
      put(row, other, size_mm, edges);
  }

 private:
  // Next to a roller that face's own, at a right angle to it: along the roller the node can move.
  Point common_normal(int first) const {
    const int second = matching_.twin.at(first);
    const Point &own = matching_.normal[0].at(first), &other = matching_.normal[1].at(second);
    const bool rolls = on_rollers_.contains(first), other_rolls = on_rollers_.contains(second);
    if (rolls != other_rolls) return rolls ? own : Point(-other);
    return (own - other).normalized();
  }
  std::string label(int row) const { return boundary_label(mesh_, mesh_.boundary[row]); }
  // From a point of an edge that stands for a curve to the curve.
  double to_curve(int row, const Point& x, const Point& n) const {
    const std::optional<Wall> curve = curve_of(mesh_, row, scene_);
    return curve ? distance_to_either_side(*curve, x, n).value_or(0) : 0;
  }
  void put(int row, int other, double size_mm,
           std::vector<std::optional<MatchedEdge>>& edges) const {
    const auto [a, b] = mesh_.boundary[row].vertices;
    const std::array<Point, 2> first = {mesh_.vertices[a], mesh_.vertices[b]},
                               second = {mesh_.vertices[matching_.twin.at(a)],
                                         mesh_.vertices[matching_.twin.at(b)]},
                               n = {common_normal(a), common_normal(b)};
    MatchedEdge of_first, of_second;
    of_first.opposite = other;
    of_second.opposite = row;
    const auto at = [](const std::array<Point, 2>& ends, double s) -> Point {
      return (1 - s) * ends[0] + s * ends[1];
    };
    for (int parts = 1; parts <= ContactNormals::max_parts; ++parts)
      for (int i = 0; i <= parts; ++i) {
        const Point normal = at(n, static_cast<double>(i) / parts).normalized();
        of_first.normals.at(i, parts) = normal;
        of_second.normals.at(parts - i, parts) = -normal;
      }
    for (int k = 0; k < 3; ++k) {
      const Point x = at(first, k / 2.), y = at(second, k / 2.), normal = of_first.normals.at(k, 2);
      const double gap =
          (y - x).dot(normal) - to_curve(row, x, normal) - to_curve(other, y, Point(-normal));
      of_first.gap_mm[k] = gap;
      constexpr double most = 0.1;
      if (const double overlap = interference_mm_ - gap; overlap > most * size_mm)
        refuse(place_of(pair_) + ": overlap by", shown(overlap) + " mm",
               "at " + shown(x) + " (allowed: up to a tenth of the mesh's size, " +
                   shown(most * size_mm) + " mm)");
    }
    for (const int side : {row, other})
      if (const std::optional<Wall> curve = curve_of(mesh_, side, scene_))
        check_face(mesh_, side, label(side), *curve, max_of_face * size_mm);
    edges[row] = of_first;
    edges[other] = of_second;
  }

  const Mesh& mesh_;
  const ContactPair& pair_;
  const Scene& scene_;
  const FaceMatching& matching_;
  double interference_mm_;
  std::set<int> on_rollers_;
};

// Faces of a crack: once matched, their vertices are in the same places, not nearly.
void close_crack(Mesh& mesh, const FaceMatching& matching) {
  constexpr double rounding = 1e-12;  // of the mesh's size
  const MeshPieces pieces = pieces_of(mesh);
  const double together_mm = rounding * extent_of(mesh).diagonal_mm();
  for (const auto& [v, twin] : matching.twin)
    if (pieces.of_vertex[v] == pieces.of_vertex[twin] &&
        (mesh.vertices[v] - mesh.vertices[twin]).norm() <= together_mm)
      mesh.vertices[twin] = mesh.vertices[v];
}

}  // namespace

MatchedFaces with_matched_faces(Mesh mesh, const Scene& scene) {
  MatchedFaces result;
  result.mesh = std::move(mesh);
  Mesh& changed = result.mesh;
  result.edges.resize(changed.boundary.size());
  std::vector<ContactPair> pairs = scene.contacts;
  std::erase_if(pairs, &ContactPair::is_bonded);
  if (pairs.empty()) return result;
  check_labels(changed, pairs);
  const double size_mm = extent_of(changed).diagonal_mm();
  for (const ContactPair& pair : pairs) {
    const FaceMatching matching = match_faces(changed, pair, scene);
    close_crack(changed, matching);
    result.edges.resize(changed.boundary.size());
    PairedEdges(changed, pair, scene, matching).put_into(result.edges, size_mm);
    result.changes.inserted += matching.changes.inserted;
    result.changes.moved += matching.changes.moved;
    result.changes.has_curves |= matching.changes.has_curves;
    for (const int row : matching.split_rows) result.split_rows.push_back(row);
  }
  std::vector<bool> is_met;
  for (const std::optional<MatchedEdge>& edge : result.edges) is_met.push_back(edge.has_value());
  for (const ContactPair& pair : pairs) free_unmet_edges(changed, pair, is_met);
  return result;
}

}  // namespace airybench
