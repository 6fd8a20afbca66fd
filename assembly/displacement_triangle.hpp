// A displacement of degree p = k + 1 on one triangle, in Bernstein form, and its strain of degree
// k.
//
//   u = Σ_α u_α B_α,    ∂u/∂ξ_a = p Σ_β (u_{β+e_a} − u_{β+e_0}) B_β,    |α| = p,  |β| = k
//
// ξ_1, ξ_2 are the coordinates along V1V2 and V1V3: x = V1 + B ξ, and their gradients are the
// columns of B⁻ᵀ. Places ("nodes") of α: V1 V2 V3, then p − 1 on each of the edges V1V2, V2V3, V3V1
// as walked, then the inner ones; those of β are ring_place()'s of the whole triangle.
//
// Templates are instantiated for the degrees of AIRYBENCH_STRESS_DEGREES.
#pragma once

#include <Eigen/Core>
#include <array>

#include "assembly/bernstein.hpp"
#include "assembly/equilibrium_element.hpp"

namespace airybench {

constexpr int displacement_place(int p, int a, int b, int c) {
  if (c == 0) return b == 0 ? 0 : b == p ? 1 : 2 + b;
  if (a == 0) return c == p ? 2 : p + 1 + c;
  if (b == 0) return 2 * p + a;
  return 3 * p + ring_place(p - 3, b - 1, c - 1);
}

struct TriangleShape {
  explicit TriangleShape(const TriangleVertices& v) {
    B << v.col(1) - v.col(0), v.col(2) - v.col(0);
    const double determinant = B(0, 0) * B(1, 1) - B(0, 1) * B(1, 0);
    gradients << B(1, 1), -B(1, 0), -B(0, 1), B(0, 0);
    gradients /= determinant;
    area_mm2 = determinant / 2;
  }
  Eigen::Matrix2d B, gradients;  // columns: V2 − V1, V3 − V1; ∇ξ_1, ∇ξ_2
  double area_mm2;
};

template <int p>
struct DisplacementTriangle {
  static constexpr int nodes = (p + 1) * (p + 2) / 2;
  static constexpr int outer = 3 * p, inner = nodes - outer;
  static constexpr int strains = p * (p + 1) / 2;
  using Displacement = Eigen::Matrix<double, 2, nodes>;  // coefficients, mm
  using Strain = Eigen::Matrix<double, 3, strains>;      // coefficients; rows: xx, yy, 2xy

  // α of every node.
  static constexpr std::array<std::array<int, 3>, nodes> exponents = [] {
    std::array<std::array<int, 3>, nodes> alpha{};
    for (int c = 0; c <= p; ++c)
      for (int b = 0; b <= p - c; ++b)
        alpha[displacement_place(p, p - b - c, b, c)] = {p - b - c, b, c};
    return alpha;
  }();
  // The nodes of edge e, V_e V_(e+1), as walked.
  static constexpr int on_edge(int e, int i) {
    return i == 0 ? e : i == p ? (e + 1) % 3 : 3 + e * (p - 1) + i - 1;
  }
  // The nodes β + e_0, β + e_1, β + e_2.
  static constexpr std::array<std::array<int, 3>, strains> node = [] {
    std::array<std::array<int, 3>, strains> above{};
    for (int c = 0; c < p; ++c)
      for (int b = 0; b < p - c; ++b) {
        const int a = p - 1 - b - c;
        above[ring_place(p - 1, b, c)] = {displacement_place(p, a + 1, b, c),
                                          displacement_place(p, a, b + 1, c),
                                          displacement_place(p, a, b, c + 1)};
      }
    return above;
  }();

  static Strain strain(const Eigen::Matrix2d& gradients, const Displacement& u) {
    Strain e;
    for (int s = 0; s < strains; ++s) {
      const Eigen::Vector2d first = u.col(node[s][1]) - u.col(node[s][0]),
                            second = u.col(node[s][2]) - u.col(node[s][0]);
      const double xx = first.x() * gradients(0, 0) + second.x() * gradients(0, 1),
                   xy = first.x() * gradients(1, 0) + second.x() * gradients(1, 1),
                   yx = first.y() * gradients(0, 0) + second.y() * gradients(0, 1),
                   yy = first.y() * gradients(1, 0) + second.y() * gradients(1, 1);
      e.col(s) << p * xx, p * yy, p * (xy + yx);
    }
    return e;
  }

  // Its transpose: forces on the nodes, from rows xx, yy, xy.
  static Displacement forces(const Eigen::Matrix2d& gradients, const Strain& dual) {
    Displacement f = Displacement::Zero();
    for (int s = 0; s < strains; ++s)
      for (int a = 0; a < 2; ++a) {
        const double x = p * gradients(0, a), y = p * gradients(1, a);
        const Eigen::Vector2d force(dual(0, s) * x + dual(2, s) * y,
                                    dual(1, s) * y + dual(2, s) * x);
        f.col(node[s][a + 1]) += force;
        f.col(node[s][0]) -= force;
      }
    return f;
  }

  // Rows and columns of K, N/mm, of `count` nodes from `first` on: ∫ ε(B):A:ε(B'), 1 mm thick.
  template <int first = 0, int count = nodes>
  static Eigen::Matrix<double, 2 * count, 2 * count> stiffness(const TriangleShape& shape,
                                                               const Eigen::Matrix3d& elasticity) {
    std::array<Eigen::Matrix<double, 3, 2>, 2> strain_of;  // of a displacement along x, y
    for (int a = 0; a < 2; ++a) {
      const double x = shape.gradients(0, a), y = shape.gradients(1, a);
      strain_of[a] << x, 0, 0, y, y, x;
    }
    const auto product = [&](int a, int b) -> Eigen::Matrix2d {
      return shape.area_mm2 *
             strain_of[a].transpose().lazyProduct(elasticity.lazyProduct(strain_of[b]).eval());
    };
    const Eigen::Matrix2d first_first = product(0, 0), second_second = product(1, 1),
                          first_second = product(0, 1);
    const auto& D = constants().stiffness;
    Eigen::Matrix<double, 2 * count, 2 * count> K;
    for (int j = 0; j < count; ++j)
      for (int i = 0; i < count; ++i)
        K.template block<2, 2>(2 * i, 2 * j) =
            D[0](first + i, first + j) * first_first + D[1](first + i, first + j) * second_second +
            D[2](first + i, first + j) * first_second +
            D[2](first + j, first + i) * first_second.transpose();
    return K;
  }

  struct Constants {
    Eigen::Matrix<double, strains, strains> mass;           // ∫ B_β B_γ, per area
    Eigen::Matrix<double, strains, 3 * strains> on_thirds;  // times it: coefficients by thirds
    std::array<Eigen::Matrix<double, nodes, nodes>, 3> stiffness;  // ∫ ∂_a B ∂_b B', per area: 11,
                                                                   // 22, 12
  };
  static const Constants& constants();
};

}  // namespace airybench
