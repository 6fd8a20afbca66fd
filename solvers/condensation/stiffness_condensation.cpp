#include "solvers/condensation/stiffness_condensation.hpp"

#include <utility>

#include "solvers/direct/dense_cholesky.hpp"
#include "solvers/direct/factor_counts.hpp"

namespace airybench {

CondensedSystem condense(const StiffnessFactor& factor) {
  CondensedSystem condensed;
  Eigen::MatrixXd L = factor.cholesky.trailing_factor();
  if (L.rows() == 0) return condensed;
  condensed.G = -factor.y.tail(L.rows());
  solve_lower_transposed(L, condensed.G);
  condensed.D = inverse_from_factor(std::move(L));
  return condensed;
}

void condense_load(const Eigen::VectorXd& b, StiffnessFactor& factor, CondensedSystem& condensed) {
  factor.y = factor.cholesky.forward(b);
  const Eigen::MatrixXd L = factor.cholesky.trailing_factor();
  if (L.rows() == 0) return;
  condensed.G = -factor.y.tail(L.rows());
  solve_lower_transposed(L, condensed.G);
}

CondensedSystem factorise_and_condense(const ElementMatrices& K, const Eigen::VectorXd& b, int n_c,
                                       const std::string& system, const RunControl& control,
                                       StiffnessFactor& factor, Solution& solution) {
  run_stage(solution.times, Stage::order, MemoryOwner::factor,
            [&] { factor.cholesky.analyse(K, n_c); });
  control.deadline.check("the ordering of the " + system);
  run_stage(solution.times, Stage::factor, MemoryOwner::factor,
            [&] { factor.cholesky.factor(K, control.deadline); });
  control.deadline.check("the factorisation of the " + system);
  CondensedSystem condensed;
  {
    const StageTimer timer(solution.times, Stage::condense);
    const OwnerScope scope_of_y(MemoryOwner::factor);
    factor.y = factor.cholesky.forward(b);
    const OwnerScope scope(MemoryOwner::condensed);
    condensed = condense(factor);
  }
  count_factor(factor.cholesky, solution);
  solution.storage[MemoryOwner::factor] +=
      static_cast<std::size_t>(factor.y.size()) * sizeof(double);
  return condensed;
}

Eigen::VectorXd all_displacements(StiffnessFactor& factor,
                                  const Eigen::VectorXd& contact_displacement) {
  Eigen::VectorXd u = factor.y;
  if (contact_displacement.size() > 0)
    u.tail(contact_displacement.size()) =
        transposed_times(factor.cholesky.trailing_factor(), contact_displacement);
  return factor.cholesky.backward(u);
}

}  // namespace airybench
