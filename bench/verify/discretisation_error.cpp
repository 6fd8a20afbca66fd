#include "bench/verify/discretisation_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "assembly/edge_forces.hpp"
#include "assembly/rough_compliance.hpp"
#include "bench/verify/verifier.hpp"

namespace airybench {
namespace {

using EdgeValues = std::array<double, 3>;  // Bernstein coefficients along an edge

double value_at(const EdgeValues& c, double s) {
  return (1 - s) * (1 - s) * c[0] + 2 * s * (1 - s) * c[1] + s * s * c[2];
}

// 0, the sign changes in (0, 1), and 1.
std::vector<double> sign_changes(const EdgeValues& c) {
  // Stable roots of a s² + 2 h s + c_0: q = −(h + sgn(h) √(h² − a c_0)), roots q/a, c_0/q.
  const double a = c[0] - 2 * c[1] + c[2], h = c[1] - c[0];
  std::vector<double> places = {0};
  const double discriminant = h * h - a * c[0];
  if (discriminant > 0) {
    const double q = -(h + std::copysign(std::sqrt(discriminant), h));
    double first = q / a, second = c[0] / q;
    if (!(first < second)) std::swap(first, second);  // if a = 0, first is infinite
    for (const double root : {first, second})
      if (root > places.back() && root < 1) places.push_back(root);
  }
  places.push_back(1);
  return places;
}

// ∫ (μ|σ_n||u_t| + σ_t u_t) ds over an edge; forces are (L/2) σ at its ends. Between sign changes
// of u_t the integrand is cubic, so two Gauss points are exact.
double friction_gap(double mu, const Eigen::Vector2d& normal, const Eigen::Vector2d& tangential,
                    const EdgeValues& u_t) {
  double sum = 0;
  const std::vector<double> places = sign_changes(u_t);
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double middle = (places[i - 1] + places[i]) / 2, half = (places[i] - places[i - 1]) / 2;
    for (const double xi : {-1 / std::sqrt(3.0), 1 / std::sqrt(3.0)}) {
      // |u| (t sgn(u) − μ n): computing the bracket at the ends first gives exactly zero for slip.
      const double s = middle + half * xi, u = value_at(u_t, s);
      const Eigen::Vector2d left = std::copysign(1, u) * tangential - mu * normal;
      sum += 2 * half * std::abs(u) * ((1 - s) * left(0) + s * left(1));  // 2/L · L/2 · (…) · 2
    }
  }
  return sum;
}

// ∫ σ_n (g0 − q) ds with the quadratic gap q of an edge.
double work_of_detail(const WallDetail& detail, const Eigen::Vector2d& normal) {
  return normal(0) * detail.moments_mm[0] + normal(1) * detail.moments_mm[1];
}

struct ContactTerms {
  double normal, tangential;
  double beyond_wall_N;               // ∫ σ_n where the edge meets no wall
  double highest_gap, highest_force;  // largest u_n − g0 and F_n; admissible: ≤ 0
};

ContactTerms contact_terms(const DualSystem& system, int point, const Eigen::VectorXd& F_C,
                           const DisplacementField& u) {
  const Problem& problem = *system.problem;
  const int row = system.contact.boundary[point], m = system.contact.components;
  const std::array<int, 3> nodes = boundary_nodes(problem, row);
  const std::array<ContactOffset, 3> offset = problem.offset_coefficients(row);
  const WallDetail detail = problem.wall_detail_at(row);
  EdgeValues r, u_t;
  for (int k = 0; k < 3; ++k) {
    const EdgeFrame frame = problem.frame_at_node(row, k);
    r[k] = frame.normal.dot(u.col(nodes[k])) - offset[k].along(frame.normal).x();
    u_t[k] = frame.tangent.dot(u.col(nodes[k]) + offset[k].motion_mm) - offset[k].slid_mm;
  }
  const Eigen::Vector2d normal(F_C(m * point), F_C(m * (point + 1)));
  ContactTerms terms{};
  // ∫ σ_n r ds = Σ_k F_n^k r̄^k with r̄ = (2/L) ∫ N_k r ds.
  terms.normal =
      2 * (normal(0) * (r[0] / 2 + r[1] / 3 + r[2] / 6) +
           normal(1) * (r[0] / 6 + r[1] / 3 + r[2] / 2) - work_of_detail(detail, normal));
  if (m == 2)
    terms.tangential = 2 * friction_gap(system.contact.friction_at(point), normal,
                                        {F_C(2 * point + 1), F_C(2 * point + 3)}, u_t);
  terms.beyond_wall_N = normal(0) * detail.unmet[0] + normal(1) * detail.unmet[1];
  for (int k = 0; k < 3; ++k) r[k] += detail.lowered_mm[k];
  terms.highest_gap = std::max({r[0], r[1], r[2]});
  terms.highest_force = normal.maxCoeff();
  return terms;
}

void judge_admissibility(const Eigen::VectorXd& F_C, const DisplacementField& u, double highest_gap,
                         double highest_force, ConstitutiveError& error) {
  constexpr double rounding = 1e-9;
  if (highest_gap > rounding * u.lpNorm<Eigen::Infinity>())
    error.flaw = fmt::format("the displacements go {:.1e} mm through the wall", highest_gap);
  else if (highest_force > rounding * F_C.lpNorm<Eigen::Infinity>())
    error.flaw = fmt::format("the contact forces pull with {:.1e} N", highest_force);
  else if (error.squared_Nmm() < -rounding * error.body_Nmm)
    error.flaw = fmt::format("e² is {:.1e} N mm", error.squared_Nmm());
}

// Energies: strain energies, N mm.
struct Fields {
  const StressField& stress;
  const Eigen::VectorXd& F_C;
  const DisplacementField& u;
  double energy, energy_of_u;
};

// The allowance covers rounding and the remaining violation of the inequalities.
void note_bounds(const DualSystem& system, const Fields& fields, double highest_gap,
                 ConstitutiveError& error) {
  constexpr double rounding = 1e-12;
  const auto& [stress, F_C, u, energy, energy_of_u] = fields;
  const int m = system.contact.components;
  double lower = work_of_prescribed(system, stress, F_C) - energy, pressing = 0, pulling = 0;  // N
  for (int p = 0; p < system.contact.count; ++p) {
    const double F_n = F_C(m * p);
    (F_n < 0 ? pressing : pulling) += std::abs(F_n);
    lower += F_n * system.problem->wall_detail_at(system.contact.boundary[p]).moments_mm[p % 2];
  }
  const double upper = energy_of_u - work_of_loads(*system.problem, u);
  const double allowance = pressing * std::max(0.0, highest_gap) +
                           pulling * u.lpNorm<Eigen::Infinity>() +
                           rounding * (energy + std::abs(lower) + std::abs(upper));
  error.lower_bound_Nmm = lower - allowance;
  error.upper_bound_Nmm = upper + allowance;
  const bool frictionless = system.contact.count == 0 || m == 1;
  const bool strict =
      frictionless && !system.problem->contact_turns() && error.beyond_wall_Nmm == 0;
  if (strict && error.flaw.empty() && error.lower_bound_Nmm > error.upper_bound_Nmm)
    error.flaw = fmt::format("the bounds cross: {} N mm is above {} N mm", error.lower_bound_Nmm,
                             error.upper_bound_Nmm);
  error.guaranteed = strict && error.flaw.empty();
}

}  // namespace

ConstitutiveError constitutive_error(const DualSystem& system, const StressField& stress,
                                     const Eigen::VectorXd& F_C, const DisplacementField& u) {
  const Problem& problem = *system.problem;
  ConstitutiveError error;
  const StressField other = stress_of_displacement(problem, u);
  Fields fields{stress, F_C, u, 0, 0};
  error.of_triangle_Nmm.resize(stress.size());
  std::vector<int> triangle_of_edge(static_cast<std::size_t>(problem.edges.count()));
  for (int t = 0; t < static_cast<int>(stress.size()); ++t) {
    const auto energy = [&](const ElementStress& s) {
      return s.cwiseProduct(stress_dual(s, problem.area_mm2(t), problem.compliance_of(t))).sum() /
             2;
    };
    error.of_triangle_Nmm[t] = 2 * energy(stress[t] - other[t]);
    fields.energy += energy(stress[t]);
    fields.energy_of_u += energy(other[t]);
    error.body_Nmm += error.of_triangle_Nmm[t];
    for (const int edge : problem.edges.of_triangle[t]) triangle_of_edge[edge] = t;
  }
  double highest_gap = 0, highest_force = 0;
  const Eigen::VectorXd compliance = rough_compliance(problem, system.contact);
  for (int point = 0; point < system.contact.count; point += 2) {  // two per edge
    const ContactTerms terms = contact_terms(system, point, F_C, u);
    const double beyond_wall =
        compliance(system.contact.components * point) * terms.beyond_wall_N * terms.beyond_wall_N;
    error.normal_contact_Nmm += terms.normal;
    error.tangential_contact_Nmm += terms.tangential;
    error.beyond_wall_Nmm += beyond_wall;
    const int edge = problem.edges.of_boundary[system.contact.boundary[point]];
    error.of_triangle_Nmm[triangle_of_edge[edge]] += terms.normal + terms.tangential + beyond_wall;
    highest_gap = std::max(highest_gap, terms.highest_gap);
    highest_force = std::max(highest_force, terms.highest_force);
  }
  judge_admissibility(F_C, u, highest_gap, highest_force, error);
  note_bounds(system, fields, highest_gap, error);
  const auto relative = [&](double squared) {
    return relative_error(std::sqrt(std::max(0.0, squared)), std::sqrt(2 * fields.energy),
                          load_scale(problem).energy_norm);
  };
  error.relative = relative(error.squared_Nmm());
  error.relative_of_mean = relative(error.squared_of_mean_Nmm());
  return error;
}

StressField mean_stress(const Problem& problem, const StressField& stress,
                        const DisplacementField& u) {
  StressField mean = stress_of_displacement(problem, u);
  for (std::size_t t = 0; t < mean.size(); ++t) mean[t] = (mean[t] + stress[t]) / 2;
  return mean;
}

}  // namespace airybench
