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
  // between: without the common motion, which leaves no rounding.
  double displacement = 0, between = 0, stress = loads.body_force_N_per_mm3.stableNorm() * diameter;
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row) {
    const BoundaryEdge& edge = mesh.boundary[row];
    const auto &a = mesh.vertices[edge.vertices[0]], &b = mesh.vertices[edge.vertices[1]];
    const Eigen::Vector2d normal = edge_frame(a, b).normal;
    const auto size = [&](const Eigen::Vector2d& u0) {
      return problem.is_roller(row) ? std::abs(normal.dot(u0)) : u0.stableNorm();
    };
    for (const Eigen::Vector2d& x : {a, b}) {
      if (edge.role == BoundaryRole::displacement) {
        Eigen::Vector2d own(0, 0);
        if (loads.displacement_mm) own = loads.displacement_mm(x, row);
        between = std::max(between, size(own));
        displacement = std::max(displacement, size(problem.motion.at(x) + own));
      }
      // An interference acts as a displacement.
      if (edge.role == BoundaryRole::contact)
        between = std::max(between, -problem.offset_at(x, row).gap_mm);
      if (edge.role == BoundaryRole::force && loads.traction_MPa)
        stress = std::max(stress, loads.traction_MPa(x, normal, row).stableNorm());
    }
  }
  displacement = std::max(displacement, between);
  double thermal_strain = 0;
  if (!loads.thermal.empty())
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
      for (const int v : mesh.triangles[t])
        thermal_strain =
            std::max(thermal_strain, std::abs(problem.thermal_strain(t).at(mesh.vertices[v])));
  // Σ |T|/c, Σ |T| c and the largest 1/c, c = C_11 of each triangle.
  double stiffness = 0, compliance = 0, stiffest_MPa = 0;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    const double c = problem.compliance_of(t)(0, 0), area = problem.area_mm2(t);
    stiffness += area / c;
    compliance += area * c;
    stiffest_MPa = std::max(stiffest_MPa, 1 / c);
  }
  const auto energy_norm = [&](double strain) {
    return std::sqrt(strain * strain * stiffness + stress * stress * compliance);
  };
  const double strain = std::max(displacement / diameter, thermal_strain);
  LoadScale scale{.energy_norm = energy_norm(strain),
                  .force_N = diameter * (strain * stiffest_MPa + stress)};
  if ((!problem.opposite.empty() || !loads.thermal.empty()) && scale.energy_norm > 0)
    scale.rounding =
        1e-9 * energy_norm(std::max(between / diameter, thermal_strain)) / scale.energy_norm;
  return scale;
}

double relative_error(double error, double quantity, double scale) {
  return error == 0 ? 0 : error / (quantity > 0 ? quantity : scale);
}

double larger_error(double one, double other) {
  return one > other || std::isnan(one) ? one : other;
}

}  // namespace airybench
