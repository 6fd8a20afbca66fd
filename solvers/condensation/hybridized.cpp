#include "solvers/condensation/hybridized_templates.hpp"

#include <algorithm>
#include <cmath>

namespace airybench {

HybridizedAnswer recover_stresses(const Problem& problem, const HybridizedSystem& system,
                                  const Eigen::VectorXd& u) {
  HybridizedAnswer answer;
  answer.stress = StressField(problem.mesh.triangles.size(), system.degree());
  UnbalancedForces& unbalanced = answer.unbalanced;
  {
    const OwnerScope scope(MemoryOwner::check);
    unbalanced.r.setZero(system.b.size());
    unbalanced.defect.setZero(system.b.size());
  }
  add_tractions(problem, system.unknown, unbalanced.r);
  std::vector<int> unknowns;
  visit_stresses<double>(
      problem, system, u, [&](int t, const StressOfTriangle<double>& of_triangle) {
        auto stress = answer.stress[static_cast<std::size_t>(t)];
        std::copy_n(of_triangle.stress, stress.size(), stress.data());
        unbalanced.defect_energy += std::max(0.0, of_triangle.defect_energy);
        element_unknowns(problem, system.unknown, t, unknowns);
        for (std::size_t k = 0; k < unknowns.size(); ++k) {
          unbalanced.largest = std::max(unbalanced.largest, std::abs(of_triangle.forces[k]));
          if (unknowns[k] == prescribed_unknown) continue;
          unbalanced.r(unknowns[k]) -= of_triangle.forces[k];
          unbalanced.defect(unknowns[k]) -= of_triangle.defect[k];
        }
      });
  return answer;
}

template struct HybridizedSystemIn<double>;
template HybridizedSystemIn<double> assemble_hybridized(const Problem&, const ContactPoints&);
template void set_load_case(const Problem&, HybridizedSystemIn<double>&);
template PrescribedForces<double> prescribed_forces(const Problem&, const HybridizedSystem&);

template struct HybridizedSystemIn<Wide>;
template HybridizedSystemIn<Wide> assemble_hybridized(const Problem&, const ContactPoints&);
template StressField hybridized_stress(const Problem&, const HybridizedSystemIn<Wide>&,
                                       const Eigen::VectorX<Wide>&);

}  // namespace airybench
