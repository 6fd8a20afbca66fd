#include "assembly/problem/point_supports.hpp"

namespace airybench {

std::optional<PlaceInMesh> place_in_mesh(const Mesh& mesh, const PointSupport& point) {
  constexpr double beyond_a_chord = 0.05;  // of a triangle's height
  std::optional<PlaceInMesh> nearest;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    if (!point.body.empty() && mesh.body_names[mesh.triangle_body[t]] != point.body) continue;
    const auto& [a, b, c] = mesh.triangles[t];
    const auto &x = mesh.vertices[a], &y = mesh.vertices[b], &z = mesh.vertices[c];
    const Eigen::Vector3d areas(cross_area(y, z, point.at_mm), cross_area(z, x, point.at_mm),
                                cross_area(x, y, point.at_mm));
    const Eigen::Vector3d lambda = areas / cross_area(x, y, z);
    if (lambda.minCoeff() < -beyond_a_chord) continue;
    if (!nearest || lambda.minCoeff() > nearest->lambda.minCoeff()) nearest = {t, lambda};
  }
  return nearest;
}

}  // namespace airybench
