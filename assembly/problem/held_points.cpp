#include "assembly/problem/held_points.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <set>

#include "assembly/problem/scene_errors.hpp"
#include "support/lists.hpp"

namespace airybench {
namespace {

constexpr const char* key_of_points = "point_supports";

Eigen::Index rank(const Eigen::MatrixXd& matrix) {
  constexpr double dependent = 1e-6;
  if (matrix.size() == 0) return 0;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(matrix);
  return qr.setThreshold(dependent).rank();
}

bool has_contact(const Problem& problem, int piece) {
  return std::ranges::any_of(problem.mesh.boundary, [&](const BoundaryEdge& edge) {
    return edge.role == BoundaryRole::contact &&
           problem.free.piece_of_vertex[edge.vertices[0]] == piece;
  });
}

}  // namespace

bool are_independent(const Eigen::MatrixXd& rows) { return rank(rows) == rows.rows(); }

HeldPoints held_points(const Problem& problem) {
  HeldPoints held;
  for (const PointSupport& point : problem.loads.points)
    for (int k = 0; k < 2; ++k)
      if (point.displacement_mm[k])
        held.rows.push_back(
            {point.at_mm, k, *point.displacement_mm[k], *place_in_mesh(problem.mesh, point)});
  const std::vector<FreeMotion>& motions = problem.free.motions;
  held.of_motions = Eigen::MatrixXd::Zero(std::ssize(held.rows), std::ssize(motions));
  for (Eigen::Index row = 0; row < held.of_motions.rows(); ++row)
    for (Eigen::Index m = 0; m < held.of_motions.cols(); ++m) {
      const HeldPoints::Row& own = held.rows[row];
      const int vertex = problem.mesh.triangles[own.place.triangle][0];
      if (problem.free.piece_of_vertex[vertex] == motions[m].piece)
        held.of_motions(row, m) = motions[m].of_one_mm.at(own.at_mm)(own.component);
    }
  return held;
}

void check_point_supports(const Scene& scene, const Mesh& mesh) {
  const MeshPieces pieces = pieces_of(mesh);
  for (const PointSupport& point : scene.point_supports) {
    const auto refuse = [&](const std::string& why) {
      fail(scene, key_of_points, shown(point.at_mm), why);
    };
    if (!point.displacement_mm[0] && !point.displacement_mm[1])
      refuse("holds nothing (allowed: displacement_mm, a number for x, for y, or for both)");
    if (!point.body.empty() && std::ranges::count(mesh.body_names, point.body) == 0)
      refuse("of the body " + point.body + ", which the mesh " + mesh.name +
             " has not (its bodies: " + joined(mesh.body_names) + ")");
    if (!place_in_mesh(mesh, point))
      refuse("lies off " +
             (point.body.empty() ? "the mesh " + mesh.name : "the body " + point.body));
    if (!point.body.empty()) continue;
    std::set<int> in_pieces;
    std::set<std::string> in_bodies;
    for (std::size_t body = 0; body < mesh.body_names.size(); ++body) {
      PointSupport there = point;
      there.body = mesh.body_names[body];
      constexpr double touching = 1e-6;
      const auto place = place_in_mesh(mesh, there);
      if (!place || place->lambda.minCoeff() < -touching) continue;
      in_pieces.insert(pieces.of_vertex[mesh.triangles[place->triangle][0]]);
      in_bodies.insert(there.body);
    }
    if (in_pieces.size() > 1)
      refuse("lies in the bodies " + joined(in_bodies) + " (allowed: body, the one that is held)");
  }
}

void check_point_supports(const Scene& scene, const std::string& prefix, const Problem& problem) {
  const std::string key = prefix + key_of_points;
  const HeldPoints held = held_points(problem);
  const Eigen::MatrixXd& B = held.of_motions;
  for (Eigen::Index row = 0; row < B.rows(); ++row)
    if (!are_independent(B.topRows(row + 1)))
      fail(scene, key, shown(held.rows[row].at_mm),
           std::string("holds ") + (held.rows[row].component == 0 ? "x" : "y") +
               ", which displacement edges or other points hold: it would carry a force, and the "
               "stress of a force in a point is infinite (allowed: points that take out a rigid "
               "motion; edges carry forces)");
  const std::vector<FreeMotion>& motions = problem.free.motions;
  for (Eigen::Index first = 0, count = 0; first < B.cols(); first += count) {
    const int piece = motions[first].piece;
    count = std::ranges::count(motions, piece, &FreeMotion::piece);
    if (!has_contact(problem, piece) && rank(B.middleCols(first, count)) < count)
      fail(scene, key, name_of_piece(problem.mesh, problem.free.piece_of_vertex, piece),
           "is free to " + std::string(count == 1 ? "move along its rollers" : "move or turn") +
               " (allowed: as many components as hold it, " +
               (count == 1 ? "one" : "three in two points") + ")");
  }
}

}  // namespace airybench
