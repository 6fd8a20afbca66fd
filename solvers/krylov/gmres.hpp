// Generalised minimal residuals (Saad & Schultz 1986, doi:10.1137/0907058), preconditioned by a
// symmetric positive definite M and in its inner product, for corrections:
//
//   x in the span of Z = (M⁻¹ r, M⁻¹ A M⁻¹ r, …),  ‖r − A x‖_M⁻¹ minimal
//
// with A nonsymmetric, as long as it is near M. That norm is about the error's energy norm; ‖·‖₂ is
// far from it near incompressibility. V = M Z is orthonormal in M⁻¹: two vectors per iteration, so
// that a few digits are asked for at a time and the caller forms the residual anew.
#pragma once

#include <Eigen/Core>
#include <functional>

#include "solvers/base/solution.hpp"

namespace airybench {

using ApplyTo = std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& y)>;

struct GmresOptions {
  double tolerance = 1e-3;  // ‖r − A x‖_M⁻¹ ≤ tolerance · ‖r‖_M⁻¹ …
  double enough = 0;        // … or ≤ this
  int most_iterations = 20;
};

struct GmresResult {
  int iterations = 0;
  double norm = 0;       // ‖r‖_M⁻¹
  double reduction = 1;  // ‖r − A x‖_M⁻¹ / ‖r‖_M⁻¹ by the recurrence
};

// Throws Breakdown where numbers are not finite, TimeoutReached.
GmresResult solve_by_gmres(const ApplyTo& A, const ApplyTo& M_inverse, const Eigen::VectorXd& r,
                           const GmresOptions& options, const Deadline& deadline,
                           Eigen::VectorXd& x);
// Of its vectors.
std::size_t gmres_bytes(Eigen::Index rows, int iterations);

}  // namespace airybench
