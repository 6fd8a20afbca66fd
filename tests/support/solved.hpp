// Methods' answers, and how far one is from another.
#pragma once

#include <cmath>
#include <string>

#include "assembly/displacement_field.hpp"
#include "solvers/methods.hpp"
#include "tests/support/dense_algebra.hpp"

namespace airybench::testing {

inline Solution solved_by(const std::string& method, const ContactSystem& system,
                          const RunControl& control = {}) {
  return run(select_methods(method).front(), system, control);
}

// Of a displacement method, of one in the Airy function.
inline const DisplacementField& displacement(const Solution& solution) {
  return std::get<Displacements>(solution.unknowns).w;
}
inline const Eigen::VectorXd& phi(const Solution& solution) {
  return std::get<AiryFunction>(solution.unknowns).phi;
}

inline RunControl with_tolerance(double tolerance) {
  RunControl control;
  control.tolerance = tolerance;
  return control;
}

inline RunControl out_of_time() {
  RunControl control;
  control.deadline = Deadline::after(-1);
  return control;
}

// Relative to the reference's, which is not zero: of contact forces, and of stresses in the energy
// norm.
inline double force_error(const Solution& solution, const Solution& reference) {
  return distance(solution.F_C, reference.F_C) / reference.F_C.norm();
}
inline double stress_error(const Problem& problem, const Solution& solution,
                           const Solution& reference) {
  return stress_distance(problem, solution.stress, reference.stress) /
         std::sqrt(stress_norm_squared(problem, reference.stress));
}

}  // namespace airybench::testing
