// A problem solved in stresses by HYBRID and in displacements, which are recovered from the
// stresses or P2's.
#pragma once

#include <gtest/gtest.h>

#include "assembly/problem/pose.hpp"
#include "solvers/methods.hpp"
#include "tests/support/places.hpp"
#include "tests/support/solved.hpp"
#include "verify/discretisation_error.hpp"
#include "verify/displacement_recovery.hpp"

namespace airybench::testing {

inline Solution answered_by(const std::string& method, const ContactSystem& system) {
  Solution solution = run(select_methods(method).front(), system, {});
  EXPECT_EQ(solution.status, Status::ok) << method << ": " << solution.message;
  return solution;
}

struct Solved {
  ContactSystem system;
  Solution hybrid;
  DisplacementField w;  // recovered

  // degree: of the stresses.
  explicit Solved(Problem problem, int degree = 1)
      : system(contact_system(std::make_shared<const Problem>(std::move(problem)), degree)),
        hybrid(answered_by(hybrid_of_degree(degree), system)),
        w(recovered_displacement(system, hybrid)) {}
  Solved(const Scene& scene, Mesh mesh, int degree = 1)
      : Solved(pose(scene, std::move(mesh)), degree) {}

  ConstitutiveError error_with(const DisplacementField& u) const {
    return constitutive_error(system, hybrid.stress, hybrid.F_C, u);
  }
  ConstitutiveError error() const { return error_with(w); }
  Solution p2() const { return answered_by("P2", system); }
  ConstitutiveError error_with_p2() const { return error_with(displacement(p2())); }
};

}  // namespace airybench::testing
