// The judge: checks a solution independently of the method that made it. No solver may call it.
//
// It uses the element stresses, the contact forces and the reference. Errors are relative:
//   error_stress          ‖σ − σ_ref‖ / ‖σ_ref‖   in the energy norm, ‖σ‖² = ∫ σ:C:σ
//   error_force           ‖F_C − F_ref‖ / ‖F_ref‖  in the D-norm, ‖F‖² = Fᵀ D F
//   equilibrium_residual  largest unbalanced force of the stresses (across inner edges, against f
//                         on Γ_F, against F_C on Γ_C, between two bodies), largest jump of
//                         tractions between thirds and largest coefficient of ∇·σ + b times the
//                         third's area, over the largest edge force
//   natural_map_residual  ‖F − P(F − ρ r)‖ / ‖F‖, r from the reference's D and G (coulomb_law.hpp)
#pragma once

#include <array>
#include <limits>
#include <optional>

#include "assembly/contact_system.hpp"
#include "assembly/problem/load_scale.hpp"
#include "solvers/base/solution.hpp"
#include "verify/reference.hpp"

namespace airybench {

// Empty: not applicable (no contact, no reference, no body).
struct Verification {
  std::optional<double> error_stress;
  std::optional<double> error_force;
  std::optional<double> reference_error;  // the reference's own estimate
  // Without a reference: distance of the stresses from those of the edge moments, relative in the
  // energy norm. Not an error: see check_moments().
  std::optional<double> stress_of_moments_off;
  // Of displacements: how far they are from those prescribed, over the largest.
  std::optional<double> prescribed_off;
  // Of a path of load steps with friction: how far the tangential ū_C, from which the next step
  // measures slip, is from the right one, as forces ρ_t Δu_t over ‖F‖, and in N.
  std::optional<double> slip_off;
  double slip_off_N = 0;
  // The stress of the reference or displacement method is zero; errors are relative to the loads.
  bool unstressed = false;
  std::optional<double> equilibrium_residual = std::numeric_limits<double>::infinity();
  std::optional<double> natural_map_residual;
  std::optional<double> signorini_violation_N;   // largest normal component of the natural map
  std::optional<double> coulomb_violation_N;     // largest tangential component
  std::optional<double> normal_resultant_N;      // Σ F_n
  std::optional<double> tangential_resultant_N;  // Σ F_t
  double strain_energy_Nmm = 0;                  // W = ½ ∫ σ:C:σ; without a body ½ Fᵀ D F
  std::optional<double>
      complementary_energy_Nmm;  // Π* = W + ∫ σ:ε0 − ∫_{Γ_D} u0·σn − ∫_{Γ_C} g0 σ_n
  std::optional<int> n_open, n_stick, n_slip;  // contact points
  // Largest μ|D_nt| / D_nn of a contact point. From 1 on the law may have several solutions.
  std::optional<double> friction_coupling;
  std::optional<double> siconos_error;  // without a body
  // contact_violations.hpp; penetration is known of displacements.
  std::optional<double> penetration_mm, edge_penetration_mm, penetration_share;
  std::optional<double> tension, friction_excess;
  std::optional<double> unbalanced_N;  // |Σ loads + contact forces + reactions on Γ_D|
};

// By the judge of its unknowns. reference: may be null; then edge displacements, if any, and
// ρ = 1/rough_compliance check the law. Displacements do not need it.
Verification verify(const ContactSystem& system, const Solution& solution,
                    const Reference* reference);

// Of displacements, whose discrete problem has no reference: judges displacements and
// forces at the control points (control_points.hpp). Sets no error_*, no complementary energy.
//   prescribed_off        on Γ_D, of rollers the normal part, less what printed digits explain
//   equilibrium_residual  largest unbalanced nodal force, ∫ σ(u):ε(u_i) − loads, F_C at the control
//                         points, over the largest nodal force of an element; a program's force
//                         without friction may be between the normals of two edges at their vertex,
//                         or of wall and face; less what rounding to its print_precision explains
//   natural_map_residual  with r from u, and ρ = 1/rough_compliance
//   n_open, n_stick, n_slip  of a program from trial forces F − ρ r: its F_n is seldom exactly 0
// A program's weak contact law (ProgramTolerances::weak_contact) also loads inner nodes of the
// triangles along Γ_C. What is unbalanced there is part of the resultants.
Verification verify_displacement(const ContactSystem& system, const Solution& solution);

// For a contact problem without a body: the contact law, and the measure that Siconos stops on
// (fc2d_compute_error; with r = −F, u = W r + q)
//   siconos_error  ‖r − P(r − û)‖ / max(‖r‖, ‖u‖, ‖q‖),  û_n = u_n + μ|u_t|
// where P projects on Coulomb's cone. It depends on the units of W.
Verification verify(const contact::Problem& problem, const Eigen::VectorXd& F_C);

// Replaces the reference for large bodies: are the stresses those of the edge displacements, and do
// these satisfy the contact law? With equilibrium this is the whole discrete problem, but it bounds
// no error.
inline constexpr int largest_with_reference = 1'000'000;  // n_φ
struct MomentsCheck {
  StressField stress;                    // of the edge displacements, u0 on Γ_D; MPa
  Eigen::VectorXd contact_displacement;  // ū_C, mm; rows as in F_C
};
MomentsCheck check_moments(const ContactSystem& system, const Eigen::MatrixXd& edge_moments);

// ∫_{Γ_D} u0·σn + ∫_{Γ_C} g0 σ_n = ½ ∫ σ:C:σ + ∫ σ:ε₀ − Π*, N mm; F_C at the contact points.
double work_of_prescribed(const ContactSystem& system, const StressField& stress,
                          const Eigen::VectorXd& F_C);

// The parts of verify(): resultants, violations and states of F; states alone; violation of the law
// by F and u_C with ρ = 1/D_diagonal; all with D, plus the friction coupling.
void note_contact_forces(const ContactPoints& contact, const Eigen::VectorXd& F,
                         Verification& result);
void note_contact_states(const ContactPoints& contact, const Eigen::VectorXd& F,
                         Verification& result);
void note_contact_law(const ContactPoints& contact, const Eigen::VectorXd& F,
                      const Eigen::VectorXd& displacement, const Eigen::VectorXd& D_diagonal,
                      const LoadScale& scale, Verification& result);

// Of a path of load steps with friction; displacement: ū_C as the method gives it.
void note_slip(const Problem& problem, const ContactPoints& contact, const Eigen::VectorXd& F,
               const Eigen::VectorXd& displacement, const Eigen::VectorXd& expected,
               const Eigen::VectorXd& D_diagonal, const LoadScale& scale, Verification& result);

void note_contact(const ContactPoints& contact, const Eigen::MatrixXd& D, const Eigen::VectorXd& F,
                  const Eigen::VectorXd& displacement, const LoadScale& scale,
                  Verification& result);

// The largest relative measure; it decides between ok and inaccurate.
struct WorstMeasure {
  const char* name;
  double value;
};
WorstMeasure worst_measure(const Verification& verification);

enum class ContactState { open, stick, slip };
constexpr const char* name_of(ContactState state) {
  constexpr std::array<const char*, 3> names = {"open", "stick", "slip"};
  return names[static_cast<std::size_t>(state)];
}
// Open: |F_n| ≤ 1e-9 of the largest normal force; slip: |F_t| ≥ (1 − 1e-9) μ|F_n|. Without friction
// closed points slip.
std::vector<ContactState> contact_states(const ContactPoints& contact, const Eigen::VectorXd& F_C);

// A fingerprint of an answer's leading digits: equal hashes from different machines, builds or
// methods mean that they found the same answer.
//
// It hashes four rounded sums, which are more accurate than single entries. The rounding puts the
// likely exact values (no friction, C = −W) in the middle of a step:
//   strain energy W, normal resultant N   to 5 significant digits
//   complementary energy C                as C / (W + |C|) in steps of 1e-5
//   tangential resultant T                as T / (|N| + |T|) in steps of 1e-5
// A sum may lie at the edge of a step, so an error of 1e-9 changes the hash of about one answer in
// a thousand, ALM's 1e-7 that of a few in a hundred. If hashes differ, compare the digits.
//
// 16 hexadecimal digits of SHA-256. Empty if the answer is unstressed (all rounding) or not finite.
std::string answer_hash(const Verification& verification);

}  // namespace airybench
