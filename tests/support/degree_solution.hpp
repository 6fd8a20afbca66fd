// An answer in stresses of degree k as methods give it, from DegreeSystem.
#pragma once

#include "assembly/dual_system.hpp"
#include "assembly/equilibrium_element.hpp"
#include "solvers/base/solution.hpp"
#include "solvers/condensation/degree_system.hpp"
#include "solvers/condensation/edge_unknowns.hpp"

namespace airybench::testing {

inline Solution solved_by_degree(const Problem& problem, int degree) {
  const DegreeSystem system = assemble_degree_system(problem, degree);
  const DegreeAnswer answer = solve_degree_system(problem, system);
  Solution solution;
  solution.status = answer.contact_converged ? Status::ok : Status::inaccurate;
  solution.F_C = answer.F_C;
  solution.stress = StressField(answer.stress.size(), degree);
  for (std::size_t t = 0; t < answer.stress.size(); ++t) solution.stress[t] = answer.stress[t];
  const std::vector<int> rows = rows_in_frame(problem);
  solution.edge_moments.resize(2 * (degree + 1), problem.edges.count());
  for (int edge = 0; edge < problem.edges.count(); ++edge) {
    const int row = rows[edge];
    for (int j = 0; j <= degree; ++j) {
      Eigen::Vector2d value;
      for (int i = 0; i < 2; ++i) {
        const int unknown = system.unknown[edge][2 * j + i];
        value(i) = unknown < 0 ? system.given(2 * j + i, edge) : answer.u(unknown);
      }
      int place = j;
      if (row != no_frame) {
        const EdgeFrame frame = problem.frame_of_moment(row, 0);
        value = (value.x() * frame.normal + value.y() * frame.tangent).eval();
        const auto [a, b] = problem.mesh.boundary[row].vertices;
        if (a > b) place = degree - j;
      }
      solution.edge_moments.col(edge).segment<2>(2 * place) = value;
    }
  }
  return solution;
}

}  // namespace airybench::testing
