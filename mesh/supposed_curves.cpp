#include "mesh/supposed_curves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace airybench {
namespace {

// Consecutive edges in line: from the first to before the last of a chain.
struct StraightSide {
  int first, last;
  Eigen::Vector2d along;  // from its start to its end
};

double turn(const StraightSide& before, const StraightSide& after) {
  const Eigen::Vector2d &a = before.along, &b = after.along;
  return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
}

class SidesOfChain {
 public:
  SidesOfChain(const Mesh& mesh, std::vector<int> rows) : mesh_(mesh), rows_(std::move(rows)) {
    for (int k = 0; k < static_cast<int>(rows_.size()); ++k) {
      const StraightSide edge{k, k + 1, along(k)};
      if (!sides_.empty() && are_one_group(k - 1, k) &&
          std::abs(turn(sides_.back(), edge)) < in_line) {
        sides_.back().last = k + 1;
        sides_.back().along += edge.along;
      } else {
        sides_.push_back(edge);
      }
    }
  }

  void add_curves(std::vector<SupposedCurve>& curves) const {
    const int count = static_cast<int>(sides_.size());
    for (int first = 0; first < count;) {
      int last = first + 1;  // beyond the sides that bend alike
      while (last < count && goes_on(first, last)) ++last;
      if (last - first >= fewest_sides)
        for (int side = first; side < last; ++side) add(side, first, last, curves);
      first = std::max(first + 1, last - 1);  // the last side may begin another curve
      if (last == count) break;
    }
  }

 private:
  static constexpr double degree = std::numbers::pi / 180, in_line = 0.2 * degree,
                          max_turn = 36 * degree;
  static constexpr int fewest_sides = 5;

  Eigen::Vector2d along(int k) const {
    const auto [a, b] = mesh_.boundary[rows_[k]].vertices;
    return mesh_.vertices[b] - mesh_.vertices[a];
  }
  bool are_one_group(int k, int next) const {
    return mesh_.boundary[rows_[k]].group == mesh_.boundary[rows_[next]].group;
  }
  bool is_bent(int side) const {
    return !mesh_.boundary[rows_[sides_[side].first]].curve.is_straight();
  }
  double curvature_before(int side) const {
    const StraightSide &before = sides_[side - 1], &after = sides_[side];
    return 2 * turn(before, after) / (before.along.norm() + after.along.norm());
  }
  bool goes_on(int first, int side) const {
    constexpr double max_of_lengths = 4, max_of_curvatures = 2.5;
    const auto are_alike = [](double a, double b, double most) {  // of one sign, too
      return a * b > 0 && std::abs(a) <= most * std::abs(b) && std::abs(b) <= most * std::abs(a);
    };
    const StraightSide &before = sides_[side - 1], &after = sides_[side];
    return !is_bent(side - 1) && !is_bent(side) && are_one_group(before.last - 1, after.first) &&
           std::abs(turn(before, after)) <= max_turn &&
           are_alike(before.along.norm(), after.along.norm(), max_of_lengths) &&
           (side - 1 == first ||
            are_alike(curvature_before(side - 1), curvature_before(side), max_of_curvatures));
  }
  // From a side to the curve at its end.
  double to_tangent(int side, int other) const {
    const double length = sides_[side].along.norm(), of_other = sides_[other].along.norm();
    return std::abs(turn(sides_[std::min(side, other)], sides_[std::max(side, other)])) * length /
           (length + of_other);
  }
  void add(int side, int first, int last, std::vector<SupposedCurve>& curves) const {
    const double before = side > first ? to_tangent(side, side - 1) : to_tangent(side, side + 1),
                 after = side + 1 < last ? to_tangent(side, side + 1) : before,
                 length = sides_[side].along.norm();
    double start = 0;
    for (int k = sides_[side].first; k < sides_[side].last; ++k) {
      const double end = start + along(k).norm() / length;
      const auto at = [&](double s) { return (1 - s) * -before + s * after; };
      curves.push_back({rows_[k], length, at(start), at(end)});
      start = end;
    }
  }

  const Mesh& mesh_;
  std::vector<int> rows_;
  std::vector<StraightSide> sides_;
};

}  // namespace

double SupposedCurve::sagitta_mm() const {
  return side_mm * std::max(std::abs(from_rad), std::abs(to_rad)) / 4;
}

std::vector<SupposedCurve> supposed_curves(const Mesh& mesh) {
  std::vector<SupposedCurve> curves;
  if (mesh.is_polygon) return curves;
  for (const BoundaryRole role :
       {BoundaryRole::displacement, BoundaryRole::force, BoundaryRole::contact})
    for (std::vector<int>& chain : boundary_chains(mesh, role))
      SidesOfChain(mesh, std::move(chain)).add_curves(curves);
  return curves;
}

}  // namespace airybench
