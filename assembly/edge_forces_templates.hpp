// The formula of edge_forces.hpp, for whoever instantiates it for a scalar of their own.
#pragma once

#include "assembly/edge_forces.hpp"

namespace airybench {

template <typename Scalar>
EdgeForcesIn<Scalar> edge_forces(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                                 double outward) {
  const EdgeFrameIn<Scalar> frame = edge_frame<Scalar>(a, b);
  const Eigen::Vector2<Scalar>& s = frame.tangent;

  using Gradient = Eigen::Matrix<Scalar, 2, 7>;
  Gradient start = Gradient::Zero(), end = Gradient::Zero(), middle = Gradient::Zero();
  start(0, 1) = start(1, 2) = 1;
  end(0, 4) = end(1, 5) = 1;
  // Hermite: φ'(L/2) = 3 (φ_b − φ_a)/(2L) − (φ'_a + φ'_b)/4.
  Eigen::Matrix<Scalar, 1, 7> slope = -s.transpose() * (start + end) / Scalar(4);
  slope(0) -= Scalar(1.5) / frame.length_mm;
  slope(3) += Scalar(1.5) / frame.length_mm;
  middle = s * slope;
  middle.col(6) += Scalar(outward) * frame.normal;

  Eigen::Matrix2<Scalar> turn;
  turn << 0, 1, -1, 0;
  const Scalar two = 2, three = 3, four = 4;
  EdgeForcesIn<Scalar> forces;
  forces.template topRows<2>() = turn * (-three * start + four * middle - end) / two;
  forces.template bottomRows<2>() = turn * (start - four * middle + three * end) / two;
  return forces;
}

}  // namespace airybench
