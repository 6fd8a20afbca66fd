#include "solvers/condensation/stiffness_condensation.hpp"

#include <utility>

#include "solvers/direct/dense_factors.hpp"
#include "solvers/direct/factor_counts.hpp"

namespace airybench {

Eigen::MatrixXd MultifrontalStiffness::compliance() {
  return n_c_ > 0 ? inverse_from_factor(factor_.trailing_factor()) : Eigen::MatrixXd();
}

Eigen::VectorXd MultifrontalStiffness::load(const Eigen::VectorXd& b) {
  {
    const OwnerScope scope(MemoryOwner::factor);
    y_ = factor_.forward(b);
  }
  Eigen::VectorXd G = -y_.tail(n_c_);
  if (n_c_ > 0) solve_lower_transposed(factor_.trailing_factor(), G);
  return G;
}

Eigen::VectorXd MultifrontalStiffness::recover(const Eigen::VectorXd&, const Eigen::VectorXd& u_C) {
  Eigen::VectorXd u = y_;
  if (n_c_ > 0) u.tail(n_c_) = transposed_times(factor_.trailing_factor(), u_C);
  return factor_.backward(u);
}

void MultifrontalStiffness::count(Solution& solution) const {
  count_factor(factor_, solution);
  solution.storage[MemoryOwner::factor] += static_cast<std::size_t>(y_.size()) * sizeof(double);
}

contact::Problem factorise_and_condense(StiffnessFactor& factor, const Eigen::VectorXd& b,
                                        const ContactPoints& points, const std::string& system,
                                        const Deadline& deadline, Solution& solution) {
  run_stage(solution.times, Stage::order, MemoryOwner::factor, [&] { factor.analyse(); });
  deadline.check("the ordering of the " + system);
  run_stage(solution.times, Stage::factor, MemoryOwner::factor, [&] { factor.factor(deadline); });
  deadline.check("the factorisation of the " + system);
  contact::Problem condensed{.points = points};
  run_stage(solution.times, Stage::condense, MemoryOwner::condensed, [&] {
    condensed.G = factor.load(b);
    condensed.D = factor.compliance();
  });
  factor.count(solution);
  return condensed;
}

}  // namespace airybench
