#include "assembly/problem/matched_faces.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "assembly/problem/face_matching.hpp"
#include "mesh/transform_error.hpp"
#include "support/lists.hpp"

namespace airybench {
namespace {

using Point = Eigen::Vector2d;

double diagonal_mm(const Mesh& mesh) {
  const MeshExtent extent = extent_of(mesh);
  return std::hypot(extent.width_mm, extent.height_mm);
}

std::string place_of(const ContactPair& pair) { return "contacts: " + names_of(pair); }

void check_labels(const Mesh& mesh, const std::vector<ContactPair>& pairs) {
  std::set<std::string> groups, paired;
  for (const BoundaryEdge& edge : mesh.boundary)
    if (edge.role == BoundaryRole::contact) groups.insert(boundary_label(mesh, edge));
  const std::string valid = joined(groups);
  for (const ContactPair& pair : pairs)
    for (const std::vector<std::string>& labels : pair.between)
      for (const std::string& label : labels) {
        if (!groups.contains(label))
          refuse("contacts: between", label,
                 "is no contact group of the mesh " + mesh.name +
                     perhaps(label, {groups.begin(), groups.end()}) +
                     " (its contact groups: " + (valid.empty() ? "none" : valid) + ")");
        if (!paired.insert(label).second)
          refuse("contacts: between", label, "again (allowed: every group in one pair)");
      }
}

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

  // Sets the edges of both groups; returns how many pairs there are.
  int put_into(std::vector<std::optional<MatchedEdge>>& edges, double size_mm) const {
    std::map<int, int> row_at;  // of the second group, per start
    for (int row = 0; row < static_cast<int>(mesh_.boundary.size()); ++row)
      if (is_on(1, row)) row_at[mesh_.boundary[row].vertices[0]] = row;
    int count = 0;
    for (int row = 0; row < static_cast<int>(mesh_.boundary.size()); ++row) {
      if (!is_on(0, row)) continue;
      const auto [a, b] = mesh_.boundary[row].vertices;
      const auto start = matching_.twin.find(a), end = matching_.twin.find(b);
      if (start == matching_.twin.end() || end == matching_.twin.end()) continue;
      const auto other = row_at.find(end->second);
      if (other == row_at.end() || mesh_.boundary[other->second].vertices[1] != start->second)
        continue;
      ++count;
      put(row, other->second, size_mm, edges);
    }
    return count;
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
  bool is_on(int side, int row) const {
    return std::ranges::count(pair_.between[side], label(row)) > 0;
  }
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

void check_two_pieces(const Mesh& mesh, const ContactPair& pair,
                      const std::array<MatchingFace, 2>& faces) {
  const MeshPieces pieces = pieces_of(mesh);
  std::array<std::set<int>, 2> of;
  for (const int side : {0, 1})
    for (const auto& [v, n] : faces[side].normal) of[side].insert(pieces.of_vertex[v]);
  for (const int piece : of[0])
    if (of[1].contains(piece))
      refuse(place_of(pair), "are on one body",
             "of the mesh " + mesh.name + " (allowed: groups of different bodies)");
}

// No vertex is in two pairs, or in one and at a wall.
void check_apart(const Mesh& mesh, const ContactPair& pair,
                 const std::array<MatchingFace, 2>& faces) {
  for (const BoundaryEdge& edge : mesh.boundary) {
    const std::string label = boundary_label(mesh, edge);
    if (edge.role != BoundaryRole::contact || pair.has(label)) continue;
    for (const int v : edge.vertices)
      if (faces[0].normal.contains(v) || faces[1].normal.contains(v))
        refuse(place_of(pair), "meet " + label,
               "at the vertex " + shown(mesh.vertices[v]) +
                   " (allowed: pairs that share no vertex with other contact groups)");
  }
}

}  // namespace

MatchedFaces with_matched_faces(Mesh mesh, const Scene& scene) {
  MatchedFaces result;
  result.mesh = std::move(mesh);
  Mesh& changed = result.mesh;
  result.edges.resize(changed.boundary.size());
  if (scene.contacts.empty()) return result;
  check_labels(changed, scene.contacts);
  const double size_mm = diagonal_mm(changed);
  for (const ContactPair& pair : scene.contacts) {
    const std::array<MatchingFace, 2> faces = {face_of(changed, pair.between[0], scene),
                                               face_of(changed, pair.between[1], scene)};
    check_two_pieces(changed, pair, faces);
    check_apart(changed, pair, faces);
    const FaceMatching matching = match_faces(changed, faces, size_mm);
    if (matching.met_twice)
      refuse(place_of(pair), "meet twice",
             "at " + shown(*matching.met_twice) +
                 " (allowed: faces of which one place, at most, lies in front of another: no steps "
                 "or folds, and bodies side by side with a gap)");
    result.edges.resize(changed.boundary.size());
    const int count = PairedEdges(changed, pair, scene, matching).put_into(result.edges, size_mm);
    if (count == 0)
      throw TransformError(place_of(pair) +
                           " do not face each other (allowed: groups whose outward normals point "
                           "at each other)");
    result.changes.inserted += matching.changes.inserted;
    result.changes.moved += matching.changes.moved;
    for (const MatchingFace& face : faces)
      result.changes.has_curves |= std::ranges::any_of(face.curve, [](const auto& of_row) {
        return of_row.second && !std::holds_alternative<FlatWall>(*of_row.second);
      });
    for (const int row : matching.split_rows) result.split_rows.push_back(row);
  }
  for (const ContactPair& pair : scene.contacts)
    for (std::size_t row = 0; row < changed.boundary.size(); ++row) {
      BoundaryEdge& edge = changed.boundary[row];
      if (result.edges[row] || !pair.has(boundary_label(changed, edge))) continue;
      edge.role = BoundaryRole::force;
      edge.group = boundary_group(changed, out_of_reach);
    }
  return result;
}

}  // namespace airybench
