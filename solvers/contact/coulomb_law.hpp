// Signorini's and Coulomb's law (contact_problem.hpp) at one contact point, and how far a pair (F,
// r) is from it.
#pragma once

#include <Eigen/Core>
#include <utility>

#include "assembly/contact_problem.hpp"
#include "solvers/contact/paired_points.hpp"

namespace airybench {

// The F that meets the law with r = D F + b, exactly: open, stick, slip in either direction are
// tried in turn. D is symmetric positive definite. The solution is unique for μ |D_nt| < D_nn;
// beyond that the first case that holds is taken, and when none does, the one that holds best.
Eigen::Vector2d solve_coulomb_law(const Eigen::Matrix2d& D, const Eigen::Vector2d& b, double mu);
// The same in space, to rounding. A slipping point has r_n = 0 and r_t = −κ F_t with κ > 0, so that
//
//   (S + κ) F_t = −c,  S = D_tt − D_tn D_nt / D_nn,  c = b_t − D_tn b_n / D_nn,
//   F_n = −(b_n + D_nt F_t) / D_nn,  |F_t| + μ F_n = 0.
//
// Where sticking breaks the law, the last expression is positive at κ = 0, and it is negative for
// large κ. Its root is found by Newton's method for 1/|F_t| = −1/(μ F_n), nearly linear in κ, and
// by halving where a step leaves the bracket. D is positive semidefinite with D_nn > 0.
Eigen::Vector3d solve_coulomb_law(const Eigen::Matrix3d& D, const Eigen::Vector3d& b, double mu);
double solve_signorini_law(double D, double b);

// Projection in two steps: F_n to min(F_n, 0), then F_t to [μF_n, −μF_n], in space to the disc
// of radius −μF_n.
Eigen::Vector2d project_on_coulomb(const Eigen::Vector2d& F, double mu);
// Of every point; without friction there is only the normal part.
Eigen::VectorXd project_on_coulomb(const ContactPoints& contact, Eigen::VectorXd F);
void project_in_place(const ContactPoints& contact, Eigen::Ref<Eigen::VectorXd> F);

// ū_C − ḡ of every body, in the precision of ū_C.
template <typename Vector>
Vector less_gap(const ContactPoints& contact, Vector displacement) {
  if (contact.gap.size() > 0) displacement -= contact.gap.template cast<typename Vector::Scalar>();
  return displacement;
}
// r: of a pair the sum, at both points.
template <typename Vector>
Vector relative_to_gap(const ContactPoints& contact, Vector displacement) {
  return sums_of_pairs(contact, less_gap(contact, std::move(displacement)));
}

// F − ρ r, N, with ρ_n = 1/D_nn and ρ_t = 1/D_tt, of a pair the sum of both, in space the mean of
// both D_tt: one ρ_t keeps the direction of r_t.
Eigen::VectorXd trial_forces(const ContactPoints& contact, const Eigen::VectorXd& D_diagonal,
                             const Eigen::VectorXd& F, const Eigen::VectorXd& r);

// F − P(F − ρ r) at every point: zero exactly when the law holds; N. Vectors are in the rows of
// F_C.
Eigen::VectorXd natural_map_of(const ContactPoints& contact, const Eigen::VectorXd& D_diagonal,
                               const Eigen::VectorXd& F_C, const Eigen::VectorXd& r);
// displacement: ū_C.
Eigen::VectorXd natural_map(const ContactPoints& contact, const Eigen::VectorXd& D_diagonal,
                            const Eigen::VectorXd& F_C, const Eigen::VectorXd& displacement);
// What errors of contact forces are relative to, N: their norm; where bodies just touch, and it is
// only rounding of the forces that would undo the displacements without contact, that of these.
double size_of_forces(double norm_N, double undoing_N);

// Its norm over that size; where this is zero its norm.
double relative_natural_map(const ContactPoints& contact, const Eigen::VectorXd& D_diagonal,
                            const Eigen::VectorXd& F_C, const Eigen::VectorXd& displacement,
                            double undoing_N = 0);

}  // namespace airybench
