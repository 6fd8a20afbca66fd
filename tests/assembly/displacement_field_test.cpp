#include "assembly/displacement_field.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "assembly/control_points.hpp"
#include "assembly/nodal_forces.hpp"
#include "assembly/total_displacement.hpp"
#include "tests/support/dense_algebra.hpp"
#include "tests/support/exact_fields.hpp"
#include "tests/support/polynomial.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::displacement_field_test {
namespace {

using testing::small_tooth;
constexpr double young = 2000, poisson = 0.3;

TEST(DisplacementField, StressOfQuadraticFieldsIsExact) {
  for (const testing::ExactField& exact : testing::exact_fields(young, poisson)) {
    const Problem problem =
        make_problem(small_tooth(5, 4), {compliance({young, poisson}, Plane::stress)},
                     testing::loads_of(exact), 0);
    const StressField stress =
        stress_of_displacement(problem, testing::interpolated(problem, 2, exact.displacement));
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

// Calls check(std::integral_constant<int, p>()) for every degree.
template <typename Check>
void for_all_degrees(Check check) {
  for (int k = 1; k <= highest_stress_degree; ++k)
    with_degree(k, [&](auto stress_degree) {
      check(std::integral_constant<int, stress_degree + 1>());
      return 0;
    });
}

TEST(DisplacementField, ItsSizeTellsItsDegree) {
  const Problem problem =
      make_problem(small_tooth(2, 2), {compliance({young, poisson}, Plane::strain)}, {}, 0);
  EXPECT_EQ(displacement_nodes(problem), 9 + 16);
  EXPECT_EQ(displacement_nodes(problem, 4), 9 + 3 * 16 + 3 * 8);
  for (int p = 2; p <= highest_stress_degree + 1; ++p) {
    const DisplacementField u = DisplacementField::Zero(2, displacement_nodes(problem, p));
    EXPECT_EQ(displacement_degree(problem, u), p);
  }
  EXPECT_THROW(displacement_degree(problem, DisplacementField::Zero(2, 26)), std::invalid_argument);
}

// Its stress, too, and the work of the loads on it, is that of the polynomial.
TEST(DisplacementField, PolynomialsOfItsDegreeAreExact) {
  Loads loads;
  loads.body_force_N_per_mm3 = {3, -1};
  loads.traction_MPa = [](const Eigen::Vector2d& x, const Eigen::Vector2d&, int) {
    return Eigen::Vector2d(2 - x.x(), 1 + x.y());
  };
  const Problem problem =
      make_problem(small_tooth(3, 2), {compliance({young, poisson}, Plane::strain)}, loads, 0);
  for_all_degrees([&](auto degree) {
    constexpr int p = degree, k = p - 1;
    const testing::Polynomial exact(p, 10, 7 + p);
    const DisplacementField u = testing::interpolated(problem, p, exact);
    const StressField stress = stress_of_displacement(problem, u);
    ASSERT_EQ(stress.degree(), k);
    for (int t = 0; t < static_cast<int>(stress.size()); ++t) {
      const TriangleVertices v = problem.vertices_of(t);
      for (int third = 0; third < 3; ++third)
        for (int corner = 0; corner < 3; ++corner) {  // coefficients at corners are values
          const std::array<int, 3> places = {0, k, bernstein_count(k) - 1};
          const Eigen::Vector2d x = corner == 2 ? Eigen::Vector2d(v.rowwise().mean())
                                                : Eigen::Vector2d(v.col((third + corner) % 3));
          const Eigen::Vector3d expected =
              elasticity_of(problem.compliance_of(t)) * exact.strain(x);
          EXPECT_LT((stress[t].col(bernstein_count(k) * third + places[corner]) - expected).norm(),
                    1e-10 * (1 + expected.norm()))
              << "degree " << p << ", triangle " << t << ", corner " << corner;
        }
    }
    const TriangleVertices v = problem.vertices_of(3);
    const Eigen::Vector3d lambda(0.2, 0.5, 0.3);
    EXPECT_LT((displacement_at(problem, u, 3, lambda) - exact(v * lambda)).norm(), 1e-13) << p;
    for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row) {
      constexpr int steps = 2000;
      const auto [start, end] = problem.mesh.boundary[row].vertices;
      const auto &a = problem.mesh.vertices[start], &b = problem.mesh.vertices[end];
      Eigen::Vector2d mean(0, 0);
      for (int i = 0; i < steps; ++i) mean += exact(a + (i + 0.5) / steps * (b - a)) / steps;
      EXPECT_LT((mean_on_edge(problem, u, row) - mean).norm(), 1e-6) << p;
    }
    // Against the field of the highest degree, which is the same function.
    constexpr int highest = highest_stress_degree + 1;
    const DisplacementField same = testing::interpolated(problem, highest, exact);
    const double work = work_of_loads(problem, u);
    EXPECT_NEAR(work, work_of_loads(problem, same), 1e-11 * (1 + std::abs(work))) << p;
    const double energy = stress_norm_squared(problem, stress);
    EXPECT_NEAR(energy, stress_norm_squared(problem, stress_of_displacement(problem, same)),
                1e-11 * energy)
        << p;
  });
}

TEST(DisplacementField, OfEveryDegreeItTakesRigidMotionAndPrescribedValuesExactly) {
  const auto u0 = [](const Eigen::Vector2d& x) {
    return Eigen::Vector2d(0.1 + 0.02 * x.y() - 0.003 * x.y() * x.y(), 0.01 * x.y() * x.y());
  };
  Loads loads;
  loads.displacement_mm = [&](const Eigen::Vector2d& x, int) { return u0(x); };
  const Problem problem =
      make_problem(small_tooth(3, 2), {compliance({young, poisson}, Plane::strain)}, loads, 0);
  for_all_degrees([&](auto degree) {
    constexpr int p = degree;
    const DisplacementField expected = testing::interpolated(problem, p, u0);
    const PrescribedDisplacement given = prescribed_displacement(problem, p);
    const DisplacementField u = with_rigid_motion(problem, given.u);
    int held = 0;
    for (Eigen::Index node = 0; node < u.cols(); ++node) {
      if (!given.at[static_cast<std::size_t>(node)]) continue;
      ++held;
      EXPECT_LT((u.col(node) - expected.col(node)).norm(), 1e-13) << p << ", node " << node;
    }
    EXPECT_EQ(held, 2 * p + 1);  // two edges
    const auto rigid = [&](const Eigen::Vector2d& x) { return problem.motion.at(x); };
    const DisplacementField zero = DisplacementField::Zero(2, u.cols());
    EXPECT_LT((with_rigid_motion(problem, zero) - testing::interpolated(problem, p, rigid)).norm(),
              1e-12)
        << p;
  });
}

TEST(DisplacementTriangle, ItsStiffnessIsTheEnergyWithTheRigidMotionsAsItsKernel) {
  TriangleVertices v;
  v << 0.3, 2, 1.1, -0.2, 0.4, 1.7;
  const Eigen::Matrix3d A = compliance({young, poisson}, Plane::strain).inverse();
  const TriangleShape shape(v);
  for_all_degrees([&](auto degree) {
    const auto& triangle = DisplacementTriangle::of_degree(degree);
    const Eigen::MatrixXd K = triangle.stiffness(shape, A);
    EXPECT_LT((K - K.transpose()).norm(), 1e-14 * K.norm());
    const Eigen::VectorXd eigenvalues = testing::eigenvalues(K);
    EXPECT_LT(eigenvalues.head(3).cwiseAbs().maxCoeff(), 1e-13 * K.norm());
    EXPECT_GT(eigenvalues(3), 1e-6 * K.norm());
    const Eigen::Matrix2Xd u = Eigen::Matrix2Xd::Random(2, triangle.nodes);
    const Eigen::Matrix3Xd strain = triangle.strain(shape.gradients, u),
                           dual = shape.area_mm2 * A * strain * triangle.mass;
    const Eigen::Matrix2Xd force = triangle.forces(shape.gradients, dual);
    EXPECT_LT((K * u.reshaped() - force.reshaped()).norm(), 1e-12 * force.norm());
    EXPECT_NEAR(strain.cwiseProduct(dual).sum(), u.cwiseProduct(force).sum(), 1e-10 * force.norm());
  });
}

TEST(DisplacementField, ClapeyronsTheorem) {
  // Where every displacement on the boundary is that of the solution: 2 U = ∫ b·u + ∫ t·u, and the
  // loads' part of it is what the potential takes off.
  for (const testing::ExactField& exact : testing::exact_fields(young, poisson)) {
    Mesh mesh = small_tooth(5, 4);
    for (BoundaryEdge& edge : mesh.boundary) edge.role = BoundaryRole::force;
    const Problem problem = make_problem(mesh, {compliance({young, poisson}, Plane::stress)},
                                         testing::loads_of(exact), 0);
    const DisplacementField u = testing::interpolated(problem, 2, exact.displacement);
    const double strain_energy =
        stress_norm_squared(problem, stress_of_displacement(problem, u)) / 2;
    EXPECT_NEAR(strain_energy - work_of_loads(problem, u), -strain_energy, 1e-11 * strain_energy)
        << exact.name;
  }
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
    const double by_nodes =
        nodal_loads(problem).cwiseProduct(testing::interpolated(problem, 2, motion)).sum();
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
    const auto [c0, c1, c2] = offset_coefficients<2>(problem, row);
    const auto &a = mesh.vertices[mesh.boundary[row].vertices[0]],
               &b = mesh.vertices[mesh.boundary[row].vertices[1]];
    for (const double s : {0.0, 0.2, 0.5, 0.9, 1.0})
      EXPECT_NEAR((1 - s) * (1 - s) * c0.gap_mm + 2 * s * (1 - s) * c1.gap_mm + s * s * c2.gap_mm,
                  loads.gap_mm((1 - s) * a + s * b, row), 1e-14);
  }
}

}  // namespace
}  // namespace airybench::displacement_field_test
