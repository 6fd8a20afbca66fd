#include "bench/problems/known_rows.hpp"

#include "assembly/row_order.hpp"

namespace airybench {

std::vector<KnownRow> known_rows(const Problem& problem, Known known) {
  std::vector<KnownRow> rows;
  const auto add_edge = [&](int row) {
    const EdgeCondition condition = problem.condition(row);
    for (const int end : {0, 1}) {
      const EdgeFrame frame = problem.frame_of_moment(row, end);
      const std::array<Eigen::Vector2d, 2> axes =
          condition.in_frame
              ? std::array{frame.normal, frame.tangent}
              : std::array<Eigen::Vector2d, 2>{Eigen::Vector2d::UnitX(), Eigen::Vector2d::UnitY()};
      for (int i = 0; i < 2; ++i)
        if (condition.component[i] == known) rows.push_back({row, end, axes[i]});
    }
  };
  for_each_boundary_row(problem.mesh, add_edge);
  return rows;
}

}  // namespace airybench
