// Displacements that are polynomials with random coefficients, in Bernstein form and with their
// strains.
#pragma once

#include <Eigen/LU>
#include <cmath>
#include <utility>

#include "assembly/displacement_field.hpp"
#include "tests/support/dice.hpp"

namespace airybench::testing {

// u = Σ c_ij (x/size)^i (y/size)^j, i + j ≤ degree; with `held` times x, so that u = 0 on x = 0.
class Polynomial {
 public:
  Polynomial(int degree, double size_mm, std::uint32_t seed, bool held = false)
      : degree_(degree), first_(held ? 1 : 0), size_mm_(size_mm), dice_(seed) {
    for (int i = first_; i <= degree; ++i)
      for (int j = 0; j <= degree - i; ++j)
        terms_.push_back({i, j, {dice_.between(-1, 1), dice_.between(-1, 1)}});
  }
  int degree() const { return degree_; }
  Eigen::Vector2d operator()(const Eigen::Vector2d& x) const {
    Eigen::Vector2d u = Eigen::Vector2d::Zero();
    for (const Term& term : terms_) u += power(x.x(), term.i) * power(x.y(), term.j) * term.c;
    return u;
  }
  Eigen::Vector3d strain(const Eigen::Vector2d& x) const {  // xx, yy, 2xy
    Eigen::Vector3d strain = Eigen::Vector3d::Zero();
    for (const auto& [i, j, c] : terms_) {
      const double along_x = i * power(x.x(), i - 1) * power(x.y(), j) / size_mm_,
                   along_y = j * power(x.x(), i) * power(x.y(), j - 1) / size_mm_;
      strain +=
          Eigen::Vector3d(c.x() * along_x, c.y() * along_y, c.x() * along_y + c.y() * along_x);
    }
    return strain;
  }

 private:
  struct Term {
    int i, j;
    Eigen::Vector2d c;
  };
  double power(double x, int n) const { return n < 0 ? 0 : std::pow(x / size_mm_, n); }

  int degree_, first_;
  double size_mm_;
  Dice dice_;
  std::vector<Term> terms_;
};

// The field of degree p with the values of u at its nodes' places: u itself, up to this degree.
template <typename Function>
DisplacementField interpolated(const Problem& problem, int p, const Function& u) {
  const auto& triangle = DisplacementTriangle::of_degree(p);
  Eigen::MatrixXd basis(triangle.nodes, triangle.nodes);  // B_m at the place of node n
  const auto place = [&](int node) -> Eigen::Vector3d {
    const auto& [a, b, c] = triangle.exponents[node];
    return Eigen::Vector3d(a, b, c) / p;
  };
  for (int m = 0; m < triangle.nodes; ++m)
    for (int n = 0; n < triangle.nodes; ++n) {
      const auto& [a, b, c] = triangle.exponents[m];
      const Eigen::Vector3d x = place(n);
      basis(m, n) = binomial(p, a) * binomial(p - a, b) * std::pow(x(0), a) * std::pow(x(1), b) *
                    std::pow(x(2), c);
    }
  const Eigen::MatrixXd to_coefficients = basis.inverse();
  DisplacementField field = DisplacementField::Zero(2, displacement_nodes(problem, p));
  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t) {
    Eigen::Matrix2Xd values(2, triangle.nodes);
    for (int n = 0; n < triangle.nodes; ++n)
      values.col(n) = u(Eigen::Vector2d(problem.vertices_of(t) * place(n)));
    const Eigen::Matrix2Xd own = values * to_coefficients;
    const auto nodes = triangle_nodes(problem, p, t);
    for (int m = 0; m < triangle.nodes; ++m) field.col(nodes[m]) = own.col(m);
  }
  return field;
}

}  // namespace airybench::testing
