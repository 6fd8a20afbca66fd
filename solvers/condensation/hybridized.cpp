#include "solvers/condensation/hybridized_templates.hpp"

#include <algorithm>

namespace airybench {

HybridizedAnswer recover_stresses(const Problem& problem, const HybridizedSystem& system,
                                  const Eigen::VectorXd& u) {
  HybridizedAnswer answer;
  answer.stress.resize(problem.mesh.triangles.size());
  answer.defect.setZero(system.b.size());
  visit_stresses(
      problem, system, u,
      [&](int t, const HybridElement<double>& element, const auto& local,
          const std::array<int, 12>& unknown, const ElementStress& stress) {
        answer.stress[t] = stress;
        const Eigen::Matrix<double, 9, 1> g = element.incompatibility(problem, t, local, stress);
        Eigen::Matrix<double, 9, 1> phi = g;
        element.flexibility.solve(phi);
        answer.defect_energy += std::max(0.0, g.dot(phi));
        const Eigen::Matrix<double, 12, 1> forces = element.forces.transpose().lazyProduct(phi);
        for (int k = 0; k < 12; ++k)
          if (unknown[k] != prescribed_unknown) answer.defect(unknown[k]) -= forces(k);
      });
  return answer;
}

UnbalancedForces unbalanced_forces(const Problem& problem, const HybridizedSystem& system,
                                   const StressField& stress, const Eigen::VectorXd& F_C) {
  const std::vector<bool> in_frame = edges_in_frame(problem);
  UnbalancedForces result;
  result.r.setZero(system.b.size());
  add_tractions(problem, system.unknown, result.r);
  result.r.tail(system.n_c) += F_C;
  for (int t = 0; t < static_cast<int>(stress.size()); ++t)
    for (int k = 0; k < 3; ++k) {
      const int edge = problem.edges.of_triangle[t][k];
      const Eigen::Vector4d forces =
          edge_components(problem.mesh, t, k, in_frame[edge]).transpose() *
          element_edge_forces(problem.vertices_of(t), stress[t], k).reshaped();
      result.largest = std::max(result.largest, forces.cwiseAbs().maxCoeff());
      for (int i = 0; i < 4; ++i)
        if (const int unknown = system.unknown[edge][i]; unknown != prescribed_unknown)
          result.r(unknown) -= forces(i);
    }
  return result;
}

template struct HybridizedSystemIn<double>;
template HybridizedSystemIn<double> assemble_hybridized(const Problem&, const ContactPoints&);
template StressField hybridized_stress(const Problem&, const HybridizedSystemIn<double>&,
                                       const Eigen::VectorX<double>&);

template struct HybridizedSystemIn<long double>;
template HybridizedSystemIn<long double> assemble_hybridized(const Problem&, const ContactPoints&);
template StressField hybridized_stress(const Problem&, const HybridizedSystemIn<long double>&,
                                       const Eigen::VectorX<long double>&);

}  // namespace airybench
