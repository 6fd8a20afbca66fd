// Generalised minimal residuals (Saad & Schultz 1986, doi:10.1137/0907058), preconditioned by a
// symmetric positive definite M and in its inner product, for corrections:
//
//   x in the span of Z = (M⁻¹ r, M⁻¹ A M⁻¹ r, …),  ‖r − A x‖_M⁻¹ minimal
//
// with A nonsymmetric, as long as it is near M. That norm is about the error's energy norm; ‖·‖₂ is
// far from it near incompressibility. V = M Z is orthonormal in M⁻¹, ZᵀV = I, and is not kept: with
// w = A z_j and h = Zᵀ w,
//
//   z = M⁻¹ w − Z h,   ‖w − V h‖²_M⁻¹ = w·z,   z_{j+1} = z / √(w·z)
//
// one vector per iteration. That is classical Gram–Schmidt, and its norms are differences of
// squares: a solve gains seven digits at most, and the caller then forms a new residual.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "solvers/base/solution.hpp"

namespace airybench {

using ApplyTo = std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& y)>;

struct GmresOptions {
  double tolerance = 1e-3;  // ‖r − A x‖_M⁻¹ ≤ tolerance · ‖r‖_M⁻¹ …
  double enough = 0;        // … or ≤ this
  int max_iterations = 20;
  int threads = 1;  // for its vectors; sums do not depend on how many
};

// Its vectors, kept from one solve to the next.
struct KrylovSpace {
  std::vector<Eigen::VectorXd> Z;
  Eigen::VectorXd w;
  std::size_t bytes() const {
    return (Z.size() + 1) * static_cast<std::size_t>(w.size()) * sizeof(double);
  }
};

struct GmresResult {
  int iterations = 0;
  double norm = 0;       // ‖r‖_M⁻¹
  double reduction = 1;  // ‖r − A x‖_M⁻¹ / ‖r‖_M⁻¹ by the recurrence
};

// Throws Breakdown where numbers are not finite, TimeoutReached.
GmresResult solve_by_gmres(const ApplyTo& A, const ApplyTo& M_inverse, const Eigen::VectorXd& r,
                           const GmresOptions& options, const Deadline& deadline,
                           KrylovSpace& space, Eigen::VectorXd& x);

}  // namespace airybench
