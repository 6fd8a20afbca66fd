#include "assembly/problem/contact_conditions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "assembly/elements/edge_forces.hpp"
#include "assembly/problem/contact_pairs.hpp"
#include "assembly/problem/face_curve.hpp"
#include "mesh/transform_error.hpp"

namespace airybench {
namespace {

using ThreePoints = std::array<double, 3>;  // at start, middle and end of an edge

struct EdgeValues {
  double friction, clearance_mm;
  const std::optional<Wall>& wall;
  std::optional<Wall> face;
};

EdgeValues values_of(const Mesh& mesh, int row, const Scene& scene) {
  static const ContactValues none;
  static const std::optional<Wall> no_wall;
  const std::string label = boundary_label(mesh, mesh.boundary[row]);
  for (const ContactPair& pair : scene.contacts)
    if (pair.has(label))
      return {pair.friction.value_or(scene.friction),
              pair.has_first(label) ? pair.clearance_mm.value_or(0) : 0,
              no_wall,
              {}};
  const auto given = scene.boundary.find(label);
  const ContactValues& own = given == scene.boundary.end() ? none : given->second.contact;
  return {own.friction.value_or(scene.friction), own.clearance_mm.value_or(scene.clearance_mm),
          own.wall ? own.wall : scene.wall, curve_of(mesh, row, scene)};
}

std::array<Eigen::Vector2d, 3> points_of(const Mesh& mesh, int row) {
  const auto [start, end] = mesh.boundary[row].vertices;
  const auto &a = mesh.vertices[start], &b = mesh.vertices[end];
  return {a, (a + b) / 2, b};
}

FacingEdge facing(const Mesh& mesh, int row, const EdgeValues& values) {
  const std::array<Eigen::Vector2d, 3> x = points_of(mesh, row);
  return {x[0], x[2], edge_frame(x[0], x[2]).normal, *values.wall, values.face};
}

// Distances from face to wall without clearance. A point that meets no wall gets the largest of the
// other two; if none does, the largest between them.
ThreePoints wall_distances(const FacingEdge& edge, const std::vector<GapPiece>& pieces) {
  const std::array<std::optional<double>, 3> met = {edge.gap_mm(0), edge.gap_mm(0.5),
                                                    edge.gap_mm(1)};
  double largest = -std::numeric_limits<double>::infinity();
  for (const std::optional<double>& gap : met) largest = std::max(largest, gap.value_or(largest));
  if (std::isinf(largest))
    for (const GapPiece& piece : pieces)
      if (piece.is_met) largest = std::max({largest, piece.gap_mm[0], piece.gap_mm[2]});
  return {met[0].value_or(largest), met[1].value_or(largest), met[2].value_or(largest)};
}

bool is_reached(const std::vector<GapPiece>& pieces, double reach_mm) {
  return std::ranges::any_of(pieces, [&](const GapPiece& piece) {
    return piece.is_met &&
           std::min(std::abs(piece.gap_mm[0]), std::abs(piece.gap_mm[2])) <= reach_mm;
  });
}

void check_interference(const std::string& label, const Eigen::Vector2d& at, double gap_mm,
                        double diameter_mm) {
  constexpr double most = 0.1;
  if (gap_mm >= -most * diameter_mm) return;
  refuse(label + ": wall", "lies " + shown(-gap_mm) + " mm inside the body",
         "at " + shown(at) + " (allowed: up to a tenth of its size, " + shown(most * diameter_mm) +
             " mm)");
}

struct EdgeGap {
  double clearance_mm = 0;
  Eigen::Vector2d middle = {0, 0};  // middle of the crown
  double curvature = 0;
  std::optional<ThreePoints> given;  // of a wall or another body, in place of the crown
  Eigen::Vector2d start = {0, 0}, along = {0, 0};  // s = (x − start)·along

  double at(const Eigen::Vector2d& x) const {
    if (!given) return clearance_mm + (x - middle).squaredNorm() * curvature / 2;
    const double s = (x - start).dot(along);
    const auto& [a, m, b] = *given;
    return clearance_mm + a * (1 - s) * (1 - 2 * s) + 4 * m * s * (1 - s) + b * s * (2 * s - 1);
  }
  bool is_zero() const {
    return clearance_mm == 0 && (given ? *given == ThreePoints{0, 0, 0} : curvature == 0);
  }
};

}  // namespace

ReachableContact with_reachable_contact(MatchedFaces faces, const Scene& scene) {
  constexpr double farthest = 100;
  Mesh& mesh = faces.mesh;
  std::vector<std::vector<GapPiece>> pieces_of_row(mesh.boundary.size());
  const double diameter = extent_of(mesh).diagonal_mm();
  std::vector<int> free;
  std::map<std::string, int> met;  // edges that reach their wall, per group
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row) {
    if (mesh.boundary[row].role != BoundaryRole::contact || faces.edges[row]) continue;
    const std::string label = boundary_label(mesh, mesh.boundary[row]);
    const EdgeValues values = values_of(mesh, row, scene);
    if (!values.wall) continue;
    const FacingEdge edge = facing(mesh, row, values);
    std::vector<GapPiece>& pieces = pieces_of_row[static_cast<std::size_t>(row)];
    pieces = gap_pieces(edge);
    const bool reached = is_reached(pieces, farthest * diameter);
    met[label] += reached ? 1 : 0;
    if (!reached) {
      free.push_back(row);
      continue;
    }
    if (values.face) check_face(mesh, row, label, *values.face, max_of_face * diameter);
    for (const GapPiece& piece : pieces) {  // without clearance, which load steps may change
      if (!piece.is_met) continue;
      check_interference(label, edge.at(piece.start), piece.gap_mm[0], diameter);
      check_interference(label, edge.at(piece.end), piece.gap_mm[2], diameter);
    }
  }
  for (const auto& [label, count] : met)
    if (count == 0)
      throw TransformError(label +
                           ": wall: no edge meets it (allowed: a wall that lies in the direction "
                           "of the edges' outward normals, its free side towards them)");
  for (const int row : free) {
    mesh.boundary[row].role = BoundaryRole::force;
    mesh.boundary[row].group = boundary_group(mesh, out_of_reach);
  }
  return {std::move(mesh), std::move(faces.edges), faces.changes, std::move(pieces_of_row)};
}

ContactGap contact_gap(const ReachableContact& contact, const Scene& scene) {
  constexpr double rounding = 1e-12;
  const Mesh& mesh = contact.mesh;
  std::vector<EdgeGap> gaps(mesh.boundary.size());
  ContactGap result;
  result.detail.resize(mesh.boundary.size());
  const double curvature = scene.crown_radius_mm ? 1 / *scene.crown_radius_mm : 0;
  for (const std::vector<int>& chain : boundary_chains(mesh, BoundaryRole::contact)) {
    const Eigen::Vector2d middle =
        (points_of(mesh, chain.front())[0] + points_of(mesh, chain.back())[2]) / 2;
    for (const int row : chain) {
      const EdgeValues values = values_of(mesh, row, scene);
      EdgeGap& gap = gaps[static_cast<std::size_t>(row)];
      const auto [a, m, b] = points_of(mesh, row);
      gap.start = a;
      gap.along = (b - a) / (b - a).squaredNorm();
      gap.clearance_mm = values.clearance_mm;
      if (const auto& edge = contact.matched[row]) {
        gap.given = edge->gap_mm;
        continue;
      }
      gap.middle = middle;
      gap.curvature = curvature;
      if (!values.wall) continue;
      const std::vector<GapPiece>& pieces = contact.pieces[static_cast<std::size_t>(row)];
      gap.given = wall_distances(facing(mesh, row, values), pieces);
      const WallDetail detail = wall_detail(pieces, *gap.given);
      if (!detail.is_nothing(rounding * (b - a).norm()))
        result.detail[static_cast<std::size_t>(row)] = detail;
    }
  }
  if (std::ranges::all_of(result.detail, [](const WallDetail& d) { return d.is_nothing(0); }))
    result.detail.clear();
  if (!std::ranges::all_of(gaps, &EdgeGap::is_zero))
    result.gap_mm = [gaps = std::move(gaps)](const Eigen::Vector2d& x, int row) {
      return gaps[static_cast<std::size_t>(row)].at(x);
    };
  return result;
}

std::vector<ContactNormals> contact_normals(const ReachableContact& contact, const Scene& scene) {
  const Mesh& mesh = contact.mesh;
  std::vector<ContactNormals> normals(mesh.boundary.size());
  bool are_own = true;
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row) {
    if (mesh.boundary[row].role != BoundaryRole::contact) continue;
    const EdgeValues values = values_of(mesh, row, scene);
    const auto [start, end] = mesh.boundary[row].vertices;
    const Eigen::Vector2d &a = mesh.vertices[start], &b = mesh.vertices[end],
                          m = edge_frame(a, b).normal;
    const auto at = [&](const Eigen::Vector2d& x) {
      if (values.wall) return facing(mesh, row, values).direction_at(x);
      return values.face ? normal_of_curve(*values.face, x, m) : m;
    };
    constexpr double rounding = 1e-12;
    ContactNormals& along = normals[static_cast<std::size_t>(row)];
    const auto& matched = contact.matched[row];
    along = matched ? matched->normals
                    : ContactNormals::along([&](double s) { return at((1 - s) * a + s * b); });
    for (const Eigen::Vector2d& normal : along.all()) are_own &= (normal - m).norm() <= rounding;
  }
  if (are_own) normals.clear();
  return normals;
}

std::vector<ContactNormals> curve_normals(const ReachableContact& contact, const Scene& scene) {
  const Mesh& mesh = contact.mesh;
  std::vector<ContactNormals> normals;
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row) {
    const BoundaryEdge& edge = mesh.boundary[row];
    if (edge.role != BoundaryRole::contact || edge.curve.is_straight()) continue;
    const auto& matched = contact.matched[row];
    if (matched && mesh.boundary[matched->opposite].curve.is_straight()) continue;
    const EdgeValues values = values_of(mesh, row, scene);
    const auto at = [&](double xi) -> Eigen::Vector2d {
      const Eigen::Vector2d n = edge.curve.normal(xi);
      if (matched) return (n - mesh.boundary[matched->opposite].curve.normal(1 - xi)).normalized();
      const Eigen::Vector2d x = edge.curve.at(xi);
      if (values.wall) return facing(mesh, row, values).direction_at(x);
      return values.face ? normal_of_curve(*values.face, x, n) : n;
    };
    normals.resize(mesh.boundary.size());
    normals[static_cast<std::size_t>(row)] = ContactNormals::along(at);
  }
  return normals;
}

std::vector<double> contact_friction(const ReachableContact& contact, const Scene& scene) {
  const Mesh& mesh = contact.mesh;
  std::vector<double> friction(mesh.boundary.size(), 0);
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row)
    if (mesh.boundary[row].role == BoundaryRole::contact)
      friction[static_cast<std::size_t>(row)] = values_of(mesh, row, scene).friction;
  return friction;
}

std::vector<int> opposite_edges(const ReachableContact& contact) {
  std::vector<int> opposite;
  for (const std::optional<MatchedEdge>& edge : contact.matched)
    opposite.push_back(edge ? edge->opposite : Problem::no_row);
  if (std::ranges::all_of(opposite, [](int row) { return row == Problem::no_row; }))
    opposite.clear();
  return opposite;
}

}  // namespace airybench
