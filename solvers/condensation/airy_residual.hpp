// Residuals of the discrete system in the Airy function (dual_system.hpp), in long double and
// straight from the mesh.
#pragma once

#include "assembly/dual_system.hpp"
#include "assembly/stress_field.hpp"

namespace airybench {

// x: scaled Airy unknowns; λ, λ' as in DualSystem. Also the residuals of their equations.
struct LongSaddleVector {
  LongVector x, lambda_F, lambda_C;
};

// r, r_F, r_C as in airy_refinement.hpp.
LongSaddleVector airy_residual(const DualSystem& system, const LongSaddleVector& answer,
                               const Eigen::VectorXd& F_C);

// The stresses of x, rounded to double.
StressField airy_stress(const DualSystem& system, const LongVector& x);

}  // namespace airybench
