#include "assembly/stress_field_templates.hpp"

#include <cmath>

namespace airybench {

StressField stress_of_airy_function(const Problem& problem, const Eigen::VectorXd& phi) {
  const auto vertices = static_cast<Eigen::Index>(problem.mesh.vertices.size());
  StressField field(problem.mesh.triangles.size());
  for (int t = 0; t < static_cast<int>(field.size()); ++t) {
    const TriangleVertices v = problem.vertices_of(t);
    const auto& corner = problem.mesh.triangles[t];
    Eigen::Matrix<double, 12, 1> local;
    for (int k = 0; k < 3; ++k) {
      local.segment<3>(3 * k) = phi.segment<3>(3 * corner[k]);
      local(9 + k) = phi(3 * vertices + problem.edges.of_triangle[t][k]);
    }
    const EdgeSigns outward = problem.edge_signs(t);
    subtract_affine_part(v, outward, local);
    const HctStress from_dofs = hct_stress(v, outward);
    field[t].reshaped() = from_dofs.lazyProduct(local);
    if (problem.loads.has_body_force()) field[t] += particular_element_stress(problem, t);
  }
  return field;
}

double stress_norm_squared(const Problem& problem, const StressField& stress) {
  double sum = 0;
  for (int t = 0; t < static_cast<int>(stress.size()); ++t)
    sum += stress[t]
               .cwiseProduct(stress_dual(stress[t], problem.area_mm2(t), problem.compliance_of(t)))
               .sum();
  return sum;
}

double stress_distance(const Problem& problem, const StressField& stress,
                       const StressField& other) {
  StressField difference(stress.size());
  for (std::size_t t = 0; t < stress.size(); ++t) difference[t] = stress[t] - other[t];
  return std::sqrt(stress_norm_squared(problem, difference));
}

template ElementStressIn<double> particular_element_stress(const Problem&, int);
template ElementStressIn<double> stress_dual(const ElementStressIn<double>&, double,
                                             const Eigen::Matrix3d&);
template Eigen::Matrix2<double> element_edge_forces(const TriangleVertices&,
                                                    const ElementStressIn<double>&, int);
template void subtract_affine_part(const TriangleVertices&, const EdgeSigns&,
                                   Eigen::Matrix<double, 12, 1>&);
template void subtract_affine_part(const TriangleVertices&, const EdgeSigns&,
                                   Eigen::Matrix<long double, 12, 1>&);
template ElementStressIn<long double> particular_element_stress(const Problem&, int);
template ElementStressIn<long double> stress_dual(const ElementStressIn<long double>&, long double,
                                                  const Eigen::Matrix3d&);
template Eigen::Matrix2<long double> element_edge_forces(const TriangleVertices&,
                                                         const ElementStressIn<long double>&, int);

}  // namespace airybench
