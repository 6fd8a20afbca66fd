#include "assembly/edge_forces.hpp"

namespace airybench {

EdgeForces edge_forces(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double outward) {
  const EdgeFrame frame = edge_frame(a, b);
  const Eigen::Vector2d& s = frame.tangent;

  using Gradient = Eigen::Matrix<double, 2, 7>;
  Gradient start = Gradient::Zero(), end = Gradient::Zero(), middle = Gradient::Zero();
  start(0, 1) = start(1, 2) = 1;
  end(0, 4) = end(1, 5) = 1;
  // Hermite: φ'(L/2) = 3 (φ_b − φ_a)/(2L) − (φ'_a + φ'_b)/4.
  Eigen::Matrix<double, 1, 7> slope = -s.transpose() * (start + end) / 4;
  slope(0) -= 1.5 / frame.length_mm;
  slope(3) += 1.5 / frame.length_mm;
  middle = s * slope;
  middle.col(6) += outward * frame.normal;

  Eigen::Matrix2d turn;
  turn << 0, 1, -1, 0;
  EdgeForces forces;
  forces.topRows<2>() = turn * (-3 * start + 4 * middle - end) / 2;
  forces.bottomRows<2>() = turn * (start - 4 * middle + 3 * end) / 2;
  return forces;
}

}  // namespace airybench
