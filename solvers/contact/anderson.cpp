#include "solvers/contact/anderson.hpp"

#include "solvers/base/anderson_acceleration.hpp"
#include "solvers/contact/gauss_seidel.hpp"

namespace airybench {

ContactResult solve_contact_by_anderson(const contact::Problem& problem,
                                        const ContactOptions& options, const Deadline& deadline) {
  constexpr int memory = 10;
  const GaussSeidel by(problem);
  AndersonAcceleration acceleration(problem.points.size(), memory);
  Eigen::VectorXd from = options.start;
  if (from.size() == 0) from.setZero(problem.points.size());
  // F is what a sweep gave, so that it meets the law's bounds; `from` is where the next one begins.
  return iterate_contact(problem, options, deadline, [&](Eigen::VectorXd& F) {
    F = from;
    const double change = by.sweep(F);
    from = acceleration.next(F, F - from);
    return change;
  });
}

}  // namespace airybench
