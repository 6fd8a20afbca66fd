#include "verify/discretisation_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <stdexcept>

#include "assembly/elements/edge_forces.hpp"
#include "assembly/nodal_forces.hpp"
#include "assembly/rough_compliance.hpp"
#include "mesh/boundary_sides.hpp"
#include "verify/along_contact.hpp"
#include "verify/geometry_error.hpp"
#include "verify/verifier.hpp"

namespace airybench {
namespace {

template <int degree>
using EdgeValues = std::array<double, degree + 1>;  // Bernstein coefficients along an edge

// ∫ (μ|σ_n||u_t| + σ_t u_t) ds over an edge; forces are L/(k + 1) times the control values of σ.
// Halves the edge down to the zeros of u_t. A rest of this length has the square of it as error.
template <int k>
class FrictionGap {
 public:
  FrictionGap(double mu, const EdgeValues<k>& normal, const EdgeValues<k>& tangential)
      : mu_(mu), normal_(normal), tangential_(tangential) {}

  double integral(const EdgeValues<k + 1>& u_t, double start = 0, double length = 1) const {
    constexpr double shortest = 1e-9;
    const auto [least, largest] = std::minmax_element(u_t.begin(), u_t.end());
    if (length < shortest || !(*least < 0 && *largest > 0)) return part(u_t, start, length);
    const auto [left, right] = halved(u_t);
    return integral(left, start, length / 2) + integral(right, start + length / 2, length / 2);
  }

 private:
  // |u| (t sgn(u) − μ n): computing the bracket at the control points first gives exactly zero for
  // slip.
  double part(const EdgeValues<k + 1>& u_t, double start, double length) const {
    using Points = boost::math::quadrature::gauss<double, k + 1>;  // exact for degree 2k + 1
    const auto at = [&](double u) {
      const double value = bernstein_value(u_t, u);
      EdgeValues<k> bracket;
      for (int j = 0; j <= k; ++j)
        bracket[j] = std::copysign(1, value) * tangential_[j] - mu_ * normal_[j];
      return std::abs(value) * bernstein_value(bracket, start + u * length);
    };
    return (k + 1) * length * Points::integrate(at, 0., 1.);
  }

  double mu_;
  const EdgeValues<k>&normal_, &tangential_;
};

struct ContactTerms {
  double normal, tangential;
  double beyond_wall_N;               // ∫ σ_n where the edge meets no wall
  double highest_gap, highest_force;  // largest u_n − g0 and F_n; admissible: ≤ 0
  Sliding sliding;
};

// u_t: of the edge of this row, less that of earlier load steps.
template <int p>
Sliding edge_sliding(const Problem& problem, int row, std::array<double, p + 1> u_t) {
  const double length_mm = problem.frame_at(row, 0, 1).length_mm,
               turn =
                   (problem.frame_at(row, 1, 1).normal - problem.frame_at(row, 0, 1).normal).norm();
  if (problem.opposite_of(row) == Problem::no_row && turn < straight_roller) return {};
  if (const auto& slid = problem.loads.slid_mm; slid.size() > 0) {
    const int other = problem.opposite_of(row);
    const std::array<double, p + 1> before = elevated<p>(slid.col(row));
    for (int i = 0; i <= p; ++i) u_t[i] += before[i];
    if (other != Problem::no_row) {
      const std::array<double, p + 1> beyond = elevated<p>(slid.col(other));
      for (int i = 0; i <= p; ++i) u_t[i] += beyond[p - i];
    }
  }
  double mm = 0;
  for (const double slide : u_t) mm = std::max(mm, std::abs(slide));
  return {mm, mm / length_mm, turn * mm / length_mm};
}

// point: the first of an edge; u: its traces.
template <int k>
ContactTerms contact_terms(const ContactSystem& system, const CurvedTraces& traces, int point,
                           const Eigen::VectorXd& F_C, const DisplacementField& u) {
  constexpr int p = k + 1;
  const Problem& problem = *system.problem;
  const int row = system.contact.boundary[point], m = system.contact.components;
  const WallDetail detail = problem.wall_detail_at(row);
  auto [r, u_t] = contact_motion<p>(problem, traces, row, u);
  EdgeValues<k> normal, tangential{};
  for (int j = 0; j <= k; ++j) {
    normal[j] = F_C(m * (point + j));
    if (m == 2) tangential[j] = F_C(2 * (point + j) + 1);
  }
  ContactTerms terms{};
  // ∫ σ_n (u_n − g0) ds by moments, of r less what the wall has more than its quadratic.
  const EdgeValues<k> more = lower_moments<k>(detail.moments_mm),
                      unmet = lower_moments<k>(detail.unmet);
  for (int j = 0; j <= k; ++j) {
    double moment = -more[j];
    for (int i = 0; i <= p; ++i) moment += edge_moment(k, j, p, i) * r[i];
    terms.normal += 2 * normal[j] * moment;
    terms.beyond_wall_N += normal[j] * unmet[j];
  }
  if (m == 2)
    terms.tangential =
        2 * FrictionGap<k>(system.contact.friction_at(point), normal, tangential).integral(u_t);
  const EdgeValues<p> lowered = elevated<p>(detail.lowered_mm);
  for (int i = 0; i <= p; ++i) r[i] += lowered[i];
  terms.highest_gap = *std::max_element(r.begin(), r.end());
  terms.highest_force = *std::max_element(normal.begin(), normal.end());
  if (*std::ranges::min_element(normal) < 0) terms.sliding = edge_sliding<p>(problem, row, u_t);
  return terms;
}

// Energies: strain energies, N mm.
struct Fields {
  const StressField& stress;
  const Eigen::VectorXd& F_C;
  const DisplacementField& u;
  double energy, energy_of_u;
};

// The terms on Γ_C are of first order in the rounding of the contact law.
void judge_admissibility(const Fields& fields, double highest_gap, double highest_force,
                         ConstitutiveError& error) {
  constexpr double rounding = 1e-9, of_law = 1e-11;
  const auto& [stress, F_C, u, energy, energy_of_u] = fields;
  if (!u.allFinite() || !std::isfinite(error.squared_Nmm()))
    error.flaw = "stresses or displacements are not finite";
  else if (highest_gap > rounding * u.lpNorm<Eigen::Infinity>())
    error.flaw = fmt::format("the displacements go {:.1e} mm through the wall", highest_gap);
  else if (highest_force > rounding * F_C.lpNorm<Eigen::Infinity>())
    error.flaw = fmt::format("the contact forces pull with {:.1e} N", highest_force);
  else if (error.squared_Nmm() <
           -std::max(rounding * error.body_Nmm, of_law * (energy + energy_of_u)))
    error.flaw = fmt::format("e² is {:.1e} N mm", error.squared_Nmm());
}

// The allowance covers rounding and the remaining violation of the inequalities.
template <int k>
void note_bounds(const ContactSystem& system, const Fields& fields, double highest_gap,
                 ConstitutiveError& error) {
  constexpr double rounding = 1e-12;
  const auto& [stress, F_C, u, energy, energy_of_u] = fields;
  const int m = system.contact.components;
  double lower = work_of_prescribed(system, stress, F_C) - energy -
                 thermal_work(*system.problem, stress),
         pressing = 0, pulling = 0;  // N
  const auto more_gap = [&](int point) {
    const WallDetail detail = system.problem->wall_detail_at(system.contact.boundary[point]);
    return lower_moments<k>(detail.moments_mm)[point % (k + 1)];
  };
  for (int p = 0; p < system.contact.count; ++p) {
    const double F_n = F_C(m * p);
    (F_n < 0 ? pressing : pulling) += std::abs(F_n);
    lower += F_n * more_gap(p);
  }
  const double upper = energy_of_u - work_of_loads(*system.problem, u, sides_of_stresses(k)) -
                       work_on_free_motion(*system.problem, system.problem->free, k);
  const double allowance = pressing * std::max(0.0, highest_gap) +
                           pulling * u.lpNorm<Eigen::Infinity>() +
                           rounding * (energy + std::abs(lower) + std::abs(upper));
  error.lower_bound_Nmm = lower - allowance;
  error.upper_bound_Nmm = upper + allowance;
  const bool frictionless = system.contact.count == 0 || m == 1;
  // On a curve that is held u is u0 at points only.
  const bool follows_curves = k > 1 && !system.problem->round.empty();
  const bool strict = frictionless && !follows_curves && !system.problem->contact_turns() &&
                      !system.problem->matching.has_curves && error.beyond_wall_Nmm == 0 &&
                      error.geometry_Nmm == 0;
  if (strict && error.flaw.empty() && error.lower_bound_Nmm > error.upper_bound_Nmm)
    error.flaw = fmt::format("the bounds cross: {} N mm is above {} N mm", error.lower_bound_Nmm,
                             error.upper_bound_Nmm);
  error.guaranteed = strict && error.flaw.empty();
}

// ½ ∫ σ:C:σ over a triangle, of coefficients by thirds or of the whole.
double strain_energy(const Eigen::Ref<const Eigen::Matrix3Xd>& stress, double area_mm2,
                     const Eigen::Matrix3d& compliance, const Eigen::MatrixXd& mass) {
  const Eigen::Index n = mass.rows(), parts = stress.cols() / n;
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  for (Eigen::Index part = 0; part < parts; ++part) {
    const DisplacementTriangle::Strain of_part = stress.middleCols(n * part, n);
    products += of_part.lazyProduct(mass).eval().lazyProduct(of_part.transpose());
  }
  return area_mm2 / (2 * static_cast<double>(parts)) * products.cwiseProduct(compliance).sum();
}

// Adds the energies of the body: ½ ∫ of σ, of A (ε(u) − ε0), and twice that of their difference.
void add_body(const Problem& problem, const CurvedTraces& traces, Fields& fields,
              ConstitutiveError& error) {
  const auto& [stress, F_C, u, energy, energy_of_u] = fields;
  const auto& element = DisplacementTriangle::of_degree(stress.degree() + 1);
  const std::vector<Eigen::Matrix3d> elasticity = elasticities(problem);
  error.of_triangle_Nmm.resize(stress.size());
  for (int t = 0; t < static_cast<int>(stress.size()); ++t) {
    const TriangleShape shape(problem.vertices_of(t));
    const DisplacementTriangle::Displacement of_u = of_triangle(problem, element.degree, u, t);
    DisplacementTriangle::Strain other = elasticity[problem.mesh.triangle_body[t]].lazyProduct(
        element.strain(shape.gradients, of_u));
    if (problem.is_warm(t)) other -= thermal_stress(problem, t, stress.degree());
    const DisplacementTriangle::StrainByThirds own = stress[t],
                                               difference =
                                                   own - other.lazyProduct(element.on_thirds);
    const bool is_round = problem.curves_of(t, stress.degree()).has_value();
    const auto energy_of = [&](const auto& s) {
      return is_round ? stress_product(problem, t, s, s) / 2
                      : strain_energy(s, shape.area_mm2, problem.compliance_of(t), element.mass);
    };
    error.of_triangle_Nmm[t] =
        traces.of(t) ? traces.squared_distance(t, difference, of_u) : 2 * energy_of(difference);
    fields.energy += energy_of(own);
    fields.energy_of_u +=
        is_round ? energy_of(other.lazyProduct(element.on_thirds).eval()) : energy_of(other);
    error.body_Nmm += error.of_triangle_Nmm[t];
  }
}

template <int k>
ConstitutiveError error_of(const ContactSystem& system, const StressField& stress,
                           const Eigen::VectorXd& F_C, const DisplacementField& u) {
  const Problem& problem = *system.problem;
  ConstitutiveError error;
  Fields fields{stress, F_C, u, 0, 0};
  const CurvedTraces traces(problem, k + 1, sides_of_stresses(k));
  const DisplacementField of_traces = traces.traces(u);
  add_body(problem, traces, fields, error);
  const std::vector<TriangleSide> sides = boundary_sides(problem.edges);
  double highest_gap = 0, highest_force = 0;
  const Eigen::VectorXd compliance = rough_compliance(problem, system.contact);
  for (int point = 0; point < system.contact.count; point += k + 1) {
    const int row = system.contact.boundary[point], other = problem.opposite_of(row);
    if (problem.is_second_of_pair(row)) continue;  // both sides are one term
    const ContactTerms terms = contact_terms<k>(system, traces, point, F_C, of_traces);
    const double beyond_wall =
        compliance(system.contact.components * point) * terms.beyond_wall_N * terms.beyond_wall_N;
    error.normal_contact_Nmm += terms.normal;
    error.tangential_contact_Nmm += terms.tangential;
    error.beyond_wall_Nmm += beyond_wall;
    const std::vector<int> rows =
        other == Problem::no_row ? std::vector<int>{row} : std::vector<int>{row, other};
    for (const int side : rows)
      error.of_triangle_Nmm[sides[static_cast<std::size_t>(side)].triangle] +=
          (terms.normal + terms.tangential + beyond_wall) / static_cast<double>(rows.size());
    error.sliding.include(terms.sliding);
    highest_gap = std::max(highest_gap, terms.highest_gap);
    highest_force = std::max(highest_force, terms.highest_force);
  }
  judge_admissibility(fields, highest_gap, highest_force, error);
  GeometryError geometry = geometry_error(problem, stress);
  for (std::size_t t = 0; t < geometry.of_triangle_Nmm.size(); ++t) {
    error.geometry_Nmm += geometry.of_triangle_Nmm[t];
    error.of_triangle_Nmm[t] += geometry.of_triangle_Nmm[t];
  }
  error.of_chords_Nmm = std::move(geometry.of_chords_Nmm);
  note_bounds<k>(system, fields, highest_gap, error);
  // Where the mesh lets bodies miss each other, û may know better: then all is error.
  const LoadScale scale = load_scale(problem);
  error.stress_norm = std::sqrt(2 * fields.energy);
  error.displacement_norm = std::sqrt(2 * fields.energy_of_u);
  const double size =
      scale.is_no_energy(error.stress_norm) ? error.displacement_norm : error.stress_norm;
  const auto relative = [&](double squared) {  // below 0 it is rounding of this size
    return scale.relative_energy(std::sqrt(std::abs(squared)), size);
  };
  error.relative = relative(error.squared_Nmm());
  error.relative_of_mean = relative(error.squared_of_mean_Nmm());
  return error;
}

}  // namespace

ConstitutiveError constitutive_error(const ContactSystem& system, const StressField& stress,
                                     const Eigen::VectorXd& F_C, const DisplacementField& u) {
  const int of_u = displacement_degree(*system.problem, u) - 1;
  if (of_u != stress.degree())
    throw std::invalid_argument(
        fmt::format("a displacement of degree {} for stresses of degree {} (allowed: {})", of_u + 1,
                    stress.degree(), stress.degree() + 1));
  return with_degree(stress.degree(), [&](auto k) { return error_of<k>(system, stress, F_C, u); });
}

StressField mean_stress(const Problem& problem, const StressField& stress,
                        const DisplacementField& u) {
  StressField mean = stress_of_displacement(problem, u);
  mean.values() = (mean.values() + stress.values()) / 2;
  return mean;
}

}  // namespace airybench
