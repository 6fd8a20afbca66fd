// Displacements along the curved sides of a body (Problem::round) that are held or in contact.
//
// A field w of degree p is its triangle's polynomial, continued to the curve x(ξ). What is
// asked of it there is asked of its interpolant at the p + 1 Gauss–Lobatto points, in frames R(ξ):
// x and y where it is held, (n, t) of a contact law and of rollers. With the Bernstein coefficients
// of that,
//
//   R(ξ)ᵀ w(x(ξ)) ≈ Σ B_i(ξ) c_i,   d_i = R_i c_i,   R_i: frame()
//
// the d_i between the side's ends take the place of w's coefficients on the chord: d = D w in every
// such triangle, and nothing changes in others. On straight sides d = w. w less ρ² times what its
// trace is more than the interpolant, with x = V4 + ρ (x(ξ) − V4) in the side's third, is then
// admissible where d is.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <vector>

#include "assembly/displacement_field.hpp"

namespace airybench {

class CurvedTraces {
 public:
  // degree: p. Rows and columns as x and y of the triangle's nodes.
  struct Map {
    Eigen::MatrixXd to_traces, to_coefficients;  // D, D⁻¹
    DisplacementTriangle::Stiffness of_traces(const DisplacementTriangle::Stiffness& K) const;
  };
  // sides: chords for displacements that go with stresses of degree 1; d = w then.
  CurvedTraces(const Problem& problem, int degree, Sides sides = Sides::curves);

  int degree() const { return degree_; }
  bool empty() const { return maps_.empty(); }
  const Map* of(int triangle) const;  // null: d = w
  DisplacementField traces(const DisplacementField& w) const { return mapped(w, &Map::to_traces); }
  DisplacementField coefficients(const DisplacementField& d) const {
    return mapped(d, &Map::to_coefficients);
  }
  // The work partners of d, N, from those of w: D⁻ᵀ of them.
  Eigen::Matrix2Xd forces(Eigen::Matrix2Xd of_coefficients) const;
  // d of a function along an edge; on a straight one it is linear.
  using AlongCurve = std::function<Eigen::Vector2d(const Eigen::Vector2d& x)>;
  Eigen::Matrix2Xd traces_on(int row, const AlongCurve& u) const;

  // As prescribed_displacement(), Problem::frame_at() and offset_coefficients(), of traces.
  PrescribedDisplacement prescribed() const;
  EdgeFrame frame(int row, int i) const {
    return side_of(row) ? problem_.frame_on_curve(row, i, degree_)
                        : problem_.frame_at(row, i, degree_);
  }
  template <int p>
  std::array<ContactOffset, p + 1> offsets(int row) const {
    std::array<ContactOffset, p + 1> offsets = offset_coefficients<p>(problem_, row);
    if (side_of(row)) {
      const int start = problem_.mesh.boundary[row].vertices[0];
      const Eigen::Matrix2Xd motion =
          traces_on(row, [&](const Eigen::Vector2d& x) { return problem_.motion_at(x, start); });
      for (int i = 0; i <= p; ++i) offsets[i].motion_mm = motion.col(i);
    }
    return offsets;
  }

  // ∫ (σ − A ε):C:(σ − A ε) of the admissible displacement, N mm, in a triangle with such sides.
  // stress: σ − A ε(w), by thirds.
  double squared_distance(int triangle, const StressCoefficients& stress,
                          const DisplacementTriangle::Displacement& w) const;

 private:
  struct Side {
    std::vector<Eigen::Vector2d> at;                       // x at the points
    std::vector<Eigen::Matrix2d> frames, of_coefficients;  // R(ξ) at the points, R_i
  };
  DisplacementField mapped(const DisplacementField& field, Eigen::MatrixXd Map::*map) const;
  const Side* side_of(int row) const;
  Eigen::Matrix2Xd interpolant(const Side& side, const AlongCurve& u) const;  // d_i

  const Problem& problem_;
  int degree_;
  Eigen::MatrixXd to_bernstein_;  // coefficients of the polynomial with these values
  std::map<int, Side> sides_;     // per row
  std::map<int, Map> maps_;       // per triangle
};

}  // namespace airybench
