// The verifier's part for displacement methods.
#include <algorithm>
#include <cmath>

#include "assembly/control_points.hpp"
#include "assembly/curved_traces.hpp"
#include "assembly/nodal_forces.hpp"
#include "assembly/rough_compliance.hpp"
#include "assembly/total_displacement.hpp"
#include "solvers/contact/coulomb_law.hpp"
#include "solvers/contact/paired_points.hpp"
#include "verify/contact_violations.hpp"
#include "verify/verifier.hpp"

namespace airybench {
namespace {

// A program's force without friction may have any direction between the normals of the two edges of
// a vertex, and between those of the wall and of the face: its law need not have the wall's, or
// their mean n, and its nodal forces, in Bernstein coefficients, have another direction. What
// remains of the force's part t ⊥ n: max(0, |t| − |F_n| tan α), α from n to the farthest of an
// edge's normals.
double beyond_both_normals(const Problem& problem, const ControlPoints& control, int p, double F_n,
                           double t) {
  const int row = control.law.boundary[p];
  const std::array<int, 3> nodes = boundary_nodes(problem, row);
  const auto k = std::ranges::find(nodes, control.node[p]) - nodes.begin();
  const auto tangent_to = [&](const Eigen::Vector2d& normal) {
    const Eigen::Vector2d seen = control.frame(p).transpose() * normal;
    return std::abs(seen.y() / seen.x());
  };
  const auto [a, b] = problem.mesh.boundary[row].vertices;
  const double widest =
      std::max(tangent_to(problem.frame_at(row, static_cast<int>(k), 2).normal),
               tangent_to(edge_frame(problem.mesh.vertices[a], problem.mesh.vertices[b]).normal));
  return std::max(0.0, std::abs(t) - std::max(0.0, -F_n) * widest);
}

// What rounding of a program's printed numbers u to (1 ± ε) u can do to nodal forces: Σ |K| ε|u|.
// The middle of an edge, of the coefficient c, is m = (a + 2c + b)/4, so c = 2m − (a + b)/2.
Eigen::Matrix2Xd forces_of_rounding(const Problem& problem, const DisplacementField& w,
                                    double precision) {
  const DisplacementField u = with_rigid_motion(problem, w);
  Eigen::Matrix2Xd off = u.cwiseAbs();
  const auto vertices = static_cast<Eigen::Index>(problem.mesh.vertices.size());
  for (int edge = 0; edge < problem.edges.count(); ++edge) {
    const auto [a, b] = problem.edges.vertices[edge];
    const Eigen::Vector2d middle = (u.col(a) + 2 * u.col(vertices + edge) + u.col(b)) / 4;
    off.col(vertices + edge) = 2 * middle.cwiseAbs() + (off.col(a) + off.col(b)) / 2;
  }
  const auto& quadratic = DisplacementTriangle::of_degree(2);
  const std::vector<Eigen::Matrix3d> elasticity = elasticities(problem);
  Eigen::Matrix2Xd force = Eigen::Matrix2Xd::Zero(2, off.cols());
  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t) {
    const auto K = quadratic.stiffness(TriangleShape(problem.vertices_of(t)),
                                       elasticity[problem.mesh.triangle_body[t]]);
    const auto nodes = triangle_nodes(problem, 2, t);
    Eigen::Matrix<double, 2, 6> own;
    for (int m = 0; m < 6; ++m) own.col(m) = off.col(nodes[m]);
    const Eigen::Matrix<double, 2, 6> of_triangle = (K.cwiseAbs() * own.reshaped()).reshaped(2, 6);
    for (int m = 0; m < 6; ++m) force.col(nodes[m]) += precision * of_triangle.col(m);
  }
  return force;
}

// Over the largest displacement. d: the traces of w.
double relative_to_prescribed(const Problem& problem, const DisplacementField& w,
                              const DisplacementField& d, const PrescribedDisplacement& prescribed,
                              double precision) {
  const DisplacementField u = with_rigid_motion(problem, w);
  double off = 0, largest = 0;
  const auto add = [&](Eigen::Index node, double distance) {
    off = larger_error(off, std::abs(distance) - precision * u.col(node).norm());
  };
  for (Eigen::Index node = 0; node < w.cols(); ++node) {
    largest = std::max({largest, d.col(node).norm(), prescribed.u.col(node).norm()});
    if (prescribed.at[node]) add(node, (d.col(node) - prescribed.u.col(node)).norm());
  }
  for (const auto& [node, n] : prescribed.normal)
    add(node, n.dot(d.col(node) - prescribed.u.col(node)));
  return relative_error(off, largest, 0);
}

// Takes out what a weak contact law leaves at nodes of the triangles along Γ_C: contact forces,
// whose normal and tangential sum it returns.
Eigen::Vector2d take_weak_forces(const Problem& problem, const std::vector<bool>& prescribed,
                                 Eigen::Matrix2Xd& balance) {
  std::vector<int> contact_row(static_cast<std::size_t>(problem.edges.count()), Problem::no_row);
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row)
    if (problem.mesh.boundary[row].role == BoundaryRole::contact)
      contact_row[problem.edges.of_boundary[row]] = row;
  Eigen::Vector2d sum(0, 0);
  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t)
    for (const int edge : problem.edges.of_triangle[t]) {
      if (contact_row[edge] == Problem::no_row) continue;
      const EdgeFrame frame = problem.frame_at(contact_row[edge], 1, 2);
      for (const int node : triangle_nodes(problem, 2, t)) {
        if (prescribed[node]) continue;
        sum += Eigen::Vector2d(frame.normal.dot(balance.col(node)),
                               frame.tangent.dot(balance.col(node)));
        balance.col(node).setZero();
      }
    }
  return sum;
}

}  // namespace

Verification verify_displacement(const ContactSystem& system, const Solution& solution) {
  const Problem& problem = *system.problem;
  const auto& [w, by_program] = std::get<Displacements>(solution.unknowns);
  const int degree = system.degree + 1;
  const ControlPoints control = control_points(problem, degree);
  const int m = control.law.components;
  const LoadScale scale = load_scale(problem);
  const CurvedTraces traces(problem, degree);
  const DisplacementField d = traces.traces(w);
  const StressField stress = own_stress(problem, w);
  NodalForces balance = nodal_forces(problem, w);
  balance.sum = traces.forces(balance.sum - nodal_loads(problem, degree));

  const Eigen::VectorXd displacement = displacement_at(control, d);
  for (int p = 0; p < control.law.count; ++p) {
    const Eigen::Matrix2d frame = control.frame(p);
    const int node = control.node[p];
    for (int k = 0; k < m; ++k) balance.sum.col(node) -= solution.F_C(m * p + k) * frame.col(k);
    if (m == 1 && by_program && !control.on_roller[p]) {
      const Eigen::Vector2d t = frame.col(1);
      const double off = t.dot(balance.sum.col(node));
      const double beyond = beyond_both_normals(problem, control, p, solution.F_C(p), off);
      balance.sum.col(node) += (std::copysign(beyond, off) - off) * t;
    }
  }
  const PrescribedDisplacement prescribed = traces.prescribed();
  for (const auto& [node, n] : prescribed.normal)  // the roller's reaction
    balance.sum.col(node) -= n * n.dot(balance.sum.col(node));
  Eigen::Vector2d weak_N(0, 0);
  const bool is_weak = by_program && by_program->weak_contact;
  if (is_weak) weak_N = take_weak_forces(problem, prescribed.at, balance.sum);
  Eigen::Vector2d resultant(0, 0);
  for (std::size_t node = 0; node < prescribed.at.size(); ++node)
    if (!prescribed.at[node]) resultant += balance.sum.col(node);
  Eigen::VectorXd rounding;  // per contact point
  if (by_program && by_program->print_precision > 0) {
    const Eigen::Matrix2Xd of_nodes = forces_of_rounding(problem, w, by_program->print_precision);
    balance.sum = (balance.sum.cwiseAbs() - of_nodes).cwiseMax(0.0);
    rounding.resize(control.law.count);
    for (int p = 0; p < control.law.count; ++p) rounding(p) = of_nodes.col(control.node[p]).norm();
  }
  double unbalanced = not_transmitted(control.law, solution.F_C, rounding);
  for (std::size_t node = 0; node < prescribed.at.size(); ++node)
    if (!prescribed.at[node])
      unbalanced = std::max(unbalanced, balance.sum.col(node).cwiseAbs().maxCoeff());

  Verification result;
  constexpr double of_doubles = 1e-15;
  result.prescribed_off = relative_to_prescribed(
      problem, w, d, prescribed, of_doubles + (by_program ? by_program->print_precision : 0));
  result.equilibrium_residual = scale.relative_force(unbalanced, balance.largest);
  result.unbalanced_N = resultant.norm();
  result.strain_energy_Nmm = stress_norm_squared(problem, stress) / 2;
  result.unstressed = scale.is_no_energy(std::sqrt(2 * result.strain_energy_Nmm));
  const bool is_other = by_program && by_program->other_elements;
  if (is_other) {
    result.prescribed_off.reset();
    result.equilibrium_residual.reset();
    result.unbalanced_N.reset();
  }
  if (control.law.count == 0) return result;
  const ContactPoints& law = control.law;
  const Eigen::VectorXd& F = solution.F_C;
  const Eigen::VectorXd compliance = rough_compliance(problem, law);
  note_contact_forces(law, F, result);
  note_contact_law(law, F, displacement, compliance, scale, result);
  note_slip(problem, law, F, solution.contact_displacement, displacement, compliance, scale,
            result);
  const Penetration through = penetration(problem, w);
  result.penetration_mm = through.at_nodes_mm;
  result.edge_penetration_mm = through.on_edges_mm;
  result.penetration_share = through.share;
  if (!by_program) return result;
  const auto forget_forces = [&] {
    for (auto of_nodes : {&Verification::tension, &Verification::friction_excess,
                          &Verification::signorini_violation_N, &Verification::coulomb_violation_N})
      (result.*of_nodes).reset();
  };
  // The program has another discrete law: only the violations in N apply.
  result.natural_map_residual.reset();
  const Eigen::VectorXd r = relative_to_gap(law, displacement);
  const Eigen::VectorXd trial = project_on_coulomb(law, trial_forces(law, compliance, F, r));
  note_contact_states(joined(law), of_first(law, trial), result);
  if (is_weak || is_other) forget_forces();
  if (!is_weak) return result;
  *result.normal_resultant_N += weak_N(0);
  *result.tangential_resultant_N += weak_N(1);
  return result;
}

}  // namespace airybench
