#include <algorithm>

#include "assembly/control_points.hpp"
#include "assembly/rough_compliance.hpp"
#include "bench/verify/verifier.hpp"

namespace airybench {
Verification verify_displacement(const DualSystem& system, const Solution& solution) {
  const Problem& problem = *system.problem;
  const ControlPoints control = control_points(problem);
  const int m = control.law.components;
  const LoadScale scale = load_scale(problem);
  const StressField stress = stress_of_displacement(problem, solution.displacement);
  NodalForces balance = nodal_forces(problem, stress);
  balance.sum -= nodal_loads(problem);

  Eigen::VectorXd displacement(control.law.size());
  for (int p = 0; p < control.law.count; ++p) {
    const Eigen::Matrix2d frame = control.frame(p);
    const int node = control.node[p];
    for (int k = 0; k < m; ++k) {
      const bool held = k == 1 && control.on_roller[p];
      displacement(m * p + k) = held ? 0 : frame.col(k).dot(solution.displacement.col(node));
      balance.sum.col(node) -= solution.F_C(m * p + k) * frame.col(k);
    }
  }
  const PrescribedDisplacement prescribed = prescribed_displacement(problem);
  for (const auto& [node, n] : prescribed.normal)  // what a roller gives
    balance.sum.col(node) -= n * n.dot(balance.sum.col(node));
  double unbalanced = 0;
  for (std::size_t node = 0; node < prescribed.at.size(); ++node)
    if (!prescribed.at[node])
      unbalanced = std::max(unbalanced, balance.sum.col(node).cwiseAbs().maxCoeff());

  Verification result;
  result.equilibrium_residual = relative_error(unbalanced, balance.largest, scale.force_N);
  result.strain_energy_Nmm = stress_norm_squared(problem, stress) / 2;
  result.unstressed = result.strain_energy_Nmm == 0;
  if (control.law.count > 0) {
    note_contact_forces(control.law, solution.F_C, result);
    note_contact_law(control.law, solution.F_C, displacement,
                     rough_compliance(problem, control.law), scale, result);
  }
  return result;
}

}  // namespace airybench
