// Residuals of the discrete system in the Airy function (airy_system.hpp), in Wide and
// straight from the mesh.
#pragma once

#include "assembly/airy_system.hpp"
#include "assembly/stress_field.hpp"
#include "assembly/wide_vector.hpp"

namespace airybench {

// x: scaled Airy unknowns; λ, λ' as in AirySystem. Also the residuals of their equations.
struct LongSaddleVector {
  WideVector x, lambda_F, lambda_C;
};

struct AiryResidual {
  LongSaddleVector residual;
  double stress_norm = 0;  // of the answer, with the particular stress, √(N mm)
};

// r, r_F, r_C as in airy_refinement.hpp, and r moved by about as much as it is uncertain: by ± the
// rounding of a Wide in the terms |σ(φ_i)|:|C|:Σ|σ(φ_j) φ_j| that it sums. So corrections do
// not fall below what rounding, through the system's condition, makes of the answer. number: of the
// correction; each has other signs.
AiryResidual airy_residual(const AirySystem& system, const LongSaddleVector& answer,
                           const Eigen::VectorXd& F_C, int number = 0);

// Of the stresses σ of x, without the particular stress, element by element.
struct AiryProduct {
  // √∫ σ:C:σ, √(N mm): in exact arithmetic √(xᵀSx), which on slivers is rounding, and often that of
  // a negative number.
  double stress_norm = 0;
  Eigen::VectorXd S_x;
};
AiryProduct airy_product(const AirySystem& system, const Eigen::VectorXd& x);

// The stresses of x, rounded to double.
StressField airy_stress(const AirySystem& system, const WideVector& x);

}  // namespace airybench
