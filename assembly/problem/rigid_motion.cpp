#include "assembly/problem/rigid_motion.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>

#include "assembly/elements/edge_forces.hpp"

namespace airybench {

SplitDisplacement split_rigid_motion(const EdgeDisplacement& displacement_mm,
                                     const std::vector<PrescribedEdge>& edges) {
  SplitDisplacement split;
  if (!displacement_mm || edges.empty()) return split;
  struct Sample {
    Eigen::Vector2d x, u;
    double weight;
    Eigen::Matrix2d part;  // prescribed: all, or along a roller's normal
  };
  // Relative to one point's displacement, so that a translation leaves exactly zero.
  const Eigen::Vector2d base = displacement_mm(edges.front().start, edges.front().number);
  std::vector<Sample> samples;
  double total = 0, largest = base.cwiseAbs().maxCoeff();
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  for (const PrescribedEdge& edge : edges) {
    const EdgeFrame frame = edge_frame(edge.start, edge.end);
    const Eigen::Matrix2d part = edge.roller
                                     ? Eigen::Matrix2d(frame.normal * frame.normal.transpose())
                                     : Eigen::Matrix2d::Identity();
    for (const int k : {0, 1, 2}) {
      const Eigen::Vector2d x = edge.start + k * (edge.end - edge.start) / 2;
      const Eigen::Vector2d u = displacement_mm(x, edge.number);
      largest = std::max(largest, u.cwiseAbs().maxCoeff());
      samples.push_back({x, part * (u - base), frame.length_mm * (k == 1 ? 4 : 1) / 6, part});
      total += samples.back().weight;
      centre += samples.back().weight * x;
    }
  }
  centre /= total;
  // Normal equations of t and ω. Without rollers they are diagonal up to rounding, as ∫ d = 0.
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (const Sample& s : samples) {
    const Eigen::Vector2d d = s.x - centre;
    Eigen::Matrix<double, 2, 3> motion;  // prescribed part of t + ω J d
    motion << s.part, s.part * Eigen::Vector2d(-d.y(), d.x());
    A += s.weight * motion.transpose() * motion;
    b += s.weight * motion.transpose() * s.u;
  }
  const Eigen::Vector3d best = A.ldlt().solve(b);
  const RigidMotion of_rest{centre, best.head<2>(), best(2)};
  split.motion = {centre, base + best.head<2>(), best(2)};
  double left = 0;
  for (const Sample& s : samples)
    left = std::max(left, (s.u - s.part * of_rest.at(s.x)).cwiseAbs().maxCoeff());
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  if (left > rounding * largest)
    split.rest_mm = [displacement_mm, base, of_rest](const Eigen::Vector2d& x,
                                                     int edge) -> Eigen::Vector2d {
      return (displacement_mm(x, edge) - base) - of_rest.at(x);
    };
  return split;
}

}  // namespace airybench
