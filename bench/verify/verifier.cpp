#include "bench/verify/verifier.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "assembly/edge_forces.hpp"
#include "assembly/rough_compliance.hpp"
#include "bench/verify/moments_check.hpp"
#include "solvers/base/dense_products.hpp"
#include "solvers/contact/coulomb_law.hpp"

namespace airybench {
namespace {

// What the element stresses say of the edges. Sums over an edge's elements: at its low and high
// vertex (columns), x and y (rows), N.
struct EdgeBalance {
  std::vector<Eigen::Matrix2d> sum;
  double largest = 0;     // of all forces that went in, N
  double divergence = 0;  // largest resultant of ∇·σ + b in a third, N
};

EdgeBalance edge_balance(const Problem& problem, const StressField& stress) {
  EdgeBalance balance;
  balance.sum.assign(static_cast<std::size_t>(problem.edges.count()), Eigen::Matrix2d::Zero());
  for (int t = 0; t < static_cast<int>(stress.size()); ++t) {
    TriangleVertices v = problem.vertices_of(t);
    v.colwise() -= v.col(0).eval();  // a body far from the origin keeps its digits
    const Eigen::Vector2d centroid = v.rowwise().mean();
    for (int k = 0; k < 3; ++k) {
      const int a = problem.mesh.triangles[t][k], b = problem.mesh.triangles[t][(k + 1) % 3];
      const Eigen::Matrix2d force = element_edge_forces(v, stress[t], k);
      balance.largest = std::max(balance.largest, force.cwiseAbs().maxCoeff());
      auto& sum = balance.sum[problem.edges.of_triangle[t][k]];
      if (a < b)
        sum += force;
      else
        sum += force.rowwise().reverse();

      // ∫ (∇·σ + b) over the third = Σ of its sides' tractions + b · area, side by side.
      const std::array<Eigen::Vector2d, 3> corner = {v.col(k), v.col((k + 1) % 3), centroid};
      Eigen::Vector2d resultant = problem.area_mm2(t) / 3 * problem.loads.body_force_N_per_mm3;
      for (int side = 0; side < 3; ++side) {
        const int next = (side + 1) % 3;
        const EdgeFrame frame = edge_frame(corner[side], corner[next]);
        resultant +=
            frame.length_mm / 2 *
            traction(stress[t].col(3 * k + side) + stress[t].col(3 * k + next), frame.normal);
      }
      balance.divergence = std::max(balance.divergence, resultant.cwiseAbs().maxCoeff());
    }
  }
  return balance;
}

// Force on a boundary edge as the walk of Mesh::boundary has it: at its start, at its end.
Eigen::Matrix2d walked(const Problem& problem, const EdgeBalance& balance, int row) {
  const auto [a, b] = problem.mesh.boundary[row].vertices;
  const Eigen::Matrix2d& sum = balance.sum[problem.edges.of_boundary[row]];
  return a < b ? sum : Eigen::Matrix2d(sum.rowwise().reverse());
}

double equilibrium_residual(const DualSystem& system, const Solution& solution,
                            const EdgeBalance& balance, const LoadScale& scale) {
  const Problem& problem = *system.problem;
  const Mesh& mesh = problem.mesh;
  double unbalanced = balance.divergence;
  std::vector<bool> on_boundary(balance.sum.size(), false);
  int point = 0;
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row) {
    on_boundary[problem.edges.of_boundary[row]] = true;
    const BoundaryRole role = mesh.boundary[row].role;
    if (role == BoundaryRole::displacement && !problem.is_roller(row)) continue;
    const auto &a = mesh.vertices[mesh.boundary[row].vertices[0]],
               &b = mesh.vertices[mesh.boundary[row].vertices[1]];
    const EdgeFrame frame = edge_frame(a, b);
    Eigen::Matrix2d expected = Eigen::Matrix2d::Zero();
    if (role == BoundaryRole::force && problem.loads.traction_MPa) {
      expected << problem.loads.traction_MPa(a, frame.normal, row),
          problem.loads.traction_MPa(b, frame.normal, row);
      expected *= frame.length_mm / 2;
    } else if (role == BoundaryRole::contact) {
      const int m = system.contact.components;
      for (int end = 0; end < 2; ++end, ++point) {
        const EdgeFrame of_law = problem.frame_of_moment(row, end);
        expected.col(end) = solution.F_C(m * point) * of_law.normal;
        if (m == 2) expected.col(end) += solution.F_C(m * point + 1) * of_law.tangent;
      }
    }
    Eigen::Matrix2d off = walked(problem, balance, row) - expected;
    if (problem.is_roller(row))  // its normal force is free
      off = frame.tangent * (frame.tangent.transpose() * off).eval();
    unbalanced = std::max(unbalanced, off.cwiseAbs().maxCoeff());
  }
  for (std::size_t edge = 0; edge < balance.sum.size(); ++edge)
    if (!on_boundary[edge])
      unbalanced = std::max(unbalanced, balance.sum[edge].cwiseAbs().maxCoeff());
  return relative_error(unbalanced, balance.largest, scale.force_N);
}

// ∫_{Γ_D} u0·σn.
double work_of_prescribed_displacement(const Problem& problem, const EdgeBalance& balance) {
  if (!problem.loads.displacement_mm) return 0;
  double work = 0;
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row) {
    if (problem.mesh.boundary[row].role != BoundaryRole::displacement) continue;
    const auto [start, end] = problem.prescribed_moments(row);
    const Eigen::Matrix2d force = walked(problem, balance, row);
    work += start.dot(force.col(0)) + end.dot(force.col(1));
  }
  return work;
}

void verify_contact(const ContactPoints& contact, const Solution& solution,
                    const Reference* reference, const LoadScale& scale, Verification& result) {
  const Eigen::VectorXd& F = solution.F_C;
  note_contact_forces(contact, F, result);
  if (reference == nullptr) return;
  const CondensedSystem& condensed = reference->condensed;
  note_contact_law(contact, F, times(condensed.D, F) - condensed.G, condensed.D.diagonal(), scale,
                   result);
  result.error_force = relative_error(D_norm(condensed.D, F - reference->F_C),
                                      D_norm(condensed.D, reference->F_C), scale.energy_norm);
  if (contact.components == 2) result.friction_coupling = friction_coupling(contact, condensed.D);
}

void verify_moments(const DualSystem& system, const Solution& solution, const LoadScale& scale,
                    Verification& result) {
  const MomentsCheck check = check_moments(system, solution.edge_moments);
  result.stress_of_moments_off = relative_error(
      stress_distance(*system.problem, solution.stress, check.stress),
      std::sqrt(stress_norm_squared(*system.problem, solution.stress)), scale.energy_norm);
  if (system.contact.count > 0)
    note_contact_law(system.contact, solution.F_C, check.contact_displacement,
                     rough_compliance(*system.problem, system.contact), scale, result);
}

double work_of_gap(const ContactPoints& contact, const Eigen::VectorXd& F_C) {
  return contact.gap.size() > 0 ? contact.gap.dot(F_C) : 0;
}

}  // namespace

double friction_coupling(const ContactPoints& contact, const Eigen::MatrixXd& D) {
  double coupling = 0;
  for (int p = 0; p < contact.count; ++p)
    coupling = std::max(coupling,
                        contact.friction_at(p) * std::abs(D(2 * p, 2 * p + 1)) / D(2 * p, 2 * p));
  return coupling;
}

void note_contact_forces(const ContactPoints& contact, const Eigen::VectorXd& F,
                         Verification& result) {
  const int m = contact.components;
  double normal = 0, tangential = 0;
  for (int p = 0; p < contact.count; ++p) {
    normal += F(m * p);
    if (m == 2) tangential += F(m * p + 1);
  }
  const std::vector<ContactState> states = contact_states(contact, F);
  const auto count = [&](ContactState state) {
    return static_cast<int>(std::count(states.begin(), states.end(), state));
  };
  result.normal_resultant_N = normal;
  result.tangential_resultant_N = tangential;
  result.n_open = count(ContactState::open);
  result.n_stick = count(ContactState::stick);
  result.n_slip = count(ContactState::slip);
}

void note_contact_law(const ContactPoints& contact, const Eigen::VectorXd& F,
                      const Eigen::VectorXd& displacement, const Eigen::VectorXd& D_diagonal,
                      const LoadScale& scale, Verification& result) {
  const int m = contact.components;
  const Eigen::VectorXd residual = natural_map(contact, D_diagonal, F, displacement);
  result.natural_map_residual = relative_error(residual.norm(), F.norm(), scale.force_N);
  double signorini = 0, coulomb = 0;
  for (int p = 0; p < contact.count; ++p) {
    signorini = std::max(signorini, std::abs(residual(m * p)));
    if (m == 2) coulomb = std::max(coulomb, std::abs(residual(m * p + 1)));
  }
  result.signorini_violation_N = signorini;
  if (m == 2) result.coulomb_violation_N = coulomb;
}

double work_of_prescribed(const DualSystem& system, const StressField& stress,
                          const Eigen::VectorXd& F_C) {
  const Problem& problem = *system.problem;
  const double of_gap = work_of_gap(system.contact, F_C);
  if (!problem.loads.displacement_mm) return of_gap;
  return work_of_prescribed_displacement(problem, edge_balance(problem, stress)) + of_gap;
}

std::vector<ContactState> contact_states(const ContactPoints& contact, const Eigen::VectorXd& F_C) {
  constexpr double tolerance = 1e-9;
  const int m = contact.components;
  double largest = 0;
  for (int p = 0; p < contact.count; ++p) largest = std::max(largest, std::abs(F_C(m * p)));
  std::vector<ContactState> states(static_cast<std::size_t>(contact.count));
  for (int p = 0; p < contact.count; ++p) {
    const double normal = std::abs(F_C(m * p));
    if (normal <= tolerance * largest)
      states[p] = ContactState::open;
    else if (m == 1 ||
             std::abs(F_C(2 * p + 1)) >= (1 - tolerance) * contact.friction_at(p) * normal)
      states[p] = ContactState::slip;
    else
      states[p] = ContactState::stick;
  }
  return states;
}

Verification verify(const DualSystem& system, const Solution& solution,
                    const Reference* reference) {
  const Problem& problem = *system.problem;
  Verification result;
  const EdgeBalance balance = edge_balance(problem, solution.stress);
  const LoadScale scale = load_scale(problem);
  result.equilibrium_residual = equilibrium_residual(system, solution, balance, scale);
  result.strain_energy_Nmm = stress_norm_squared(problem, solution.stress) / 2;
  result.complementary_energy_Nmm = result.strain_energy_Nmm -
                                    work_of_prescribed_displacement(problem, balance) -
                                    work_of_gap(system.contact, solution.F_C);
  if (reference != nullptr) {
    const double reference_norm = std::sqrt(stress_norm_squared(problem, reference->stress));
    const double distance = stress_distance(problem, solution.stress, reference->stress);
    result.unstressed = reference_norm == 0;
    result.error_stress = relative_error(distance, reference_norm, scale.energy_norm);
    result.error_stress_absolute = distance;
    result.reference_error = reference->error_estimate;
  }
  if (system.contact.count > 0) verify_contact(system.contact, solution, reference, scale, result);
  if (reference == nullptr && solution.edge_moments.cols() > 0)
    verify_moments(system, solution, scale, result);
  return result;
}

WorstMeasure worst_measure(const Verification& v) {
  WorstMeasure worst{"equilibrium_residual", v.equilibrium_residual.value_or(0)};
  const auto consider = [&](const char* name, std::optional<double> value) {
    if (value && !std::isnan(worst.value) && !(*value <= worst.value))  // NaN is worst
      worst = {name, *value};
  };
  consider("error_stress", v.error_stress);
  consider("error_force", v.error_force);
  consider("natural_map_residual", v.natural_map_residual);
  consider("distance of stresses from those of the edge moments", v.stress_of_moments_off);
  return worst;
}

}  // namespace airybench
