// Every violation is put into a right answer, in a known size.
#include "verify/contact_violations.hpp"

#include <gtest/gtest.h>

#include "assembly/control_points.hpp"
#include "solvers/methods.hpp"
#include "tests/support/posed.hpp"
#include "tests/verify/solved_body.hpp"
#include "verify/verifier.hpp"

namespace airybench::contact_violations_test {
namespace {

// A tooth at a flat wall that it touches, at rest.
std::shared_ptr<const Problem> at_rest() {
  return testing::posed({.crown_radius_mm = std::nullopt, .displacement_mm = {0, 0}});
}

int contact_row(const Problem& problem) {
  int row = 0;
  while (problem.mesh.boundary[row].role != BoundaryRole::contact) ++row;
  return row;
}

// Along the first contact edge u_n − g0 = q with these Bernstein coefficients.
DisplacementField with_normal(const Problem& problem, const std::array<double, 3>& q) {
  DisplacementField w = DisplacementField::Zero(2, displacement_nodes(problem));
  const int row = contact_row(problem);
  const std::array<int, 3> nodes = boundary_nodes(problem, row);
  for (int i = 0; i < 3; ++i) w.col(nodes[i]) = q[i] * problem.frame_at(row, i, 2).normal;
  return w;
}

TEST(ContactViolations, PenetrationAtANode) {
  const auto problem = at_rest();
  const Penetration through = penetration(*problem, with_normal(*problem, {0, 2e-3, 0}));
  EXPECT_NEAR(through.at_nodes_mm, 1e-3, 1e-15);  // in the middle
  EXPECT_NEAR(through.on_edges_mm, 1e-3, 1e-14);
  EXPECT_NEAR(through.share, 0.5, 1e-12);
}

// q = −16 δ (s − 1/2)(s − 1): −8 δ, 0, 0 at the nodes, and δ at s = 3/4.
TEST(ContactViolations, PenetrationBetweenNodes) {
  const auto problem = at_rest();
  constexpr double delta = 1e-4;
  const Penetration through =
      penetration(*problem, with_normal(*problem, {-8 * delta, 4 * delta, 0}));
  EXPECT_NEAR(through.at_nodes_mm, 0, 1e-18);
  EXPECT_NEAR(through.on_edges_mm, delta, 1e-10 * delta);
  EXPECT_NEAR(through.share, 0, 1e-12);
}

TEST(ContactViolations, ABodyThatStaysInFrontOfTheWallDoesNotPenetrate) {
  const auto problem = at_rest();
  const Penetration through = penetration(*problem, with_normal(*problem, {-1, -2, -1}));
  EXPECT_EQ(through.at_nodes_mm, 0);
  EXPECT_EQ(through.on_edges_mm, 0);
  EXPECT_EQ(through.share, 0);
}

// The first vertex of the face lies between walls that stand at 0.2 to each other.
TEST(ContactViolations, AVertexBetweenTwoWallsCountsForTheNearerToItsLaw) {
  Problem turned = *at_rest();
  const int first = contact_row(turned);
  const int vertex = turned.mesh.boundary[first].vertices[1];
  turned.contact_normals.resize(turned.mesh.boundary.size());
  for (int row = 0; row < static_cast<int>(turned.mesh.boundary.size()); ++row)
    for (int n = 1; n <= ContactNormals::max_parts; ++n)
      for (int i = 0; i <= n; ++i)
        turned.contact_normals[row].at(i, n) =
            Eigen::Vector2d(1, row == first ? 0.2 : -0.2).normalized();
  DisplacementField w = DisplacementField::Zero(2, displacement_nodes(turned));
  w.col(vertex) = Eigen::Vector2d(0, 1e-3);  // along both walls' mean: through one of them
  EXPECT_EQ(penetration(turned, w).at_nodes_mm, 0);
  EXPECT_EQ(penetration(turned, w).on_edges_mm, 0);
  w.col(vertex) = Eigen::Vector2d(1e-3, 0);
  EXPECT_NEAR(penetration(turned, w).at_nodes_mm, 1e-3 / std::hypot(1, 0.2), 1e-15);
}

// Without displacements of the mesh, the motion of what is prescribed goes through the wall whole.
TEST(ContactViolations, ARigidMotionThroughTheWallIsRelativeToItself) {
  const auto problem =
      testing::posed({.crown_radius_mm = std::nullopt, .displacement_mm = {0.02, 0}});
  const Penetration through =
      penetration(*problem, DisplacementField::Zero(2, displacement_nodes(*problem)));
  EXPECT_NEAR(through.on_edges_mm, 0.02, 1e-15);
  EXPECT_NEAR(through.share, 1, 1e-12);
}

TEST(ContactViolations, TensionAndFrictionBeyondItsBound) {
  ContactPoints points;
  points.count = 3;
  points.components = 2;
  points.friction = {0.2, 0.2, 0.5};
  Eigen::VectorXd F(6);
  F << -10, 2, 4, 0, -2, 1.5;
  const ForceViolations violations = force_violations(points, F);
  EXPECT_NEAR(violations.tension, 0.4, 1e-15);
  EXPECT_NEAR(violations.friction_excess, 0.05, 1e-15);
  F << -10, -2, 0, 0, -2, -1;
  EXPECT_EQ(force_violations(points, F).tension, 0);
  EXPECT_NEAR(force_violations(points, F).friction_excess, 0, 1e-15);
  EXPECT_EQ(force_violations(points, Eigen::VectorXd::Zero(6)).friction_excess, 0);
}

// A contact force too much of 3 N.
TEST(ContactViolations, UnbalancedForce) {
  const ContactSystem system = contact_system(testing::posed({}));
  for (const char* name : {"HYBRID", "P2"}) {
    SCOPED_TRACE(name);
    Solution solution = testing::answered_by(name, system);
    const auto verified = [&] { return verify(system, solution, nullptr); };
    EXPECT_LT(*verified().unbalanced_N, 1e-7);
    EXPECT_EQ(verified().penetration_mm.has_value(), std::string(name) == "P2");
    EXPECT_LT(*verified().tension, 1e-9);
    EXPECT_LT(*verified().friction_excess, 1e-9);
    solution.F_C(2) += 3;
    EXPECT_NEAR(*verified().unbalanced_N, 3, 1e-6);
  }
}

class OfPrograms : public ::testing::Test {
 protected:
  OfPrograms() { displacements().by_program.emplace(); }
  Displacements& displacements() { return std::get<Displacements>(answer_.unknowns); }
  const ContactSystem system_ = contact_system(testing::posed({}));
  Solution answer_ = testing::answered_by("P2", system_);
};

// Forces of 1e-6 N at open points, as a program's last digits leave them.
TEST_F(OfPrograms, StatesAreThoseOfTrialForces) {
  const Solution ours = testing::answered_by("P2", system_);
  const Verification expected = verify_displacement(system_, ours);
  ASSERT_GT(*expected.n_open, 0);
  answer_.F_C.array() += 1e-6;
  const Verification seen = verify_displacement(system_, answer_);
  EXPECT_EQ(seen.n_open, expected.n_open);
  EXPECT_EQ(seen.n_stick, expected.n_stick);
  EXPECT_EQ(seen.n_slip, expected.n_slip);
}

// All of its contact forces are left out: a weak law may have them at any node next to Γ_C.
TEST_F(OfPrograms, AWeakLawIsAskedForItsResultants) {
  const Verification right = verify_displacement(system_, answer_);
  answer_.F_C.setZero();
  EXPECT_GT(*verify_displacement(system_, answer_).equilibrium_residual, 1e-2);
  displacements().by_program->weak_contact = true;
  const Verification weak = verify_displacement(system_, answer_);
  EXPECT_LT(*weak.equilibrium_residual, 1e-10);
  EXPECT_NEAR(*weak.normal_resultant_N, *right.normal_resultant_N, 1e-6);
  EXPECT_NEAR(*weak.tangential_resultant_N, *right.tangential_resultant_N, 1e-6);
  EXPECT_FALSE(weak.tension || weak.friction_excess || weak.coulomb_violation_N);
  const PrescribedDisplacement prescribed = prescribed_displacement(*system_.problem);
  for (std::size_t node = 0; node < system_.problem->mesh.vertices.size(); ++node)
    if (!prescribed.at[node]) displacements().w(0, static_cast<Eigen::Index>(node)) += 1e-4;
  EXPECT_GT(*verify_displacement(system_, answer_).equilibrium_residual, 1e-2);
}

}  // namespace
}  // namespace airybench::contact_violations_test
