// A curved piece of a body's boundary: the polynomial of degree n through n + 1 points at
// equidistant parameters,
//
//   x(i/n) = p_i,   0 ≤ t ≤ 1
//
// Its ends are p_0 and p_n, its chord is the straight line between them.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace airybench {

struct EdgeCurve {
  // An arc of 22.5° through points of this degree is off by 1.5e-12 of its radius, one of 45° by
  // 4e-10.
  static constexpr int max_degree = 7;

  std::vector<Eigen::Vector2d> points_mm;  // p_i; none: the chord

  bool is_straight() const { return points_mm.empty(); }
  int degree() const { return static_cast<int>(points_mm.size()) - 1; }
  Eigen::Vector2d chord() const { return points_mm.back() - points_mm.front(); }

  // Of a curve that is not straight.
  Eigen::Vector2d at(double t) const;
  Eigen::Vector2d derivative(double t) const;
  Eigen::Vector2d normal(double t) const;  // of length 1, to the right of the walk
  // The part from x(first) to x(last), first < last; also beyond 0 and 1.
  EdgeCurve between(double first, double last) const;
  // Where the line through p along d meets the curve, or would beyond its ends; d is across it.
  double parameter_on_line(const Eigen::Vector2d& p, const Eigen::Vector2d& d) const;
  // The same curve with other ends, which are near to its own.
  void move_ends(const Eigen::Vector2d& start, const Eigen::Vector2d& end);
  // The largest distance from the chord, to a few percent.
  double sagitta() const;
};

// Between a curve and its chord, mm²; positive to the right of the chord, outside a body.
double segment_area(const EdgeCurve& curve);

// Whether the third of a triangle abc on ab stays one if ab becomes this curve: each point of it is
// seen from the centroid V4, as (x − V4) × x′, whose Bernstein coefficients are compared with its
// value on the chord.
bool fits(const EdgeCurve& ab, const Eigen::Vector2d& c);

}  // namespace airybench
