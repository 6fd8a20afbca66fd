#include "assembly/rigid_motion.hpp"

#include <algorithm>
#include <limits>

namespace airybench {

SplitDisplacement split_rigid_motion(
    const std::function<Eigen::Vector2d(const Eigen::Vector2d& x)>& displacement_mm,
    const std::vector<PrescribedEdge>& edges) {
  SplitDisplacement split;
  if (!displacement_mm || edges.empty()) return split;
  struct Sample {
    Eigen::Vector2d x, u;
    double weight;
  };
  // Without the displacement of one point: what a translation leaves is exactly zero then.
  const Eigen::Vector2d base = displacement_mm(edges.front().start);
  std::vector<Sample> samples;
  double total = 0, largest = base.cwiseAbs().maxCoeff();
  Eigen::Vector2d centre = Eigen::Vector2d::Zero(), mean = Eigen::Vector2d::Zero();
  for (const PrescribedEdge& edge : edges) {
    const double length = (edge.end - edge.start).norm();
    for (const int k : {0, 1, 2}) {
      const Eigen::Vector2d x = edge.start + k * (edge.end - edge.start) / 2;
      const Eigen::Vector2d u = displacement_mm(x);
      largest = std::max(largest, u.cwiseAbs().maxCoeff());
      samples.push_back({x, u - base, length * (k == 1 ? 4 : 1) / 6});
      total += samples.back().weight;
      centre += samples.back().weight * x;
      mean += samples.back().weight * samples.back().u;
    }
  }
  centre /= total;
  mean /= total;
  // ω = ∫ (J d)·u / ∫ |d|², d = x − centre: translation and rotation are orthogonal.
  double moment = 0, inertia = 0;
  for (const Sample& s : samples) {
    const Eigen::Vector2d d = s.x - centre;
    moment += s.weight * (d.x() * s.u.y() - d.y() * s.u.x());
    inertia += s.weight * d.squaredNorm();
  }
  const RigidMotion of_rest{centre, mean, inertia > 0 ? moment / inertia : 0};
  split.motion = {centre, base + mean, of_rest.rotation};
  double left = 0;
  for (const Sample& s : samples)
    left = std::max(left, (s.u - of_rest.at(s.x)).cwiseAbs().maxCoeff());
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  if (left > rounding * largest)
    split.rest_mm = [displacement_mm, base, of_rest](const Eigen::Vector2d& x) -> Eigen::Vector2d {
      return (displacement_mm(x) - base) - of_rest.at(x);
    };
  return split;
}

}  // namespace airybench
