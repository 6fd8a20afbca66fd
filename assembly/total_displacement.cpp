#include "assembly/total_displacement.hpp"

#include <Eigen/QR>
#include <utility>

#include "assembly/rigid_contact.hpp"

namespace airybench {
namespace {

FreeMotions motion_of_points(const Problem& problem, const DisplacementField& u) {
  const HeldPoints held = held_points(problem);
  Eigen::VectorXd missing_mm(std::ssize(held.rows));
  for (Eigen::Index k = 0; k < missing_mm.size(); ++k) {
    const auto& [at_mm, component, displacement_mm, place] = held.rows[k];
    missing_mm(k) =
        displacement_mm - displacement_at(problem, u, place.triangle, place.lambda)(component);
  }
  const Eigen::MatrixXd open = motion_spaces(rigid_contact(problem)).open;
  FreeMotions motion = problem.free;
  if (open.cols() > 0)
    motion.amounts_mm =
        open * (held.of_motions * open).completeOrthogonalDecomposition().solve(missing_mm);
  return motion;
}

}  // namespace

DisplacementField with_rigid_motion(const Problem& problem, DisplacementField w) {
  DisplacementField u = with_motion(
      problem, std::move(w),
      [&](const Eigen::Vector2d& x, int vertex) { return problem.motion_at(x, vertex); });
  if (problem.loads.points.empty()) return u;
  const FreeMotions motion = motion_of_points(problem, u);
  return with_motion(problem, std::move(u),
                     [&](const Eigen::Vector2d& x, int vertex) { return motion.at(x, vertex); });
}

}  // namespace airybench
