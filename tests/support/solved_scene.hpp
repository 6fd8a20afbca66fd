// A scene solved on a mesh by a method, and its total error.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "solvers/loading/load_steps.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/solved.hpp"
#include "verify/discretisation_error.hpp"
#include "verify/displacement_recovery.hpp"

namespace airybench::testing {

struct SolvedScene {
  ContactSystem system;
  Solution solution;

  // allowed: besides ok.
  SolvedScene(const Scene& scene, const Mesh& mesh, const std::string& name,
              Status allowed = Status::ok) {
    const Method method = select_methods(name).front();
    const std::unique_ptr<ContactSystem> assembled = assemble(method, posed(scene, mesh));
    solution = solve_load_case(method.solve, *assembled, {});
    system = *assembled;
    if (solution.status != allowed) {
      EXPECT_EQ(solution.status, Status::ok) << name << ": " << solution.message;
    }
  }
  const Problem& problem() const { return *system.problem; }
  double energy() const { return stress_norm_squared(problem(), solution.stress) / 2; }
  ConstitutiveError recovered_error() const {
    return constitutive_error(system, solution.stress, solution.F_C,
                              recovered_displacement(system, solution));
  }
};

}  // namespace airybench::testing
