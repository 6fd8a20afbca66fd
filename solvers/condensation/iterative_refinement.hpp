// Iterative refinement of the hybridized system (Wilkinson 1963; Higham, Accuracy and Stability of
// Numerical Algorithms, ch. 12):  r = b + F_C − K u,  u ← u + M⁻¹ r.
//
// K, b, u and r are Wide numbers (wide.hpp), K from element matrices that were computed so; M is
// the factor of K rounded to double. A step divides the error by about 1/(cond K · 1e-16); in the
// end the error is that of the residual, about cond K · 1e-19 or less.
#pragma once

#include "assembly/wide_vector.hpp"
#include "solvers/condensation/hybridized.hpp"

namespace airybench {

struct Refined {
  WideVector u;  // empty: zero
  int corrections = 0;
  double last_correction = 0;  // √(δᵀ K δ) of the last one, √(N mm)
};

// Refines u, from where it stands, until a correction is not half as large as the one before.
// F_C: contact forces, N. factor: of K.
void refine(const HybridizedSystemIn<Wide>& system, const MultifrontalFactor& factor,
            const Eigen::VectorXd& F_C, Refined& refined);

}  // namespace airybench
