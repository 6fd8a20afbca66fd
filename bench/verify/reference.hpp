// The answer against which every method's error is measured: the hybridized solution of the same
// discrete problem (hybridized.hpp), refined in long double.
//
// Element matrices, residuals and stresses are long doubles; the factor of K in double is only what
// corrections are made with (refinement.hpp). For contact forces F the refined system gives ū_C(F).
// The law is first solved with D and G from the factor, as methods do it; then active-set steps
// follow, with the r of the refined system (a defect correction: D is off by 1e-12, r is not),
// until the natural map no longer halves.
//
// How far that is from the exact solution of the discrete problem, it says itself: the last
// correction of the displacements and the next one of the forces, in the energy norm, and the
// natural map. Compared with the same in 128 bits: tests/bench/verify/extended_precision_test.cpp.
#pragma once

#include "assembly/dual_system.hpp"
#include "assembly/stress_field.hpp"
#include "solvers/contact/condensed.hpp"

namespace airybench {

struct Reference {
  contact::Problem condensed;       // D as factorised; G such that D F_C − G is the refined ū_C
  Eigen::VectorXd F_C;              // N
  StressField stress;               // MPa
  double natural_map_residual = 0;  // of F_C with the refined ū_C, relative
  double error_estimate = 0;        // relative: the largest of the three
};

// Throws Breakdown when the factorisation fails. The caller decides which error is small enough.
// start: contact forces that the law's solver begins with; empty: zero. A solution is refined as it
// is: where the problem has several, the one found is near it.
enum class StartIs { guess, solution };
Reference compute_reference(const DualSystem& system, const Eigen::VectorXd& start = {},
                            StartIs start_is = StartIs::guess);

}  // namespace airybench
