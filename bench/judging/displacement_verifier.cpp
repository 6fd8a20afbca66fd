#include <algorithm>

#include "assembly/control_points.hpp"
#include "bench/judging/verifier.hpp"

namespace airybench {
namespace {

// What the stresses A ε(u) ask of the nodes, and what there is to give it.
struct NodalBalance {
  Eigen::Matrix2Xd unbalanced;  // Σ of the elements' nodal forces, less the loads, N
  Eigen::Matrix4Xd stiffness;   // per node: its 2×2 diagonal block of K, N/mm
  double largest = 0;           // nodal force of an element, N
};

NodalBalance nodal_balance(const Problem& problem, const StressField& stress) {
  NodalBalance balance;
  balance.unbalanced = -nodal_loads(problem);
  balance.stiffness = Eigen::Matrix4Xd::Zero(4, balance.unbalanced.cols());
  for (int t = 0; t < static_cast<int>(stress.size()); ++t) {
    const QuadraticStrain strain = quadratic_strain(problem.vertices_of(t));
    const double area = problem.area_mm2(t);
    Eigen::Matrix3d corners;  // the stress is linear: its values at the vertices say all
    corners << stress[t].col(0), stress[t].col(3), stress[t].col(6);
    const Eigen::Matrix3d dual = area / 12 * (corners.colwise() + corners.rowwise().sum());
    const Eigen::Matrix<double, 2, 6> force = (strain.transpose() * dual.reshaped()).reshaped(2, 6);
    balance.largest = std::max(balance.largest, force.cwiseAbs().maxCoeff());
    const QuadraticStiffness K = quadratic_stiffness(strain, area, elasticity_of(problem, t));
    const std::array<int, 6> nodes = triangle_nodes(problem, t);
    for (int m = 0; m < 6; ++m) {
      balance.unbalanced.col(nodes[m]) += force.col(m);
      balance.stiffness.col(nodes[m]).reshaped(2, 2) += K.block<2, 2>(2 * m, 2 * m);
    }
  }
  return balance;
}

}  // namespace

Verification verify_displacement(const DualSystem& system, const Solution& solution) {
  const Problem& problem = *system.problem;
  const ControlPoints control = control_points(problem);
  const int m = control.law.components;
  const LoadScale scale = load_scale(problem);
  const StressField stress = stress_of_displacement(problem, solution.displacement);
  NodalBalance balance = nodal_balance(problem, stress);

  Eigen::VectorXd displacement(control.law.size()), D_diagonal(control.law.size());
  for (int p = 0; p < control.law.count; ++p) {
    const Eigen::Matrix2d frame = control.frame(p);
    const int node = control.node[p];
    const Eigen::Matrix2d stiffness = balance.stiffness.col(node).reshaped(2, 2);
    for (int k = 0; k < m; ++k) {
      displacement(m * p + k) = frame.col(k).dot(solution.displacement.col(node));
      D_diagonal(m * p + k) = 1 / frame.col(k).dot(stiffness * frame.col(k));
      balance.unbalanced.col(node) -= solution.F_C(m * p + k) * frame.col(k);
    }
  }
  const std::vector<bool> prescribed = prescribed_displacement(problem).at;
  double unbalanced = 0;
  for (std::size_t node = 0; node < prescribed.size(); ++node)
    if (!prescribed[node])
      unbalanced = std::max(unbalanced, balance.unbalanced.col(node).cwiseAbs().maxCoeff());

  Verification result;
  result.equilibrium_residual = relative_error(unbalanced, balance.largest, scale.force_N);
  result.strain_energy_Nmm = stress_norm_squared(problem, stress) / 2;
  result.unstressed = result.strain_energy_Nmm == 0;
  if (control.law.count > 0) {
    note_contact_forces(control.law, solution.F_C, result);
    note_contact_law(control.law, solution.F_C, displacement, D_diagonal, scale, result);
  }
  return result;
}

}  // namespace airybench
