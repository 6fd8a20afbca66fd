#include "assembly/problem/load_scale.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "assembly/elements/edge_forces.hpp"

namespace airybench {

LoadScale load_scale(const Problem& problem) {
  const Mesh& mesh = problem.mesh;
  const Loads& loads = problem.loads;
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& x : mesh.vertices) box.extend(x);
  const double diameter = box.diagonal().norm();
  double displacement = 0, stress = loads.body_force_N_per_mm3.stableNorm() * diameter;
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row) {
    const BoundaryEdge& edge = mesh.boundary[row];
    const auto &a = mesh.vertices[edge.vertices[0]], &b = mesh.vertices[edge.vertices[1]];
    const Eigen::Vector2d normal = edge_frame(a, b).normal;
    for (const Eigen::Vector2d& x : {a, b}) {
      if (edge.role == BoundaryRole::displacement) {
        Eigen::Vector2d u0 = problem.motion.at(x);
        if (loads.displacement_mm) u0 += loads.displacement_mm(x, row);
        displacement = std::max(
            displacement, problem.is_roller(row) ? std::abs(normal.dot(u0)) : u0.stableNorm());
      }
      // An interference acts as a displacement.
      if (edge.role == BoundaryRole::contact)
        displacement = std::max(displacement, -problem.offset_at(x, row).gap_mm);
      if (edge.role == BoundaryRole::force && loads.traction_MPa)
        stress = std::max(stress, loads.traction_MPa(x, normal, row).stableNorm());
    }
  }
  LoadScale scale;
  if (!problem.opposite.empty() || !loads.thermal.empty()) scale.rounding = 1e-11;
  double energy = 0;
  double strain = displacement / diameter;
  if (!loads.thermal.empty())
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
      for (const int v : mesh.triangles[t])
        strain = std::max(strain, std::abs(problem.thermal_strain(t).at(mesh.vertices[v])));
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    const double c = problem.compliance_of(t)(0, 0);
    energy += problem.area_mm2(t) * (strain * strain / c + c * stress * stress);
    scale.force_N = std::max(scale.force_N, strain * diameter / c + stress * diameter);
  }
  scale.energy_norm = std::sqrt(energy);
  return scale;
}

double relative_error(double error, double quantity, double scale) {
  return error == 0 ? 0 : error / (quantity > 0 ? quantity : scale);
}

double larger_error(double one, double other) {
  return one > other || std::isnan(one) ? one : other;
}

}  // namespace airybench
