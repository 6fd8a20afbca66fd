// A displacement of degree p = k + 1 on one triangle, in Bernstein form, and its strain of degree
// k.
//
//   u = Σ_α u_α B_α,    ∂u/∂ξ_a = p Σ_β (u_{β+e_a} − u_{β+e_0}) B_β,    |α| = p,  |β| = k
//
// ξ_1, ξ_2 are the coordinates along V1V2 and V1V3: x = V1 + B ξ, and their gradients are the
// columns of B⁻ᵀ. Places ("nodes") of α: V1 V2 V3, then p − 1 on each of the edges V1V2, V2V3, V3V1
// as walked, then the inner ones; those of β are ring_place()'s of the whole triangle.
//
// The degree is known when the program runs: code that works on fields is compiled once. Small
// matrices have room for the highest degree and take no heap.
#pragma once

#include <Eigen/Core>
#include <array>
#include <boost/container/static_vector.hpp>
#include <vector>

#include "assembly/elements/bernstein.hpp"
#include "assembly/elements/equilibrium_element.hpp"

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

class DisplacementTriangle {
 public:
  static const DisplacementTriangle& of_degree(int p);  // made at the first call

  static constexpr int max_degree = highest_stress_degree + 1;
  static constexpr int max_nodes = bernstein_count(max_degree),
                       max_strains = bernstein_count(max_degree - 1);
  using Nodes = boost::container::static_vector<int, max_nodes>;
  using Displacement =  // coefficients, mm
      Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::ColMajor, 2, max_nodes>;
  using Strain =  // coefficients; rows: xx, yy, 2xy
      Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, max_strains>;
  using StrainByThirds =  // the same of the three thirds
      Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 3 * max_strains>;
  using Stiffness = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                                  2 * max_nodes, 2 * max_nodes>;
  using Vector =  // x and y of the nodes
      Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 2 * max_nodes, 1>;
  using DisplacementRef = Eigen::Ref<const Eigen::Matrix2Xd>;
  using StressRef = Eigen::Ref<const Eigen::Matrix3Xd>;

  int degree, nodes, outer, inner, strains;   // outer: nodes on edges
  std::vector<std::array<int, 3>> exponents;  // α of every node
  // The nodes β + e_0, β + e_1, β + e_2.
  std::vector<std::array<int, 3>> node;

  using Products = std::array<Eigen::MatrixXd, 3>;

  Eigen::MatrixXd mass;          // ∫ B_β B_γ, per area
  Eigen::MatrixXd on_thirds;     // times it: coefficients by thirds
  Products products;             // ∫ ∂_a B ∂_b B', per area: 11, 22, 12
  Eigen::MatrixXd edge_moments;  // moment j, of degree k, of coefficient i on an edge

  // The nodes of edge e, V_e V_(e+1), as walked.
  int on_edge(int e, int i) const {
    return i == 0 ? e : i == degree ? (e + 1) % 3 : 3 + e * (degree - 1) + i - 1;
  }
  Strain strain(const Eigen::Matrix2d& gradients, const DisplacementRef& u) const;
  // Its transpose: forces on the nodes, from rows xx, yy, xy.
  Displacement forces(const Eigen::Matrix2d& gradients, const StressRef& dual) const;
  // B_α of the nodes at V1 + from_first, beyond the triangle, too.
  Eigen::VectorXd values(const TriangleShape& shape, const Eigen::Vector2d& from_first) const;
  // `products` of another domain, from its `mass`.
  Products products_of(const Eigen::MatrixXd& mass_of_domain) const;
  // K, N/mm: ∫ ε(B):A:ε(B'), 1 mm thick; rows and columns of `count` nodes from `first` on.
  Stiffness stiffness(const TriangleShape& shape, const Eigen::Matrix3d& elasticity, int first,
                      int count) const {
    return stiffness(shape, elasticity, products, first, count);
  }
  Stiffness stiffness(const TriangleShape& shape, const Eigen::Matrix3d& elasticity) const {
    return stiffness(shape, elasticity, 0, nodes);
  }
  Stiffness stiffness(const TriangleShape& shape, const Eigen::Matrix3d& elasticity,
                      const Products& of_domain) const {
    return stiffness(shape, elasticity, of_domain, 0, nodes);
  }

 private:
  explicit DisplacementTriangle(int p);
  Stiffness stiffness(const TriangleShape& shape, const Eigen::Matrix3d& elasticity,
                      const Products& of_domain, int first, int count) const;
};

}  // namespace airybench
