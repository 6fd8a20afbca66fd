#include "assembly/elements/displacement_triangle.hpp"

#include "assembly/elements/bernstein.hpp"

namespace airybench {
namespace {

// Coefficients of one polynomial of degree k on the third t, by de Casteljau's steps to the
// centroid: ring c of the third has those after c steps, on its edge V_t V_(t+1).
Eigen::RowVectorXd on_third(int k, int t, Eigen::RowVectorXd c) {
  Eigen::RowVectorXd result(c.size());
  const auto place = [](int d, std::array<int, 3> alpha) {
    return ring_place(d, alpha[1], alpha[2]);
  };
  for (int ring = 0; ring <= k; ++ring) {
    const int d = k - ring;
    for (int b = 0; b <= d; ++b) {
      std::array<int, 3> alpha = {0, 0, 0};
      alpha[t] = d - b;
      alpha[(t + 1) % 3] = b;
      result(ring_place(k, b, ring)) = c(place(d, alpha));
    }
    Eigen::RowVectorXd next = c;
    for (int second = 0; second < d; ++second)
      for (int first = 0; first < d - second; ++first)
        next(ring_place(d - 1, first, second)) =
            (c(ring_place(d, first, second)) + c(ring_place(d, first + 1, second)) +
             c(ring_place(d, first, second + 1))) /
            3;
    c = next;
  }
  return result;
}

}  // namespace

DisplacementTriangle::DisplacementTriangle(int p)
    : degree(p),
      nodes(bernstein_count(p)),
      outer(3 * p),
      inner(nodes - outer),
      strains(bernstein_count(p - 1)),
      exponents(static_cast<std::size_t>(nodes)),
      node(static_cast<std::size_t>(strains)) {
  for (int c = 0; c <= p; ++c)
    for (int b = 0; b <= p - c; ++b)
      exponents[displacement_place(p, p - b - c, b, c)] = {p - b - c, b, c};
  for (int c = 0; c < p; ++c)
    for (int b = 0; b < p - c; ++b) {
      const int a = p - 1 - b - c;
      node[ring_place(p - 1, b, c)] = {displacement_place(p, a + 1, b, c),
                                       displacement_place(p, a, b + 1, c),
                                       displacement_place(p, a, b, c + 1)};
    }
  mass = bernstein_mass<double>(p - 1, 1);
  on_thirds.resize(strains, 3 * strains);
  for (int s = 0; s < strains; ++s)
    for (int t = 0; t < 3; ++t)
      on_thirds.row(s).segment(strains * t, strains) =
          on_third(p - 1, t, Eigen::RowVectorXd::Unit(strains, s));
  products = products_of(mass);
  edge_moments.resize(p, p + 1);
  for (int j = 0; j < p; ++j)
    for (int i = 0; i <= p; ++i) edge_moments(j, i) = edge_moment(p - 1, j, p, i);
}

const DisplacementTriangle& DisplacementTriangle::of_degree(int p) {
  return made_once(p - 1, [](int k) { return DisplacementTriangle(k + 1); });
}

Eigen::VectorXd DisplacementTriangle::values(const TriangleShape& shape,
                                             const Eigen::Vector2d& from_first) const {
  const Eigen::Vector2d xi = shape.gradients.transpose().lazyProduct(from_first);
  const Eigen::VectorXd by_rings =
      bernstein_values<double>(degree, {1 - xi.x() - xi.y(), xi.x(), xi.y()});
  Eigen::VectorXd values(nodes);
  for (int m = 0; m < nodes; ++m)
    values(m) = by_rings(ring_place(degree, exponents[m][1], exponents[m][2]));
  return values;
}

DisplacementTriangle::Products DisplacementTriangle::products_of(
    const Eigen::MatrixXd& mass_of_domain) const {
  Eigen::MatrixXd derivative[2];
  for (int a = 0; a < 2; ++a) {
    derivative[a].setZero(strains, nodes);
    for (int s = 0; s < strains; ++s) {
      derivative[a](s, node[s][a + 1]) = degree;
      derivative[a](s, node[s][0]) = -degree;
    }
  }
  constexpr int pairs[3][2] = {{0, 0}, {1, 1}, {0, 1}};
  Products result;
  for (int i = 0; i < 3; ++i)
    result[i] = derivative[pairs[i][0]].transpose().lazyProduct(
        mass_of_domain.lazyProduct(derivative[pairs[i][1]]).eval());
  return result;
}

DisplacementTriangle::Strain DisplacementTriangle::strain(const Eigen::Matrix2d& gradients,
                                                          const DisplacementRef& u) const {
  const int p = degree;
  Strain e(3, strains);
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

DisplacementTriangle::Displacement DisplacementTriangle::forces(const Eigen::Matrix2d& gradients,
                                                                const StressRef& dual) const {
  Displacement f = Displacement::Zero(2, nodes);
  for (int s = 0; s < strains; ++s)
    for (int a = 0; a < 2; ++a) {
      const double x = degree * gradients(0, a), y = degree * gradients(1, a);
      const Eigen::Vector2d force(dual(0, s) * x + dual(2, s) * y, dual(1, s) * y + dual(2, s) * x);
      f.col(node[s][a + 1]) += force;
      f.col(node[s][0]) -= force;
    }
  return f;
}

DisplacementTriangle::Stiffness DisplacementTriangle::stiffness(const TriangleShape& shape,
                                                                const Eigen::Matrix3d& elasticity,
                                                                const Products& of_domain,
                                                                int first, int count) const {
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
  const auto& [D11, D22, D12] = of_domain;
  Stiffness K(2 * count, 2 * count);
  for (int j = 0; j < count; ++j)
    for (int i = 0; i < count; ++i) {
      const int m = first + i, n = first + j;
      for (int b = 0; b < 2; ++b)
        for (int a = 0; a < 2; ++a)
          K(2 * i + a, 2 * j + b) = D11(m, n) * first_first(a, b) +
                                    D22(m, n) * second_second(a, b) +
                                    D12(m, n) * first_second(a, b) + D12(n, m) * first_second(b, a);
    }
  return K;
}

}  // namespace airybench
