#include "assembly/displacement_field.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "assembly/control_points.hpp"
#include "tests/support/dense_algebra.hpp"
#include "tests/support/exact_fields.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::displacement_field_test {
namespace {

using testing::small_tooth;
constexpr double young = 2000, poisson = 0.3;

// The coefficients of a quadratic field, by sampling every edge.
DisplacementField interpolated(const Problem& problem,
                               const std::function<Eigen::Vector2d(const Eigen::Vector2d&)>& u) {
  const auto vertices = static_cast<Eigen::Index>(problem.mesh.vertices.size());
  DisplacementField field(2, displacement_nodes(problem));
  for (Eigen::Index v = 0; v < vertices; ++v) field.col(v) = u(problem.mesh.vertices[v]);
  for (int e = 0; e < problem.edges.count(); ++e) {
    const auto [low, high] = problem.edges.vertices[e];
    const auto &a = problem.mesh.vertices[low], &b = problem.mesh.vertices[high];
    field.col(vertices + e) = edge_coefficients(u(a), u((a + b) / 2), u(b))[1];
  }
  return field;
}

TEST(DisplacementField, StressOfQuadraticFieldsIsExact) {
  for (const testing::ExactField& exact : testing::exact_fields(young, poisson)) {
    const Problem problem =
        make_problem(small_tooth(5, 4), {compliance({young, poisson}, Plane::stress)},
                     testing::loads_of(exact), 0);
    const StressField stress =
        stress_of_displacement(problem, interpolated(problem, exact.displacement));
    for (int t = 0; t < static_cast<int>(stress.size()); ++t) {
      const TriangleVertices v = problem.vertices_of(t);
      for (int c = 0; c < 9; ++c) {
        const Eigen::Vector2d x = c % 3 == 2 ? Eigen::Vector2d(v.rowwise().mean())
                                             : Eigen::Vector2d(v.col((c / 3 + c % 3) % 3));
        EXPECT_LT((stress[t].col(c) - exact.stress(x)).norm(), 1e-11 * (1 + exact.stress(x).norm()))
            << exact.name << ", triangle " << t << ", corner " << c;
      }
    }
  }
}

TEST(DisplacementField, ClapeyronsTheorem) {
  // Where every displacement on the boundary is that of the solution: 2 U = ∫ b·u + ∫ t·u, and the
  // loads' part of it is what the potential takes off.
  for (const testing::ExactField& exact : testing::exact_fields(young, poisson)) {
    Mesh mesh = small_tooth(5, 4);
    for (BoundaryEdge& edge : mesh.boundary) edge.role = BoundaryRole::force;
    const Problem problem = make_problem(mesh, {compliance({young, poisson}, Plane::stress)},
                                         testing::loads_of(exact), 0);
    const DisplacementField u = interpolated(problem, exact.displacement);
    const double strain_energy =
        stress_norm_squared(problem, stress_of_displacement(problem, u)) / 2;
    EXPECT_NEAR(strain_energy - work_of_loads(problem, u), -strain_energy, 1e-11 * strain_energy)
        << exact.name;
  }
}

TEST(DisplacementField, StiffnessIsSymmetricWithTheRigidMotionsAsItsKernel) {
  TriangleVertices v;
  v << 0.3, 2, 1.1, -0.2, 0.4, 1.7;
  const Eigen::Matrix3d A = compliance({young, poisson}, Plane::strain).inverse();
  const double area = cross_area(v.col(0), v.col(1), v.col(2)) / 2;
  const QuadraticStiffness K = quadratic_stiffness(quadratic_strain(v), area, A);
  EXPECT_LT((K - K.transpose()).norm(), 1e-14 * K.norm());
  const Eigen::VectorXd eigenvalues = testing::eigenvalues(K);
  EXPECT_LT(eigenvalues.head(3).cwiseAbs().maxCoeff(), 1e-13 * eigenvalues(11));
  EXPECT_GT(eigenvalues(3), 1e-4 * eigenvalues(11));
}

TEST(DisplacementField, NodalLoadsHaveTheLoadsResultantAndMoment) {
  Loads loads;
  loads.body_force_N_per_mm3 = {3, -1};
  loads.traction_MPa = [](const Eigen::Vector2d& x, const Eigen::Vector2d& n, int) {
    return Eigen::Vector2d(2 * x.x() + n.y(), 1 - x.y());
  };
  Mesh mesh = small_tooth(5, 4);
  const Problem problem = make_problem(mesh, {compliance({}, Plane::strain)}, loads, 0);
  // Rigid motions are in the space: their work is the loads' work, here by Simpson's rule (exact).
  for (const auto& motion : std::vector<std::function<Eigen::Vector2d(const Eigen::Vector2d&)>>{
           [](const auto&) { return Eigen::Vector2d(1, 0); },
           [](const auto&) { return Eigen::Vector2d(0, 1); },
           [](const auto& x) { return Eigen::Vector2d(-x.y(), x.x()); }}) {
    double work = 0;
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
      work += problem.area_mm2(t) *
              loads.body_force_N_per_mm3.dot(motion(problem.vertices_of(t).rowwise().mean()));
    for (const BoundaryEdge& edge : mesh.boundary) {
      if (edge.role != BoundaryRole::force) continue;
      const auto &a = mesh.vertices[edge.vertices[0]], &b = mesh.vertices[edge.vertices[1]];
      const Eigen::Vector2d s = b - a, n = Eigen::Vector2d(s.y(), -s.x()).normalized();
      const auto at = [&](const Eigen::Vector2d& x) {
        return loads.traction_MPa(x, n, 0).dot(motion(x));
      };
      work += s.norm() / 6 * (at(a) + 4 * at((a + b) / 2) + at(b));
    }
    const double by_nodes = nodal_loads(problem).cwiseProduct(interpolated(problem, motion)).sum();
    EXPECT_NEAR(by_nodes, work, 1e-10 * (1 + std::abs(work)));
  }
}

TEST(ControlPoints, AreTheVerticesAndEdgesOfTheContactFaceWithoutThePrescribedOnes) {
  Mesh mesh = small_tooth(5, 4);
  Loads loads;
  loads.gap_mm = [](const auto& x, int) { return 0.1 + 0.02 * x.y() * x.y(); };
  const auto posed = [&](double mu) {
    return make_problem(mesh, {compliance({}, Plane::strain)}, loads, mu);
  };
  EXPECT_EQ(control_points(posed(0.2)).law.size(), 2 * 9);
  EXPECT_EQ(control_points(posed(0)).law.size(), 9);
  for (BoundaryEdge& edge : mesh.boundary)  // the flanks: both ends of the face are on Γ_D then
    if (edge.role == BoundaryRole::force) edge.role = BoundaryRole::displacement;
  const Problem problem = posed(0.2);
  const ControlPoints control = control_points(problem);
  EXPECT_EQ(control.law.count, 7);
  const std::vector<bool> prescribed = prescribed_displacement(problem).at;
  for (int p = 0; p < control.law.count; ++p) {
    EXPECT_FALSE(prescribed[control.node[p]]);
    EXPECT_LT((control.normal[p] - Eigen::Vector2d(1, 0)).norm(), 1e-14);
    EXPECT_LT((control.frame(p).col(1) - Eigen::Vector2d(0, 1)).norm(), 1e-14);
  }
}

TEST(ControlPoints, AtAKinkTheNormalIsTheMeanAndTheGapTheSmallerOne) {
  Mesh mesh = small_tooth(2, 2);
  for (Eigen::Vector2d& x : mesh.vertices)
    if (x.x() > 9.99 && std::abs(x.y()) < 1e-9) x.x() = 11;  // the middle of the face
  const Problem problem = make_problem(mesh, {compliance({}, Plane::strain)}, {}, 0);
  const ControlPoints control = control_points(problem);
  ASSERT_EQ(control.law.count, 5);
  for (int p = 0; p < 5; ++p) {
    const double rise = std::abs(control.normal[p].y() / control.normal[p].x());
    const bool is_kink = control.node[p] < static_cast<int>(mesh.vertices.size()) &&
                         mesh.vertices[control.node[p]].x() == 11;
    EXPECT_NEAR(rise, is_kink ? 0 : 1. / 3, 1e-12) << p;
    EXPECT_NEAR(control.normal[p].norm(), 1, 1e-14);
  }
}

TEST(ContactOffset, ItsCoefficientsMakeTheGap) {
  Mesh mesh = small_tooth(3, 3);
  Loads loads;
  loads.gap_mm = [](const auto& x, int) { return 0.1 - 0.03 * x.y() + 0.02 * x.y() * x.y(); };
  const Problem problem = make_problem(mesh, {compliance({}, Plane::strain)}, loads, 0);
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row) {
    if (mesh.boundary[row].role != BoundaryRole::contact) continue;
    const auto [c0, c1, c2] = problem.offset_coefficients(row);
    const auto &a = mesh.vertices[mesh.boundary[row].vertices[0]],
               &b = mesh.vertices[mesh.boundary[row].vertices[1]];
    for (const double s : {0.0, 0.2, 0.5, 0.9, 1.0})
      EXPECT_NEAR((1 - s) * (1 - s) * c0.gap_mm + 2 * s * (1 - s) * c1.gap_mm + s * s * c2.gap_mm,
                  loads.gap_mm((1 - s) * a + s * b, row), 1e-14);
  }
}

}  // namespace
}  // namespace airybench::displacement_field_test
