// How coarsely a file has rounded its coordinates, by their digits.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace airybench {

// Of coordinates of one sign: fields of fixed width hold a digit less of negative ones.
class CoordinateRounding {
 public:
  void add(double coordinate);
  // A unit of the last digit of the largest, if they have 6 to 10 digits or are in single
  // precision; 0: fewer digits are meant exactly; none: not rounded.
  std::optional<double> unit() const;

 private:
  double largest_ = 0;
  int digits_ = 0;
  bool are_single_ = true;
};

// How far points of a file may lie from the curve or line that they are points of. mm_per_unit: of
// the file's coordinates.
double rounding_of_points(const std::vector<Eigen::Vector2d>& points_mm, double mm_per_unit);

}  // namespace airybench
