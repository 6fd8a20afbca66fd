#include "mesh/quality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace airybench {

double smallest_angle_deg(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                          const Eigen::Vector2d& c) {
  const double twice_area = std::abs(cross_area(a, b, c));
  const auto angle = [&](const auto& at, const auto& p, const auto& q) {
    return std::atan2(twice_area, (p - at).dot(q - at));
  };
  return std::min({angle(a, b, c), angle(b, c, a), angle(c, a, b)}) * 180 / std::numbers::pi;
}

double mean_ratio(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const double squares = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return 2 * std::numbers::sqrt3 * cross_area(a, b, c) / squares;
}

MeshQuality mesh_quality(const Mesh& mesh) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  MeshQuality quality{infinity, infinity, 0};
  for (const auto& [i, j, k] : mesh.triangles) {
    const Eigen::Vector2d &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
    const double q = mean_ratio(a, b, c);
    quality.smallest_angle_deg = std::min(quality.smallest_angle_deg, smallest_angle_deg(a, b, c));
    quality.min_mean_ratio = std::min(quality.min_mean_ratio, q);
    quality.mean_mean_ratio += q / static_cast<double>(mesh.triangles.size());
  }
  return quality;
}

}  // namespace airybench
