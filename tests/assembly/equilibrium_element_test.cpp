// The element of every degree by its mathematical properties: as many stresses as counted, all in
// equilibrium, no spurious mode, polynomial fields exact, the order of convergence, slivers.
#include "assembly/elements/equilibrium_element.hpp"

#include <gtest/gtest.h>

#include <random>

#include "assembly/elements/edge_forces.hpp"
#include "assembly/elements/elasticity.hpp"
#include "mesh/mesh.hpp"
#include "tests/support/dense_algebra.hpp"
#include "tests/support/kolosov_fields.hpp"
#include "tests/support/sanitized.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::equilibrium_element_test {
namespace {

using testing::KolosovField;
using testing::moments;
using testing::point;
using testing::polynomial;
using testing::rank;
using testing::smooth;
using testing::stress_at;
using testing::visit_points;
using Triangle = TriangleVertices;

#define FOR_EVERY_DEGREE(function)            \
  do {                                        \
    AIRYBENCH_STRESS_DEGREES(CALL_##function) \
  } while (false)

Triangle triangle(double ax, double ay, double bx, double by, double cx, double cy) {
  Triangle v;
  v << ax, bx, cx, ay, by, cy;
  return v;
}

std::vector<Triangle> random_triangles(int count) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Triangle> all;
  while (static_cast<int>(all.size()) < count) {
    Triangle v;
    for (int i = 0; i < 6; ++i) v.data()[i] = 10 + uniform(generator);
    const Eigen::Vector2d a = v.col(1) - v.col(0), b = v.col(2) - v.col(0);
    if (a.x() * b.y() - a.y() * b.x() > 1) all.push_back(v);
  }
  return all;
}

template <int k>
using Element = EquilibriumElement<double, k>;

template <int k>
typename Element<k>::OnEdges edge_displacements(const KolosovField& field, const Triangle& v) {
  typename Element<k>::OnEdges u;
  for (int t = 0; t < 3; ++t)
    u.template segment<2 * (k + 1)>(2 * (k + 1) * t) =
        moments<k>(field, v.col(t), v.col((t + 1) % 3)).reshaped();
  return u;
}

// The largest error over the largest stress.
template <int k>
double stress_error(const KolosovField& field, const Triangle& v,
                    const typename Element<k>::Stress& stress) {
  if (!stress.allFinite()) return std::numeric_limits<double>::infinity();
  double error = 0, largest = 0;
  visit_points(v, [&](int t, const Eigen::Vector3d& lambda, const Eigen::Vector2d& x, double) {
    const Eigen::Vector3d exact = field.stress(point(x));
    error = std::max(error, (stress_at<k>(stress, t, lambda) - exact).cwiseAbs().maxCoeff());
    largest = std::max(largest, exact.cwiseAbs().maxCoeff());
  });
  return error / largest;
}

template <int k>
void count_modes(int modes, int inner) {
  EXPECT_EQ(StressDegree<k>::modes, modes);
  EXPECT_EQ(StressDegree<k>::inner, inner);
  const ReferenceElement<Wide> element(k);
  Eigen::MatrixXd all(3 * StressDegree<k>::coefficients, modes);
  for (int c = 0; c < 3; ++c)
    all.middleRows(StressDegree<k>::coefficients * c, StressDegree<k>::coefficients) =
        element.stress[c].cast<double>();
  EXPECT_EQ(rank(all), modes) << k;
  EXPECT_EQ(rank(element.forces.cast<double>()), 6 * k + 3) << k;
}

TEST(EquilibriumElement, HasAsManyStressesAsCounted) {
  count_modes<1>(9, 0);
  count_modes<2>(18, 3);
  count_modes<3>(30, 9);
  count_modes<4>(45, 18);
}

template <int k>
void check_equilibrium() {
  const ReferenceElement<Wide> element(k);
  const Triangle v = triangle(0, 0, 1, 0, 0, 1);
  const Eigen::Vector2d centroid = v.rowwise().mean();
  const int n = StressDegree<k>::third;
  const auto tau = [&](int mode, int t, int b, int c) {
    const int row = n * t + ring_place(k, b, c);
    Eigen::Vector3d stress;
    for (int x = 0; x < 3; ++x) stress(x) = static_cast<double>(element.stress[x](row, mode));
    return stress;
  };
  const auto traction = [](const Eigen::Vector3d& s, const Eigen::Vector2d& m) {
    return Eigen::Vector2d(s(0) * m.x() + s(2) * m.y(), s(2) * m.x() + s(1) * m.y());
  };
  for (int mode = 0; mode < StressDegree<k>::modes; ++mode)
    for (int t = 0; t < 3; ++t) {
      const int next = (t + 1) % 3;
      // ∇λ of third t, times twice its area: the opposite side turned left.
      const std::array<Eigen::Vector2d, 3> side = {centroid - v.col(next), v.col(t) - centroid,
                                                   v.col(next) - v.col(t)};
      for (int c = 0; c < k; ++c)
        for (int b = 0; b < k - c; ++b) {
          Eigen::Vector2d divergence = Eigen::Vector2d::Zero();
          for (int p = 0; p < 3; ++p)
            divergence +=
                traction(tau(mode, t, b + (p == 1), c + (p == 2)), {-side[p].y(), side[p].x()});
          EXPECT_LT(divergence.norm(), 1e-12) << k << ' ' << mode;
        }
      // Across the spoke V_next V4, on which thirds t and next meet.
      const Eigen::Vector2d spoke = centroid - v.col(next), normal(spoke.y(), -spoke.x());
      for (int c = 0; c <= k; ++c)
        EXPECT_LT(
            (traction(tau(mode, t, k - c, c), normal) - traction(tau(mode, next, 0, c), normal))
                .norm(),
            1e-12)
            << k << ' ' << mode;
    }
  for (int mode = 0; mode < StressDegree<k>::inner; ++mode)
    for (int t = 0; t < 3; ++t) {
      const Eigen::Vector2d edge = v.col((t + 1) % 3) - v.col(t);
      for (int b = 0; b <= k; ++b)
        EXPECT_LT(traction(tau(mode, t, b, 0), {edge.y(), -edge.x()}).norm(), 1e-12);
    }
}

TEST(EquilibriumElement, StressesAreInEquilibriumInsideAndAcrossThirds) {
#define CALL_check_equilibrium(k) check_equilibrium<k>();
  FOR_EVERY_DEGREE(check_equilibrium);
}

template <int k>
void check_rank() {
  const Eigen::Matrix3d C = compliance({210000, 0.3}, Plane::strain);
  for (const Triangle& v : random_triangles(20)) {
    const typename Element<k>::Stiffness K = Element<k>(v, C).stiffness();
    EXPECT_LT((K - K.transpose()).norm(), 1e-15 * K.norm());
    const Eigen::VectorXd values = testing::eigenvalues(K);
    const double largest = values.tail<1>()(0);
    EXPECT_LT(values.head<3>().cwiseAbs().maxCoeff(), 1e-14 * largest) << k;
    EXPECT_GT(values(3), 1e-9 * largest) << k;
    // A linear displacement has the moments of its values at (j + 1)/(k + 2) of the edge.
    typename Element<k>::OnEdges turned;
    for (int t = 0; t < 3; ++t)
      for (int j = 0; j <= k; ++j) {
        const double s = (j + 1.) / (k + 2);
        const Eigen::Vector2d x = (1 - s) * v.col(t) + s * v.col((t + 1) % 3);
        turned.template segment<2>(2 * ((k + 1) * t + j)) << 3 - x.y(), x.x() - 1;
      }
    EXPECT_LT((K * turned).norm(), 1e-13 * largest * turned.norm()) << k;
  }
}

TEST(EquilibriumElement, OnlyRigidMotionsHaveNoForces) {
#define CALL_check_rank(k) check_rank<k>();
  FOR_EVERY_DEGREE(check_rank);
}

// K of today's HCT element: T S⁻¹ Tᵀ without vertex 1's unknowns.
Eigen::MatrixXd hct_stiffness(const Triangle& v, const Eigen::Matrix3d& C) {
  const EdgeSigns outward = {1, 1, 1};
  const Eigen::Vector2d a = v.col(1) - v.col(0), b = v.col(2) - v.col(0);
  const double area = (a.x() * b.y() - a.y() * b.x()) / 2;
  const Eigen::Matrix<double, 36, 9> M =
      hct_flexibility_root(hct_stress(v, outward), area, C).rightCols<9>();
  const auto S = SmallCholesky<double, 9>::of_root(M);
  Eigen::Matrix<double, 9, 12> root = Eigen::Matrix<double, 9, 12>::Zero();
  for (int t = 0; t < 3; ++t) {
    const int next = (t + 1) % 3;
    const EdgeForces f = edge_forces(v.col(t), v.col(next), 1);
    const std::array<int, 7> dofs = {3 * t,        3 * t + 1,    3 * t + 2, 3 * next,
                                     3 * next + 1, 3 * next + 2, 9 + t};
    for (int j = 0; j < 7; ++j)
      if (dofs[j] >= 3) root.block<1, 4>(dofs[j] - 3, 4 * t) = f.col(j).transpose();
  }
  S.solve_lower(root);
  return root.transpose() * root;
}

TEST(EquilibriumElement, OfDegreeOneIsTheHctElement) {
  for (const double poisson : {0.3, 0.4999})
    for (const Triangle& v : random_triangles(20)) {
      const Eigen::Matrix3d C = compliance({210000, poisson}, Plane::strain);
      const Eigen::MatrixXd K = Element<1>(v, C).stiffness(), hct = hct_stiffness(v, C);
      EXPECT_LT((K - hct).norm(), 1e-11 * hct.norm());
    }
}

template <int k>
void check_patch() {
  for (const double poisson : {0., 0.3, 0.49, 0.4999}) {
    // That of the displacements, 1e-16, times the stiffest over the softest strain, times the
    // condition of a Bernstein basis, which doubles with each degree.
    const double rounding = (poisson < 0.4 ? 1e-12 : 1e-11) * (1 << k);
    for (const Triangle& v : random_triangles(5))
      for (int m = 0; m <= k; ++m) {
        const KolosovField field = polynomial(m, poisson);
        Triangle here = v.array() - 10;
        const Element<k> element(here, field.C());
        const auto u = edge_displacements<k>(field, here);
        const auto stress = element.stress(u);
        EXPECT_LT(stress_error<k>(field, here, stress), rounding)
            << "k " << k << " m " << m << " nu " << poisson;
        const auto forces = element.edge_forces(stress);
        EXPECT_LT((element.stiffness() * u - forces).norm(), rounding * forces.norm());
        EXPECT_NEAR(element.energy(stress, stress), u.dot(forces),
                    rounding * std::abs(u.dot(forces)));
      }
  }
}

TEST(EquilibriumElement, PolynomialsOfItsDegreeAreExact) {
#define CALL_check_patch(k) check_patch<k>();
  FOR_EVERY_DEGREE(check_patch);
}

// A bar under its own weight, σ_p = (−b x, 0, 0), is the particular stress; u gives another one.
template <int k>
void check_body_force() {
  const Eigen::Matrix3d C = compliance({210000, 0.3}, Plane::strain);
  for (const Triangle& v : random_triangles(5)) {
    const Element<k> element(v, C);
    const auto lin = [&](const Eigen::Vector2d& slope, int component) {
      Eigen::Matrix3d at = Eigen::Matrix3d::Zero();
      at.row(component) = slope.transpose() * v;
      return linear_stress<k>(at);
    };
    // Two stresses that balance the same body force; their difference has edge forces of a mode.
    const auto along_x = lin({-3, 0}, 0), sheared = lin({0, -3}, 2);
    typename Element<k>::OnEdges u;
    for (int i = 0; i < u.size(); ++i) u(i) = 1e-3 * std::sin(7. * i);
    const auto one = element.stress(u, along_x), other = element.stress(u, sheared);
    EXPECT_LT((one - other).norm(), 1e-11 * one.norm()) << k;
    const auto forces = element.edge_forces(one);
    EXPECT_LT((element.stiffness() * u + element.load(along_x) - forces).norm(),
              1e-11 * forces.norm());
    EXPECT_LT((element.stiffness() * u + element.load(sheared) - forces).norm(),
              1e-11 * forces.norm());
  }
}

TEST(EquilibriumElement, TotalStressDoesNotDependOnTheParticularOne) {
#define CALL_check_body_force(k) check_body_force<k>();
  FOR_EVERY_DEGREE(check_body_force);
}

// Of the stress of a polynomial field on a triangle of this height.
template <int k>
double loss_at_height(double height, typename Element<k>::Factor factor) {
  const Triangle v = triangle(0, 0, 1, 0, 0.3, height);
  const KolosovField field = polynomial(k, 0.3);
  const Element<k> element(v, field.C(), factor);
  return stress_error<k>(field, v, element.stress(edge_displacements<k>(field, v)));
}

template <int k>
void check_slivers() {
  using Factor = typename Element<k>::Factor;
  for (const double height : {1., 1e-1, 1e-2, 1e-3, 1e-4})
    EXPECT_LT(loss_at_height<k>(height, Factor::by_condition), 1e-13 + 1e-14 / height / height)
        << k << ' ' << height;
  // The sum of the six matrices loses twice as many.
  EXPECT_GT(loss_at_height<k>(1e-3, Factor::of_product), 1e-4) << k;
}

TEST(EquilibriumElement, SliversLoseFewDigits) {
#define CALL_check_slivers(k) check_slivers<k>();
  FOR_EVERY_DEGREE(check_slivers);
}

template <int k>
void check_long_double() {
  for (const double poisson : {0.3, 0.4999})
    for (const Triangle& v : random_triangles(3)) {
      const Eigen::Matrix3d C = compliance({210000, poisson}, Plane::strain);
      const Eigen::MatrixXd exact =
          EquilibriumElement<Wide, k>(v, C).stiffness().template cast<double>();
      EXPECT_LT((Element<k>(v, C).stiffness() - exact).norm(), 1e-11 * exact.norm()) << k;
    }
}

TEST(EquilibriumElement, IsThatOfLongDoubleToRounding) {
#define CALL_check_long_double(k) check_long_double<k>();
  FOR_EVERY_DEGREE(check_long_double);
}

TEST(EquilibriumElement, TellsDataThatAreNotFinite) {
  const Triangle v = triangle(0, 0, 1, 0, 0, std::numeric_limits<double>::quiet_NaN());
  const Eigen::Matrix3d C = compliance({210000, 0.3}, Plane::strain);
  EXPECT_FALSE(Element<2>(v, C).independence() > 0);
  EXPECT_FALSE(Element<2>(triangle(0, 0, 1, 0, 0.5, 0), C).independence() > 1e-12);
}

// The unit square as n×n cells of two triangles, turned so that no edge is along an axis.
Mesh turned_square(int n) {
  Mesh mesh = testing::small_block(n, n, 20);
  for (Eigen::Vector2d& x : mesh.vertices) x /= 10;
  return mesh;
}

// Relative error of the stress in the energy norm, u given on the whole boundary.
template <int k>
double error_of_mesh(const Mesh& mesh, const KolosovField& field) {
  constexpr int own = 2 * (k + 1);
  const MeshEdges edges = number_edges(mesh);
  // Per edge from its low vertex: given, or zero and unknown.
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(own, edges.count());
  std::vector<int> first(static_cast<std::size_t>(edges.count()), 0);
  for (const int edge : edges.of_boundary) {
    const auto [low, high] = edges.vertices[edge];
    u.col(edge) = moments<k>(field, mesh.vertices[low], mesh.vertices[high]).reshaped();
    first[edge] = -1;
  }
  int unknowns = 0;
  for (int& number : first)
    if (number == 0) number = std::exchange(unknowns, unknowns + own);
  const auto vertices = [&](int t) {
    Triangle v;
    for (int i = 0; i < 3; ++i) v.col(i) = mesh.vertices[mesh.triangles[t][i]];
    return v;
  };
  // Row i of an element's edge belongs to this row from the low vertex.
  const auto from_low = [&](int t, int edge, int i) {
    const bool walked = mesh.triangles[t][edge] < mesh.triangles[t][(edge + 1) % 3];
    return walked ? i : 2 * (k - i / 2) + i % 2;
  };
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(unknowns, unknowns);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(unknowns);
  const int triangles = static_cast<int>(mesh.triangles.size());
  for (int t = 0; t < triangles; ++t) {
    const auto K_e = Element<k>(vertices(t), field.C()).stiffness();
    const auto visit = [&](auto with) {
      for (int e = 0; e < 3; ++e)
        for (int i = 0; i < own; ++i) with(own * e + i, edges.of_triangle[t][e], from_low(t, e, i));
    };
    visit([&](int row, int edge, int i) {
      if (first[edge] < 0) return;
      visit([&](int column, int other, int j) {
        if (first[other] < 0)
          b(first[edge] + i) -= K_e(row, column) * u(j, other);
        else
          K(first[edge] + i, first[other] + j) += K_e(row, column);
      });
    });
  }
  const Eigen::VectorXd x = testing::solved(K, b);
  for (int edge = 0; edge < edges.count(); ++edge)
    if (first[edge] >= 0) u.col(edge) = x.segment<own>(first[edge]);
  double error = 0, size = 0;
  for (int t = 0; t < triangles; ++t) {
    typename Element<k>::OnEdges local;
    for (int e = 0; e < 3; ++e)
      for (int i = 0; i < own; ++i)
        local(own * e + i) = u(from_low(t, e, i), edges.of_triangle[t][e]);
    const auto stress = Element<k>(vertices(t), field.C()).stress(local);
    visit_points(vertices(t), [&](int third, const Eigen::Vector3d& lambda,
                                  const Eigen::Vector2d& at, double weight) {
      const Eigen::Vector3d exact = field.stress(point(at)),
                            off = stress_at<k>(stress, third, lambda) - exact;
      error += weight * off.dot(field.C() * off);
      size += weight * exact.dot(field.C() * exact);
    });
  }
  return std::sqrt(error / size);
}

template <int k>
void check_order() {
  if (testing::sanitized && k > 2) return;
  for (const double poisson : {0.3, 0.4999}) {
    const KolosovField field = smooth(poisson);
    constexpr int n = k == 1 ? 8 : 4;
    const double coarse = error_of_mesh<k>(turned_square(n), field),
                 fine = error_of_mesh<k>(turned_square(2 * n), field);
    EXPECT_GT(std::log2(coarse / fine), k + 0.85) << k << ' ' << poisson;
  }
}

TEST(EquilibriumElement, StressesConvergeWithOneOrderMoreThanTheirDegree) {
#define CALL_check_order(k) check_order<k>();
  FOR_EVERY_DEGREE(check_order);
}

}  // namespace
}  // namespace airybench::equilibrium_element_test
