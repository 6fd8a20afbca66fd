#include "solvers/condensation/iterative_refinement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace airybench {

void refine(const HybridizedSystemIn<Wide>& system, const MultifrontalFactor& factor,
            const Eigen::VectorXd& F_C, Refined& refined) {
  constexpr int max_corrections = 30;
  if (refined.u.size() == 0) refined.u.setZero(system.b.size());
  WideVector load = system.b;
  load.tail(system.n_c) += F_C.cast<Wide>();
  double before = std::numeric_limits<double>::infinity();
  for (int step = 0; step < max_corrections; ++step) {
    WideVector product = WideVector::Zero(load.size());
    add_product(system.K, refined.u, product);
    const Eigen::VectorXd r = (load - product).cast<double>();
    Eigen::VectorXd correction = r;
    factor.solve_in_place(correction);
    refined.last_correction = std::sqrt(std::max(0.0, r.dot(correction)));
    if (!(refined.last_correction < before / 2)) break;
    refined.u += correction.cast<Wide>();
    ++refined.corrections;
    if (refined.last_correction == 0) break;
    before = refined.last_correction;
  }
}

}  // namespace airybench
