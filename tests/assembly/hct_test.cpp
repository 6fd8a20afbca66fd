// The element by its mathematical properties: cubics reproduced, C¹ everywhere, divergence-free
// stress, the right kernel.
#include "assembly/elements/hct.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

#include "assembly/elements/elasticity.hpp"
#include "assembly/hct_action.hpp"
#include "mesh/mesh.hpp"
#include "support/wide.hpp"
#include "tests/support/dense_algebra.hpp"

namespace airybench::hct_test {
namespace {

using Dofs = Eigen::Matrix<double, 12, 1>;

struct Shape {
  TriangleVertices v;
  double tolerance;  // relative; shapes lose digits by their flatness and their place
};

Shape shape(double ax, double ay, double bx, double by, double cx, double cy, double tolerance) {
  Shape s;
  s.v << ax, bx, cx, ay, by, cy;
  s.tolerance = tolerance;
  return s;
}

const std::vector<Shape>& shapes() {
  static const std::vector<Shape> list = {
      shape(0, 0, 1, 0, 0, 1, 1e-12), shape(0.3, -0.2, 2.1, 0.4, 0.7, 1.9, 1e-12),
      shape(10, 50, 10.05, 50.01, 10.01, 50.06, 1e-10),  // small and far from the origin
      shape(0, 0, 10, 0, 3, 0.5, 1e-10),                 // flat
  };
  return list;
}

// A function with gradient.
struct Field {
  std::function<double(Eigen::Vector2d)> value;
  std::function<Eigen::Vector2d(Eigen::Vector2d)> gradient;
  std::function<Eigen::Matrix2d(Eigen::Vector2d)> hessian;
};

// ((x−x0)/h)^a ((y−y0)/h)^b, scaled to the triangle so that all values are of order one.
Field monomial(int a, int b, const Eigen::Vector2d& x0, double h) {
  const auto power = [](double x, int n) { return n < 0 ? 0.0 : std::pow(x, n); };
  return {[=](Eigen::Vector2d x) {
            x = (x - x0) / h;
            return power(x.x(), a) * power(x.y(), b);
          },
          [=](Eigen::Vector2d x) -> Eigen::Vector2d {
            x = (x - x0) / h;
            return Eigen::Vector2d(a * power(x.x(), a - 1) * power(x.y(), b),
                                   b * power(x.x(), a) * power(x.y(), b - 1)) /
                   h;
          },
          [=](Eigen::Vector2d x) {
            x = (x - x0) / h;
            Eigen::Matrix2d m;
            m(0, 0) = a * (a - 1) * power(x.x(), a - 2) * power(x.y(), b);
            m(1, 1) = b * (b - 1) * power(x.x(), a) * power(x.y(), b - 2);
            m(0, 1) = m(1, 0) = a * b * power(x.x(), a - 1) * power(x.y(), b - 1);
            return Eigen::Matrix2d(m / (h * h));
          }};
}

Dofs interpolate(const TriangleVertices& v, const EdgeSigns& outward, const Field& field) {
  Dofs dofs;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector2d edge = v.col((k + 1) % 3) - v.col(k);
    const Eigen::Vector2d normal = Eigen::Vector2d(edge.y(), -edge.x()).normalized();
    dofs(3 * k) = field.value(v.col(k));
    dofs.segment<2>(3 * k + 1) = field.gradient(v.col(k));
    dofs(9 + k) = outward[k] * normal.dot(field.gradient(v.col(k) + edge / 2));
  }
  return dofs;
}

// Value and gradient of the element's function on third t at barycentric point λ of the third.
std::pair<double, Eigen::Vector2d> evaluate(const TriangleVertices& v, const EdgeSigns& outward,
                                            const Dofs& dofs, int t,
                                            const Eigen::Vector3d& lambda) {
  constexpr int exponents[10][3] = {{3, 0, 0}, {0, 3, 0}, {0, 0, 3}, {2, 1, 0}, {1, 2, 0},
                                    {2, 0, 1}, {0, 2, 1}, {1, 1, 1}, {1, 0, 2}, {0, 1, 2}};
  constexpr double factorial[4] = {1, 1, 2, 6};
  Eigen::Matrix<double, 2, 3> corner;
  corner << v.col(t), v.col((t + 1) % 3), v.rowwise().mean();
  Eigen::Matrix3d barycentric;
  barycentric << corner, 1, 1, 1;
  const Eigen::Matrix<double, 3, 2> slope = barycentric.inverse().leftCols<2>();

  const Eigen::Matrix<double, 19, 1> c = hct_coefficients(v, outward) * dofs;
  const std::array<int, 10> third = hct_third(t);
  double value = 0;
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  for (int k = 0; k < 10; ++k) {
    const auto& e = exponents[k];
    const double weight = 6 / (factorial[e[0]] * factorial[e[1]] * factorial[e[2]]) * c(third[k]);
    double product = weight;
    for (int i = 0; i < 3; ++i) product *= std::pow(lambda(i), e[i]);
    value += product;
    for (int i = 0; i < 3; ++i) {
      if (e[i] == 0) continue;
      double derivative = weight * e[i] * std::pow(lambda(i), e[i] - 1);
      for (int j = 0; j < 3; ++j)
        if (j != i) derivative *= std::pow(lambda(j), e[j]);
      gradient += derivative * slope.row(i).transpose();
    }
  }
  return {value, gradient};
}

Eigen::Vector2d point(const TriangleVertices& v, int t, const Eigen::Vector3d& lambda) {
  return lambda(0) * v.col(t) + lambda(1) * v.col((t + 1) % 3) +
         lambda(2) * Eigen::Vector2d(v.rowwise().mean());
}

double size_of(const TriangleVertices& v) { return (v.col(1) - v.col(0)).norm(); }

TEST(Hct, ReproducesEveryCubicWithItsGradientAndStress) {
  for (const auto& [v, tolerance] : shapes()) {
    for (const EdgeSigns& outward : {EdgeSigns{1, 1, 1}, EdgeSigns{-1, 1, -1}}) {
      const double h = size_of(v);
      for (int a = 0; a <= 3; ++a) {
        for (int b = 0; a + b <= 3; ++b) {
          const Field field = monomial(a, b, v.col(0), h);
          const Dofs dofs = interpolate(v, outward, field);
          const Eigen::Matrix<double, 27, 1> stress = hct_stress(v, outward) * dofs;
          const double hessian_size = 6 / (h * h) * std::max(1.0, dofs.norm());
          for (int t = 0; t < 3; ++t) {
            for (const Eigen::Vector3d& lambda :
                 {Eigen::Vector3d(0.2, 0.3, 0.5), Eigen::Vector3d(0.7, 0.1, 0.2)}) {
              const auto [value, gradient] = evaluate(v, outward, dofs, t, lambda);
              const Eigen::Vector2d x = point(v, t, lambda);
              EXPECT_NEAR(value, field.value(x), tolerance) << a << b;
              EXPECT_LT((gradient - field.gradient(x)).norm() * h, tolerance) << a << b;
            }
            for (int m = 0; m < 3; ++m) {
              const Eigen::Matrix2d hessian = field.hessian(point(v, t, Eigen::Vector3d::Unit(m)));
              const auto s = stress.segment<3>(3 * (3 * t + m));
              const Eigen::Vector3d expected(hessian(1, 1), hessian(0, 0), -hessian(0, 1));
              EXPECT_LT((s - expected).norm() / hessian_size, tolerance) << a << b;
            }
          }
        }
      }
    }
  }
}

Dofs random_dofs(std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Dofs dofs;
  for (double& value : dofs) value = uniform(generator);
  return dofs;
}

TEST(Hct, IsC1AcrossItsThirds) {
  std::mt19937 generator(1);
  const TriangleVertices& v = shapes()[1].v;
  const EdgeSigns outward = {1, -1, 1};
  const Dofs dofs = random_dofs(generator);
  for (int t = 0; t < 3; ++t) {  // third t ends where third t+1 begins: on the line V_{t+1} V4
    for (const double s : {0.0, 0.25, 0.6, 1.0}) {
      const auto here = evaluate(v, outward, dofs, t, {0, 1 - s, s});
      const auto there = evaluate(v, outward, dofs, (t + 1) % 3, {1 - s, 0, s});
      EXPECT_NEAR(here.first, there.first, 1e-13);
      EXPECT_LT((here.second - there.second).norm(), 1e-12);
    }
  }
}

TEST(Hct, IsC1AcrossAnEdgeThatTwoElementsShare) {
  std::mt19937 generator(2);
  // Edge 0 of the left element, walked forward, is edge 1 of the right one, walked backward.
  const Eigen::Vector2d a(0.1, 0), b(0.4, 1.3), c(-1, 0.8), d(1.7, 0.2);
  TriangleVertices left, right;
  left << a, b, c;
  right << d, b, a;
  const EdgeSigns outward_left = {1, 1, 1}, outward_right = {1, -1, 1};
  Dofs on_left = random_dofs(generator), on_right = random_dofs(generator);
  on_right.segment<3>(6) = on_left.segment<3>(0);
  on_right.segment<3>(3) = on_left.segment<3>(3);
  on_right(10) = on_left(9);
  for (const double s : {0.0, 0.1, 0.5, 0.77, 1.0}) {
    const auto here = evaluate(left, outward_left, on_left, 0, {1 - s, s, 0});
    const auto there = evaluate(right, outward_right, on_right, 1, {s, 1 - s, 0});
    EXPECT_NEAR(here.first, there.first, 1e-13);
    EXPECT_LT((here.second - there.second).norm(), 1e-12);
  }
}

TEST(Hct, StressIsDivergenceFreeInsideThirds) {
  std::mt19937 generator(3);
  for (const auto& [v, tolerance] : shapes()) {
    const Eigen::Matrix<double, 27, 1> stress = hct_stress(v, {1, 1, 1}) * random_dofs(generator);
    for (int t = 0; t < 3; ++t) {
      Eigen::Matrix3d barycentric;
      barycentric << v.col(t), v.col((t + 1) % 3), v.rowwise().mean(), 1, 1, 1;
      const Eigen::Matrix<double, 3, 2> slope = barycentric.inverse().leftCols<2>();
      const Eigen::Matrix3d s = stress.segment<9>(9 * t).reshaped(3, 3);  // columns: corners
      const Eigen::Matrix<double, 3, 2> gradient = s * slope;
      const double size = gradient.cwiseAbs().maxCoeff();
      EXPECT_LT(std::abs(gradient(0, 0) + gradient(2, 1)), tolerance * size);
      EXPECT_LT(std::abs(gradient(2, 0) + gradient(1, 1)), tolerance * size);
    }
  }
}

template <typename Scalar>
void expect_action_of_matrix(const Shape& shape, double rounding) {
  const EdgeSigns outward = {-1, 1, 1};
  const HctStressIn<Scalar> matrix = hct_stress<Scalar>(shape.v, outward);
  const HctAction<Scalar> action(shape.v, outward);
  const Scalar size = matrix.norm();
  for (int j = 0; j < 12; ++j)
    EXPECT_LT(
        (action.stress(Eigen::Matrix<Scalar, 12, 1>::Unit(j)).reshaped() - matrix.col(j)).norm(),
        rounding * size)
        << j;
  for (int i = 0; i < 27; ++i) {
    ElementStressIn<Scalar> one = ElementStressIn<Scalar>::Zero();
    one.reshaped()(i) = 1;
    EXPECT_LT((action.transposed(one) - matrix.row(i).transpose()).norm(), rounding * size) << i;
  }
}

TEST(Hct, ActionIsTheProductWithTheMatrixAndWithItsTranspose) {
  for (const Shape& shape : shapes()) {
    expect_action_of_matrix<double>(shape, 1e-14);
    expect_action_of_matrix<Wide>(shape, 1e-17);
  }
}

TEST(Hct, FlexibilityIsTheEnergyOfAPolynomialStress) {
  // φ = y³/6 + x² y/2: σ = (y, y, −x). ∫ over a triangle of a quadratic: its mean at the edge
  // middles times the area.
  const TriangleVertices& v = shapes()[1].v;
  const EdgeSigns outward = {1, 1, -1};
  const Field field = {
      [](Eigen::Vector2d x) { return std::pow(x.y(), 3) / 6 + x.x() * x.x() * x.y() / 2; },
      [](Eigen::Vector2d x) {
        return Eigen::Vector2d(x.x() * x.y(), x.y() * x.y() / 2 + x.x() * x.x() / 2);
      },
      {}};
  const Eigen::Matrix3d c = compliance({200, 0.3}, Plane::stress);
  const double area = cross_area(v.col(0), v.col(1), v.col(2)) / 2;
  double expected = 0;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector2d x = (v.col(k) + v.col((k + 1) % 3)) / 2;
    const Eigen::Vector3d stress(x.y(), x.y(), -x.x());
    expected += area / 3 * stress.dot(c * stress);
  }
  const Dofs dofs = interpolate(v, outward, field);
  const HctFlexibility s = hct_flexibility(hct_stress(v, outward), area, c);
  EXPECT_NEAR(dofs.dot(s * dofs), expected, 1e-12 * expected);
}

TEST(Hct, FlexibilityIsSemidefiniteWithTheAffineFunctionsAsKernel) {
  const TriangleVertices& v = shapes()[1].v;
  const EdgeSigns outward = {-1, 1, 1};
  const double area = cross_area(v.col(0), v.col(1), v.col(2)) / 2;
  const HctFlexibility s =
      hct_flexibility(hct_stress(v, outward), area, compliance({1, 0.3}, Plane::strain));
  EXPECT_EQ((s - s.transpose()).norm(), 0);
  const Eigen::VectorXd eigenvalues = testing::eigenvalues(s);
  EXPECT_LT(eigenvalues.head<3>().cwiseAbs().maxCoeff(), 1e-13 * eigenvalues(11));
  EXPECT_GT(eigenvalues(3), 1e-6 * eigenvalues(11));
  for (int a = 0; a < 3; ++a) {
    const Field affine = monomial(a == 1, a == 2, {0, 0}, 1);
    EXPECT_LT((s * interpolate(v, outward, affine)).norm(), 1e-12 * eigenvalues(11));
  }
}

TEST(Elasticity, PlaneStrainAndPlaneStressAreHookesLaw) {
  const Material steel{210000, 0.3};
  // Uniaxial stress: εxx = σ/E in plane stress; (1 − ν²) σ/E in plane strain; εyy accordingly.
  const Eigen::Vector3d uniaxial(100, 0, 0);
  const Eigen::Vector3d stress = compliance(steel, Plane::stress) * uniaxial;
  EXPECT_DOUBLE_EQ(stress(0), 100 / 210000.);
  EXPECT_DOUBLE_EQ(stress(1), -0.3 * 100 / 210000.);
  const Eigen::Vector3d strain = compliance(steel, Plane::strain) * uniaxial;
  EXPECT_NEAR(strain(0), 0.91 * 100 / 210000., 1e-18);
  EXPECT_NEAR(strain(1), -0.3 * 1.3 * 100 / 210000., 1e-18);
  // Shear does not know the plane: γ = σ/G.
  const Eigen::Vector3d shear(0, 0, 100);
  EXPECT_NEAR((compliance(steel, Plane::stress) * shear)(2), 100 / 80769.2307692, 1e-12);
  EXPECT_NEAR((compliance(steel, Plane::strain) * shear)(2), 100 / 80769.2307692, 1e-12);
}

}  // namespace
}  // namespace airybench::hct_test
