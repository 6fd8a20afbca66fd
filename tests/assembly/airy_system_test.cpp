#include "assembly/airy_system.hpp"

#include <gtest/gtest.h>

#include "assembly/elements/edge_forces.hpp"
#include "assembly/stress_field.hpp"
#include "mesh/msh_format.hpp"
#include "tests/support/dense_algebra.hpp"
#include "tests/support/exact_fields.hpp"
#include "tests/support/places.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/sanitized.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::airy_system_test {
namespace {

using testing::posed;
using testing::small_tooth;

// The exact solution's Airy unknowns for φ given as a function with gradient.
Eigen::VectorXd interpolate(const AirySystem& system,
                            const std::function<double(const Eigen::Vector2d&)>& phi,
                            const std::function<Eigen::Vector2d(const Eigen::Vector2d&)>& slope) {
  const Problem& problem = *system.problem;
  const Eigen::Vector2d x0 = problem.mesh.vertices[problem.central_vertices.front()];
  const double phi0 = phi(x0);
  const Eigen::Vector2d slope0 = slope(x0);
  Eigen::VectorXd x(system.n());
  for (std::size_t v = 0; v < problem.mesh.vertices.size(); ++v) {
    const int dof = system.dofs.of_vertex[v];
    if (dof == DofNumbering::gauge) continue;
    const Eigen::Vector2d& at = problem.mesh.vertices[v];
    x(dof) = phi(at) - phi0 - slope0.dot(at - x0);
    x.segment<2>(dof + 1) = slope(at) - slope0;
  }
  for (int e = 0; e < problem.edges.count(); ++e) {
    const auto [low, high] = problem.edges.vertices[e];
    const auto &a = problem.mesh.vertices[low], &b = problem.mesh.vertices[high];
    x(system.dofs.of_edge[e]) = edge_frame(a, b).normal.dot(slope((a + b) / 2) - slope0);
  }
  return x.cwiseQuotient(system.scale);
}

TEST(AirySystem, SizesFollowTheMesh) {
  const Mesh mesh = small_tooth(5, 4);
  const MeshSizes sizes = mesh_sizes(mesh);
  const AirySystem system = airy_system(posed({}, mesh));
  EXPECT_EQ(system.n(), sizes.n_phi - 3);
  EXPECT_EQ(system.n_f(), 4 * 10);
  EXPECT_EQ(system.n_c(), 4 * 4);
  EXPECT_EQ(system.contact.count, 8);
}

TEST(AirySystem, FlexibilityIsEquilibratedSymmetricPositiveDefinite) {
  const AirySystem system = airy_system(posed({}, small_tooth(3, 3)));
  const Eigen::MatrixXd S = Eigen::MatrixXd(system.S).selfadjointView<Eigen::Lower>();
  EXPECT_LT((S.diagonal().array() - 1).abs().maxCoeff(), 1e-15);
  EXPECT_GT(testing::eigenvalues(S)(0), 0);
}

TEST(AirySystem, ConstraintsHaveFullRank) {
  const auto names = testing::sanitized ? std::vector{"Mesh0"} : std::vector{"Mesh0", "Mesh4"};
  for (const char* name : names) {
    const AirySystem system = airy_system(posed({}, testing::catalogue_mesh(name)));
    Eigen::MatrixXd C(system.n_f() + system.n_c(), system.n());
    C << Eigen::MatrixXd(system.C_F), Eigen::MatrixXd(system.C_C);
    EXPECT_EQ(testing::rank(C.transpose()), C.rows()) << name;
  }
}

TEST(AirySystem, QuadraticFormAndForcesOfAKnownAiryFunction) {
  // φ = x²y/2 + y³/6 − x y: σ = (y, y, 1 − x).
  const AirySystem system = airy_system(posed({}, small_tooth(4, 3)));
  const Problem& problem = *system.problem;
  const Eigen::VectorXd x = interpolate(
      system,
      [](const Eigen::Vector2d& p) {
        return p.x() * p.x() * p.y() / 2 + p.y() * p.y() * p.y() / 6 - p.x() * p.y();
      },
      [](const Eigen::Vector2d& p) {
        return Eigen::Vector2d(p.x() * p.y() - p.y(),
                               p.x() * p.x() / 2 + p.y() * p.y() / 2 - p.x());
      });
  const auto stress_at = [](const Eigen::Vector2d& p) {
    return Eigen::Vector3d(p.y(), p.y(), 1 - p.x());
  };
  const StressField field = stress_of_airy_function(problem, airy_function(system, x));
  for (int t = 0; t < static_cast<int>(field.size()); ++t)
    for (int c = 0; c < 9; ++c) {
      const TriangleVertices v = problem.vertices_of(t);
      const Eigen::Vector2d at = c % 3 == 2 ? Eigen::Vector2d(v.rowwise().mean())
                                            : Eigen::Vector2d(v.col((c / 3 + c % 3) % 3));
      EXPECT_LT((field[t].col(c) - stress_at(at)).norm(), 1e-11);
    }
  const double energy = x.dot(system.S.selfadjointView<Eigen::Lower>() * x);
  EXPECT_NEAR(energy, stress_norm_squared(problem, field), 1e-10 * energy);

  const Eigen::VectorXd F_C = system.C_C * x;
  for (int p = 0; p < system.contact.count; ++p) {
    const auto [a, b] = problem.mesh.boundary[system.contact.boundary[p]].vertices;
    const EdgeFrame frame = edge_frame(problem.mesh.vertices[a], problem.mesh.vertices[b]);
    const Eigen::Vector2d t =
        frame.length_mm / 2 *
        traction(stress_at(problem.mesh.vertices[p % 2 == 0 ? a : b]), frame.normal);
    EXPECT_NEAR(F_C(2 * p), frame.normal.dot(t), 1e-10);
    EXPECT_NEAR(F_C(2 * p + 1), frame.tangent.dot(t), 1e-10);
  }
}

TEST(AirySystem, GapIsTheWorkPartnerOfTheForces) {
  // ∫ (g − ρ)·σ over an edge for linear tractions equals Σ F·ḡ.
  Scene scene;
  scene.clearance_mm = 0.01;
  const AirySystem system = airy_system(posed(scene, small_tooth(4, 4)));
  const Problem& problem = *system.problem;
  for (int p = 0; p < system.contact.count; p += 2) {
    const int row = system.contact.boundary[p];
    const auto [a, b] = problem.mesh.boundary[row].vertices;
    const auto &xa = problem.mesh.vertices[a], &xb = problem.mesh.vertices[b];
    const EdgeFrame frame = edge_frame(xa, xb);
    const Eigen::Vector2d at_a(-3, 1.5), at_b(2, 0.5);  // normal and tangential, MPa
    double work = 0;                                    // three-point Gauss
    for (const auto& [s, w] : {std::pair{0.5 - std::sqrt(0.15), 5 / 18.}, std::pair{0.5, 8 / 18.},
                               std::pair{0.5 + std::sqrt(0.15), 5 / 18.}}) {
      const Eigen::Vector2d x = (1 - s) * xa + s * xb;
      const Eigen::Vector2d wall(
          problem.loads.gap_mm(x, row) - frame.normal.dot(scene.displacement_mm),
          -frame.tangent.dot(scene.displacement_mm));
      work += w * frame.length_mm * wall.dot((1 - s) * at_a + s * at_b);
    }
    const Eigen::Vector4d forces =
        frame.length_mm / 2 * Eigen::Vector4d(at_a.x(), at_a.y(), at_b.x(), at_b.y());
    EXPECT_NEAR(forces.dot(system.contact.gap.segment<4>(2 * p)), work, 1e-14);
  }
}

TEST(StressField, EnergyKeepsItsDigitsWhereTheAiryFunctionIsLarge) {
  // A constant stress on the rack: the energy is known, φ reaches 1e5.
  const AirySystem system = airy_system(posed({}, testing::catalogue_mesh("Mesh4")));
  const Problem& problem = *system.problem;
  const Eigen::VectorXd x = interpolate(
      system, [](const Eigen::Vector2d& p) { return 50 * p.y() * p.y(); },
      [](const Eigen::Vector2d& p) { return Eigen::Vector2d(0, 100 * p.y()); });
  const StressField field = stress_of_airy_function(problem, airy_function(system, x));
  double area = 0;
  for (int t = 0; t < static_cast<int>(field.size()); ++t) area += problem.area_mm2(t);
  const double expected = 1e4 * area * problem.compliance[0](0, 0);
  EXPECT_NEAR(stress_norm_squared(problem, field) / expected, 1, 1e-12);
}

TEST(StressField, DistanceIsTheEnergyNormOfTheDifference) {
  const auto problem = posed({}, small_tooth(2, 2));
  const std::size_t triangles = problem->mesh.triangles.size();
  StressField one(triangles), two(triangles);
  one.values().setOnes();
  two.values().setConstant(2);
  EXPECT_EQ(stress_distance(*problem, one, one), 0);
  EXPECT_NEAR(stress_distance(*problem, one, two), std::sqrt(stress_norm_squared(*problem, one)),
              1e-15);
  // ∫ of a constant energy density over the tooth's 80 mm².
  EXPECT_NEAR(stress_norm_squared(*problem, one), 80 * problem->compliance[0].sum(), 1e-15);
}

TEST(AirySystem, HasNoAiryFunctionOnABodyWithAHole) {
  Scene scene;
  scene.crown_radius_mm.reset();
  const auto problem = posed(scene, testing::small_plate(1));
  EXPECT_EQ(why_no_airy_function(*problem),
            "a body with 1 hole needs a multi-valued Airy function");
  EXPECT_THROW(airy_system(problem), std::invalid_argument);
  EXPECT_EQ(contact_system(problem).contact.count, 2 * mesh_sizes(problem->mesh).contact_edges);
}

TEST(CuthillMcKee, IsAPermutationThatNarrowsTheSkyline) {
  const auto problem = posed({}, small_tooth(12, 6));
  const NodeGraph graph = airy_node_graph(*problem);
  const std::vector<int> position = cuthill_mckee(graph);
  std::vector<int> sorted = position;
  std::sort(sorted.begin(), sorted.end());
  for (int i = 0; i < static_cast<int>(sorted.size()); ++i) ASSERT_EQ(sorted[i], i);
  const auto profile = [&](auto place) {
    long sum = 0;
    for (int i = 0; i + 1 < static_cast<int>(graph.start.size()); ++i) {
      int first = place(i);
      for (int k = graph.start[i]; k < graph.start[i + 1]; ++k)
        first = std::min(first, place(graph.neighbour[k]));
      sum += place(i) - first;
    }
    return sum;
  };
  EXPECT_LT(2 * profile([&](int i) { return position[i]; }), profile([](int i) { return i; }));
}

}  // namespace
}  // namespace airybench::airy_system_test
