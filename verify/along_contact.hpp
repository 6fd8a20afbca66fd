// Polynomials along an edge of Γ_C, by their Bernstein coefficients from the start of its walk on.
#pragma once

#include <Eigen/LU>
#include <array>
#include <limits>

#include "assembly/curved_traces.hpp"
#include "assembly/displacement_field.hpp"
#include "assembly/elements/bernstein.hpp"

namespace airybench {

using AlongEdge =
    Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, highest_stress_degree + 2>;

// s: from 0 to 1 along an edge of the boundary, which follows its curve for stresses of this
// degree.
inline Eigen::Vector2d point_on_edge(const Problem& problem, int row, int degree, double s) {
  const BoundaryEdge& edge = problem.mesh.boundary[row];
  if (problem.follows_curve(row, degree)) return edge.curve.at(s);
  const auto [start, end] = edge.vertices;
  return (1 - s) * problem.mesh.vertices[start] + s * problem.mesh.vertices[end];
}

// The outward normal there.
inline Eigen::Vector2d normal_on_edge(const Problem& problem, int row, int degree, double s) {
  const BoundaryEdge& edge = problem.mesh.boundary[row];
  if (problem.follows_curve(row, degree)) return edge.curve.normal(s);
  const auto [start, end] = edge.vertices;
  return edge_frame(problem.mesh.vertices[start], problem.mesh.vertices[end]).normal;
}

// Of the pressure, MPa, from the normal components of F_j, N. On a curve, where it is (k + 1) Σ B_j
// F_j/|x′|, of its interpolant at ξ = j/k.
inline AlongEdge pressure_along(const Problem& problem, int row, const AlongEdge& normal_forces) {
  const int k = static_cast<int>(normal_forces.size()) - 1;
  const AlongEdge densities = -(k + 1) * normal_forces;
  if (!problem.follows_curve(row, k)) return densities / problem.frame_at(row, 0, 1).length_mm;
  Eigen::MatrixXd values(k + 1, k + 1);
  Eigen::VectorXd pressure(k + 1);
  for (int q = 0; q <= k; ++q) {
    const double xi = static_cast<double>(q) / k;
    for (int j = 0; j <= k; ++j) values(q, j) = bernstein_polynomial(k, j, xi);
    pressure(q) =
        values.row(q).dot(densities) / problem.mesh.boundary[row].curve.derivative(xi).norm();
  }
  return values.partialPivLu().solve(pressure).transpose();
}

struct LargestValue {
  double value = -std::numeric_limits<double>::infinity();
  double s = 0;  // where: from 0 to 1
};

// Of the edge and of what is known already. The values of a part lie below its largest coefficient,
// and the error of that falls with the square of its length.
inline LargestValue largest_value(const AlongEdge& c, LargestValue known = {}, double start = 0,
                                  double length = 1) {
  constexpr double rounding = 1e-12, shortest = 1e-6;
  const auto consider = [&](double value, double s) {
    if (value > known.value) known = {value, s};
  };
  consider(c(0), start);
  consider(c(c.size() - 1), start + length);
  if (length < shortest || !(c.maxCoeff() > known.value + rounding * c.cwiseAbs().maxCoeff()))
    return known;  // or NaN
  const auto [left, right] = halved(c);
  known = largest_value(left, known, start, length / 2);
  return largest_value(right, known, start + length / 2, length / 2);
}

// Of w of degree p, given by its traces, between bodies of both; mm.
template <int p>
struct ContactMotion {
  std::array<double, p + 1> beyond;  // u_n − g0
  std::array<double, p + 1> slip;    // u_t, less that of earlier load steps
};
template <int p>
ContactMotion<p> contact_motion(const Problem& problem, const CurvedTraces& traces, int row,
                                const DisplacementField& w) {
  const std::array<int, p + 1> nodes = boundary_nodes<p>(problem, row);
  const std::array<ContactOffset, p + 1> offset = traces.offsets<p>(row);
  ContactMotion<p> motion;
  for (int i = 0; i <= p; ++i) {
    const EdgeFrame frame = traces.frame(row, i);
    motion.beyond[i] = frame.normal.dot(w.col(nodes[i])) - offset[i].along(frame.normal).x();
    motion.slip[i] = frame.tangent.dot(w.col(nodes[i]) + offset[i].motion_mm) - offset[i].slid_mm;
  }
  const int other = problem.opposite_of(row);
  if (other == Problem::no_row) return motion;
  const std::array<int, p + 1> across = boundary_nodes<p>(problem, other);
  const std::array<ContactOffset, p + 1> beyond = traces.offsets<p>(other);
  for (int i = 0; i <= p; ++i) {
    const EdgeFrame frame = traces.frame(other, p - i);
    const Eigen::Vector2d of_other = w.col(across[p - i]);
    motion.beyond[i] += frame.normal.dot(of_other) - beyond[p - i].along(frame.normal).x();
    motion.slip[i] += frame.tangent.dot(of_other + beyond[p - i].motion_mm) - beyond[p - i].slid_mm;
  }
  return motion;
}

}  // namespace airybench
