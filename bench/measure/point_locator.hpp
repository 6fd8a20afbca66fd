// Where a point of a body is, and stress and displacement there.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "assembly/displacement_field.hpp"
#include "assembly/stress_field.hpp"
#include "bench/records/json.hpp"

namespace airybench {

// Finds points among the thirds of triangles, up to the curves that stresses of a degree follow.
// Triangles are sorted into squares; a search costs those of one.
class PointLocator {
 public:
  PointLocator(const Problem& problem, int degree);

  struct Place {
    int triangle, third;
    Eigen::Vector3d weights;  // of V_k, V_k+1 and the centroid; beyond a chord the last is negative
  };
  std::optional<Place> place_of(const Eigen::Vector2d& x) const;  // none: outside

 private:
  std::optional<Place> place_in(int triangle, const Eigen::Vector2d& x) const;
  const std::vector<int>& in_square(int i, int j) const { return squares_[j * columns_ + i]; }
  std::pair<int, int> square_of(const Eigen::Vector2d& x) const;

  const Problem& problem_;
  int degree_;
  Eigen::Vector2d corner_;
  double size_mm_ = 1;
  int columns_ = 1, rows_ = 1;
  std::vector<std::vector<int>> squares_;  // their triangles
};

// xx, yy, xy in MPa; NaN outside the body. Where triangles meet, of one of them.
Eigen::Vector3d stress_at(const PointLocator& locator, const StressField& stress,
                          const Eigen::Vector2d& x);

// A list of at_mm, stress_MPa and, if the displacement u is known, displacement_mm; null where a
// point is outside.
Json values_at_points(const Problem& problem, const StressField& stress,
                      const std::optional<DisplacementField>& u,
                      const std::vector<Eigen::Vector2d>& points_mm);

}  // namespace airybench
