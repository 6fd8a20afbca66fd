#include "verify/verifier.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "assembly/elements/edge_forces.hpp"
#include "assembly/nodal_forces.hpp"
#include "assembly/rough_compliance.hpp"
#include "assembly/traction_forces.hpp"
#include "solvers/base/dense_products.hpp"
#include "solvers/condensation/hybridized.hpp"
#include "support/sha256.hpp"
#include "verify/contact_violations.hpp"

namespace airybench {
namespace {

// Edge forces of the element stresses, N: k + 1 columns per edge, its control values from the low
// vertex on; rows: x, y.
struct EdgeBalance {
  int points = 2;  // per edge
  Eigen::Matrix2Xd sum;
  double largest = 0;   // largest single force, N
  double interior = 0;  // largest force that is not balanced inside a triangle, N

  auto of(int edge) const {
    return sum.middleCols(static_cast<Eigen::Index>(points) * edge, points);
  }
};

// Largest of what ∇·σ + b leaves on a third, and of the jumps of tractions between thirds, N: the
// divergence's Bernstein coefficients times the third's area, and the spokes' control forces.
double unbalanced_inside(const TriangleVertices& v,
                         const Eigen::Ref<const Eigen::Matrix3Xd>& stress, int degree,
                         const Eigen::Vector2d& body_force) {
  const Eigen::Vector2d centroid = v.rowwise().mean();
  const double third_area = cross_area(v.col(0), v.col(1), v.col(2)) / 6;
  const int third = bernstein_count(degree);
  double largest = 0;
  for (int t = 0; t < 3; ++t) {
    const int next = (t + 1) % 3, other = (t + 2) % 3;
    const Eigen::Vector2d a = v.col(t), b = v.col(next);
    const auto of_third = stress.middleCols(third * t, third);
    const auto long_normal = [](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
      return Eigen::Vector2d(to.y() - from.y(), from.x() - to.x());
    };
    // Of the sides opposite to a, b and the centroid: ∇λ = −normal / (2 area).
    const Eigen::Vector2d opposite[3] = {long_normal(b, centroid), long_normal(centroid, a),
                                         long_normal(a, b)};
    for (int j = 0; j < degree; ++j)
      for (int i = 0; i < degree - j; ++i) {
        Eigen::Vector2d resultant = third_area * body_force;
        for (int p = 0; p < 3; ++p)
          resultant -=
              degree / 2. *
              traction(of_third.col(ring_place(degree, i + (p == 1), j + (p == 2))), opposite[p]);
        largest = std::max(largest, resultant.cwiseAbs().maxCoeff());
      }
    const auto before = stress.middleCols(third * other, third);  // it shares the spoke from a
    for (int j = 0; j <= degree; ++j) {
      const Eigen::Vector2d jump = traction(of_third.col(ring_place(degree, 0, j)) -
                                                before.col(ring_place(degree, degree - j, j)),
                                            opposite[1]) /
                                   (degree + 1);
      largest = std::max(largest, jump.cwiseAbs().maxCoeff());
    }
  }
  return largest;
}

EdgeBalance edge_balance(const Problem& problem, const StressField& stress) {
  EdgeBalance balance;
  balance.points = stress.degree() + 1;
  balance.sum.setZero(2, static_cast<Eigen::Index>(balance.points) * problem.edges.count());
  for (int t = 0; t < static_cast<int>(stress.size()); ++t) {
    TriangleVertices v = problem.vertices_of(t);
    v.colwise() -= v.col(0).eval();  // keeps digits far from the origin
    const auto of_triangle = stress[static_cast<std::size_t>(t)];
    const auto curves = problem.curves_of(t, stress.degree());
    for (int k = 0; k < 3; ++k) {
      const int a = problem.mesh.triangles[t][k], b = problem.mesh.triangles[t][(k + 1) % 3];
      const ForcesOnEdge force =
          curves && !(*curves)[k].is_straight()
              ? curved_edge_forces(problem.vertices_of(t), of_triangle, k, (*curves)[k])
              : element_edge_forces(v, of_triangle, k);
      balance.largest = std::max(balance.largest, force.cwiseAbs().maxCoeff());
      auto sum = balance.sum.middleCols(
          static_cast<Eigen::Index>(balance.points) * problem.edges.of_triangle[t][k],
          balance.points);
      if (a < b)
        sum += force;
      else
        sum += force.rowwise().reverse();
    }
    balance.interior = std::max(
        balance.interior,
        unbalanced_inside(v, of_triangle, stress.degree(), problem.loads.body_force_N_per_mm3));
  }
  return balance;
}

// Forces on a boundary edge in walking order.
ForcesOnEdge walked(const Problem& problem, const EdgeBalance& balance, int row) {
  const auto [a, b] = problem.mesh.boundary[row].vertices;
  const auto sum = balance.of(problem.edges.of_boundary[row]);
  return a < b ? ForcesOnEdge(sum) : ForcesOnEdge(sum.rowwise().reverse());
}

// Of forces on a boundary edge.
Eigen::Vector2d resultant_on(const Problem& problem, int row, const ForcesOnEdge& forces) {
  const int degree = static_cast<int>(forces.cols()) - 1;
  if (!problem.condition(row).in_frame || !problem.follows_curve(row, degree))
    return forces * Eigen::VectorXd::Ones(degree + 1);
  const CurvedSide<double> side(problem.curve_of(row, degree), degree);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int q = 0; q < CurvedSide<double>::points; ++q)
    sum += CurvedSide<double>::weight(q) * side.density(forces, q);
  return sum;
}

void note_equilibrium(const ContactSystem& system, const Solution& solution,
                      const EdgeBalance& balance, const LoadScale& scale, Verification& result) {
  const Problem& problem = *system.problem;
  const Mesh& mesh = problem.mesh;
  const int degree = balance.points - 1;
  double unbalanced = std::max(balance.interior, not_transmitted(system.contact, solution.F_C));
  std::vector<bool> on_boundary(static_cast<std::size_t>(problem.edges.count()), false);
  Eigen::Vector2d resultant(0, 0);  // of loads, contact forces and reactions
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
    resultant += problem.area_mm2(t) * problem.loads.body_force_N_per_mm3;
  int point = 0;
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row) {
    on_boundary[problem.edges.of_boundary[row]] = true;
    const BoundaryRole role = mesh.boundary[row].role;
    const ForcesOnEdge on = walked(problem, balance, row);
    if (problem.follows_curve(row, degree))
      resultant += segment_area(mesh.boundary[row].curve) * problem.loads.body_force_N_per_mm3;
    if (role == BoundaryRole::displacement && !problem.is_roller(row)) {
      resultant += on.rowwise().sum();
      continue;
    }
    ForcesOnEdge off = on;
    if (role == BoundaryRole::force && problem.loads.traction_MPa) {
      off -= traction_forces<double>(problem, row, degree);
    } else if (role == BoundaryRole::contact) {
      const int m = system.contact.components;
      for (int j = 0; j <= degree; ++j, ++point) {
        const EdgeFrame of_law = problem.frame_of_moment(row, degree, j);
        off.col(j) -= solution.F_C(m * point) * of_law.normal;
        if (m == 2) off.col(j) -= solution.F_C(m * point + 1) * of_law.tangent;
      }
    }
    if (problem.is_roller(row))  // its normal force is free
      for (int j = 0; j <= degree; ++j) {
        const Eigen::Vector2d t = problem.frame_of_moment(row, degree, j).tangent;
        off.col(j) = (t * t.dot(off.col(j))).eval();
      }
    unbalanced = std::max(unbalanced, off.cwiseAbs().maxCoeff());
    resultant += resultant_on(problem, row, on - off);
  }
  for (int edge = 0; edge < problem.edges.count(); ++edge)
    if (!on_boundary[edge])
      unbalanced = std::max(unbalanced, balance.of(edge).cwiseAbs().maxCoeff());
  result.equilibrium_residual = scale.relative_force(unbalanced, balance.largest);
  result.unbalanced_N = resultant.norm();
}

// ∫_{Γ_D} u0·σn.
double work_of_prescribed_displacement(const Problem& problem, const EdgeBalance& balance) {
  if (!problem.loads.displacement_mm) return 0;
  double work = 0;
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row) {
    if (problem.mesh.boundary[row].role != BoundaryRole::displacement) continue;
    work += problem.prescribed_moments(row, balance.points - 1)
                .cwiseProduct(walked(problem, balance, row))
                .sum();
  }
  return work;
}

// Of the gap without free motions, where F_C balances the loads on these.
double work_of_gap(const ContactSystem& system, const Eigen::VectorXd& F_C) {
  const Eigen::VectorXd& gap = system.contact.gap;
  return gap.size() > 0 ? gap.dot(F_C) - work_on_free_motion(*system.problem, system.problem->free,
                                                             system.degree)
                        : 0;
}

std::string digits(double value) { return value == 0 ? "0" : fmt::format("{:.4e}", value); }

// value / (|value| + |other|) in steps of 1e-5.
std::string share(double value, double other) {
  const double sum = std::abs(value) + std::abs(other);
  return fmt::format("{}", sum > 0 ? std::llround(value / sum * 1e5) : 0);
}

}  // namespace

double work_of_prescribed(const ContactSystem& system, const StressField& stress,
                          const Eigen::VectorXd& F_C) {
  const Problem& problem = *system.problem;
  const double of_gap = work_of_gap(system, F_C);
  if (!problem.loads.displacement_mm) return of_gap;
  return work_of_prescribed_displacement(problem, edge_balance(problem, stress)) + of_gap;
}

namespace {

Eigen::MatrixXd in_frames(const Problem& problem, Eigen::MatrixXd moments) {
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row) {
    if (!problem.condition(row).in_frame) continue;
    const auto [a, b] = problem.mesh.boundary[row].vertices;
    auto own = moments.col(problem.edges.of_boundary[row]).reshaped(2, moments.rows() / 2);
    if (a > b) own = own.rowwise().reverse().eval();
    const int degree = static_cast<int>(own.cols()) - 1;
    for (int j = 0; j <= degree; ++j) {
      const EdgeFrame frame = problem.frame_of_moment(row, degree, j);
      own.col(j) = Eigen::Vector2d(frame.normal.dot(own.col(j)), frame.tangent.dot(own.col(j)));
    }
  }
  return moments;
}

}  // namespace

MomentsCheck check_moments(const ContactSystem& system, const Eigen::MatrixXd& edge_moments) {
  const Problem& problem = *system.problem;
  const Eigen::MatrixXd moments = in_frames(problem, edge_moments);
  HybridizedSystem hybrid;
  hybrid.n_c = system.contact.size();
  const int inner = number_unknowns(problem, system.contact, hybrid.unknown);
  hybrid.displacement = prescribed_displacements(problem, system.degree);
  hybrid.b.setZero(inner + hybrid.n_c);
  Eigen::VectorXd u(hybrid.b.size());
  for (int edge = 0; edge < problem.edges.count(); ++edge)
    for (int k = 0; k < hybrid.unknown.length(); ++k)
      if (const int unknown = hybrid.unknown[edge][k]; unknown != prescribed_unknown)
        u(unknown) = moments(k, edge);
  return {recover_stresses(problem, hybrid, u).stress, u.tail(hybrid.n_c)};
}

namespace {

void verify_contact(const ContactSystem& system, const Solution& solution,
                    const Reference* reference, const LoadScale& scale, Verification& result) {
  const ContactPoints& points = system.contact;
  const Eigen::VectorXd& F = solution.F_C;
  if (reference == nullptr) return note_contact_forces(points, F, result);
  const Eigen::MatrixXd& D = reference->condensed.D;
  const Eigen::VectorXd displacement = times(D, F) - reference->condensed.G;
  note_contact(points, D, F, displacement, scale, result);
  note_slip(*system.problem, points, F, solution.contact_displacement, displacement, D.diagonal(),
            scale, result);
  result.error_force =
      scale.relative_energy(D_norm(D, F - reference->F_C), D_norm(D, reference->F_C));
}

void verify_moments(const ContactSystem& system, const Solution& solution,
                    const EdgeDisplacements& edges, const LoadScale& scale, Verification& result) {
  const MomentsCheck check = check_moments(system, edges.moments);
  result.stress_of_moments_off =
      scale.relative_energy(stress_distance(*system.problem, solution.stress, check.stress),
                            std::sqrt(stress_norm_squared(*system.problem, solution.stress)));
  if (system.contact.count == 0) return;
  const Eigen::VectorXd compliance = rough_compliance(*system.problem, system.contact);
  note_contact_law(system.contact, solution.F_C, check.contact_displacement, compliance, scale,
                   result);
  note_slip(*system.problem, system.contact, solution.F_C, solution.contact_displacement,
            check.contact_displacement, compliance, scale, result);
}

}  // namespace

Verification verify(const ContactSystem& system, const Solution& solution,
                    const Reference* reference) {
  if (solution.as<Displacements>()) return verify_displacement(system, solution);
  const Problem& problem = *system.problem;
  Verification result;
  const EdgeBalance balance = edge_balance(problem, solution.stress);
  const LoadScale scale = load_scale(problem);
  note_equilibrium(system, solution, balance, scale, result);
  result.strain_energy_Nmm = stress_norm_squared(problem, solution.stress) / 2;
  result.complementary_energy_Nmm =
      result.strain_energy_Nmm + thermal_work(problem, solution.stress) -
      work_of_prescribed_displacement(problem, balance) - work_of_gap(system, solution.F_C);
  if (reference != nullptr) {
    const double reference_norm = std::sqrt(stress_norm_squared(problem, reference->stress));
    const double distance = stress_distance(problem, solution.stress, reference->stress);
    result.unstressed = scale.is_no_energy(reference_norm);
    result.error_stress = scale.relative_energy(distance, reference_norm);
    result.reference_error = reference->error_estimate;
  }
  if (system.contact.count > 0) verify_contact(system, solution, reference, scale, result);
  if (const auto* const edges = solution.as<EdgeDisplacements>(); edges && reference == nullptr)
    verify_moments(system, solution, *edges, scale, result);
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
  consider("distance from the prescribed displacements", v.prescribed_off);
  consider("error of the slip, from which the next load step starts,", v.slip_off);
  return worst;
}

std::string answer_hash(const Verification& v) {
  const double normal = v.normal_resultant_N.value_or(0);
  const double tangential = v.tangential_resultant_N.value_or(0);
  const double complementary = v.complementary_energy_Nmm.value_or(0);
  if (v.unstressed || !std::isfinite(v.strain_energy_Nmm + complementary + normal + tangential))
    return "";
  const std::string rounded =
      fmt::format("W {} N {} C {} T {}", digits(v.strain_energy_Nmm), digits(normal),
                  share(complementary, v.strain_energy_Nmm), share(tangential, normal));
  return sha256_hex(rounded).substr(0, 16);
}

}  // namespace airybench
