// The hybridized system for stresses of degree k (equilibrium_element.hpp). As in hybridized.hpp,
//
//   K u = b + F_C,   Σ_e F_e = 0 inside, F on Γ_F, F_C on Γ_C, ū0 on Γ_D,
//
// with 2(k + 1) displacement moments per edge. The contact law holds at the k + 1 Bernstein control
// values of each contact edge's traction: these in the cone, σ_n ≤ 0 and |σ_t| ≤ −μ σ_n hold on the
// whole edge. Gap and ū0 are quadratic on edges, and so exact.
//
// This is the discrete problem and its direct solution; no method of the table yet, and nothing
// that judges an answer. For k = 1 it is HYBRID's problem, solved less fast.
//
// Not for problems with later load steps or slip of earlier ones, or a wall whose normal turns
// along an edge: assemble_degree_system() throws std::invalid_argument.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "assembly/contact_problem.hpp"
#include "assembly/problem.hpp"

namespace airybench {

struct DegreeSystem {
  int degree = 1;
  // Per edge the numbers of its unknowns, two per control value from its low vertex on, x and y; on
  // Γ_C and rollers from its start on, normal and tangential. Negative: prescribed. Contact
  // unknowns come last, in the order of `contact`.
  std::vector<std::vector<int>> unknown;
  Eigen::MatrixXd given;          // ū0, mm: per edge a column, in its components; else zero
  Eigen::SparseMatrix<double> K;  // N/mm, lower triangle
  Eigen::VectorXd b;              // N, without the contact forces
  ContactPoints contact;          // k + 1 points per contact edge
};

// Throws Breakdown naming the triangle whose flexibility is not positive definite to rounding.
// degree: 1 to highest_stress_degree, else std::invalid_argument.
DegreeSystem assemble_degree_system(const Problem& problem, int degree);

struct DegreeAnswer {
  contact::Problem condensed;
  Eigen::VectorXd F_C;  // N
  bool contact_converged = false;
  Eigen::VectorXd u;  // of all unknowns, mm
  // Per triangle: Bernstein coefficients of the stress (EquilibriumElement::Stress), MPa.
  std::vector<Eigen::Matrix3Xd> stress;
  double strain_energy_Nmm = 0;  // ½ ∫ σ:C:σ
  // Largest sum of the stresses' forces and the known ones at a control value, over the largest of
  // these forces.
  double unbalanced = 0;
};
DegreeAnswer solve_degree_system(const Problem& problem, const DegreeSystem& system);

}  // namespace airybench
