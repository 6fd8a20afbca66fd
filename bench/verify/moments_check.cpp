#include "bench/verify/moments_check.hpp"

#include <array>

#include "solvers/condensation/hybridized.hpp"

namespace airybench {
namespace {

// Moments in the components of EdgeUnknowns.
Eigen::Matrix4Xd in_frames(const Problem& problem, Eigen::Matrix4Xd moments) {
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row) {
    if (!problem.condition(row).in_frame) continue;
    const auto [a, b] = problem.mesh.boundary[row].vertices;
    auto own = moments.col(problem.edges.of_boundary[row]);
    const bool low_first = a < b;
    const std::array<Eigen::Vector2d, 2> walked = {low_first ? own.head<2>() : own.tail<2>(),
                                                   low_first ? own.tail<2>() : own.head<2>()};
    for (int end = 0; end < 2; ++end) {
      const EdgeFrame frame = problem.frame_of_moment(row, end);
      own.segment<2>(2 * end) << frame.normal.dot(walked[end]), frame.tangent.dot(walked[end]);
    }
  }
  return moments;
}

}  // namespace

MomentsCheck check_moments(const DualSystem& system, const Eigen::Matrix4Xd& edge_moments) {
  const Problem& problem = *system.problem;
  const Eigen::Matrix4Xd moments = in_frames(problem, edge_moments);
  HybridizedSystem hybrid;
  hybrid.n_c = system.contact.size();
  const int inner = number_unknowns(problem, system.contact, hybrid.unknown);
  hybrid.displacement = prescribed_displacements(problem);
  hybrid.b.setZero(inner + hybrid.n_c);
  Eigen::VectorXd u(hybrid.b.size());
  for (int edge = 0; edge < problem.edges.count(); ++edge)
    for (int k = 0; k < 4; ++k)
      if (const int unknown = hybrid.unknown[edge][k]; unknown != prescribed_unknown)
        u(unknown) = moments(k, edge);
  return {recover_stresses(problem, hybrid, u).stress, u.tail(hybrid.n_c)};
}

}  // namespace airybench
