// The answer that every method's error is measured against: the hybridized solution of the same
// discrete problem (hybridized.hpp), refined in Wide.
//
// Element matrices, residuals and stresses are Wide; the double factor of K serves only for
// corrections (refinement.hpp). For contact forces F the refined system gives ū_C(F). The law is
// first solved with D and G from the factor, as methods do. Active-set steps with r from the
// refined system follow until the natural map no longer halves (a defect correction: D is off by
// 1e-12, r is not).
//
// The reference estimates its distance from the exact solution of the discrete problem: the last
// correction of the displacements and the next one of the forces, in the energy norm, and the
// natural map. tests/verify/extended_precision_test.cpp compares it with 128 bits.
#pragma once

#include "assembly/contact_system.hpp"
#include "assembly/stress_field.hpp"
#include "solvers/contact/condensed.hpp"

namespace airybench {

struct Reference {
  contact::Problem condensed;       // D as factorised; G such that D F_C − G is the refined ū_C
  Eigen::VectorXd F_C;              // N
  Eigen::VectorXd free_motion_mm;   // as in Solution
  StressField stress;               // MPa
  double natural_map_residual = 0;  // of F_C with the refined ū_C, relative
  double error_estimate = 0;        // largest of the three estimates, relative
};

// Throws Breakdown if the factorisation fails or the law has no finite solution. The caller decides
// which error is small enough. start: initial contact forces; empty: zero. StartIs::solution
// refines `start` as it is: of several solutions the one near it is found.
enum class StartIs { guess, solution };
Reference compute_reference(const ContactSystem& system, const Eigen::VectorXd& start = {},
                            StartIs start_is = StartIs::guess);

}  // namespace airybench
