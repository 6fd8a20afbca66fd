// The whole discrete problem once more in 128 bits, with none of the iterations it is otherwise
// solved by: what are the errors of the reference and of HYBRID themselves?
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <filesystem>

#include "assembly/problem/scene.hpp"
#include "mesh/msh_format.hpp"
#include "solvers/condensation/hybridized.hpp"
#include "solvers/methods.hpp"
#include "tests/support/condensed_problem.hpp"
#include "tests/support/places.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/quad.hpp"
#include "tests/support/small_meshes.hpp"
#include "verify/verifier.hpp"

namespace airybench::extended_precision_test {
namespace {

using QuadVector = Eigen::VectorX<Quad>;
using QuadMatrix = Eigen::MatrixX<Quad>;

struct QuadSolution {
  QuadMatrix D;
  QuadVector G, F_C;
  StressField stress;
};

// With given states the law is a linear system: rows of D F − G − ḡ = 0, or a force that vanishes
// or follows the normal one (slip as `like` does). Whether the states are right is checked: the
// solution meets every clause of the law.
QuadVector solve_law(const QuadMatrix& D, const QuadVector& offset, const ContactPoints& contact,
                     const std::vector<ContactState>& states, const Eigen::VectorXd& like) {
  const int m = contact.components;
  QuadMatrix A = D;
  QuadVector b = offset;
  const auto replace = [&](int row) {
    A.row(row).setZero();
    A(row, row) = 1;
    b(row) = 0;
  };
  for (int p = 0; p < contact.count; ++p) {
    const int normal = m * p, tangential = normal + 1;
    if (states[p] == ContactState::open) replace(normal);
    if (m == 1 || states[p] == ContactState::stick) continue;
    replace(tangential);
    if (states[p] == ContactState::slip)
      A(tangential, normal) = (like(tangential) > 0 ? 1 : -1) * Quad(contact.friction_at(p));
  }
  const QuadVector F = A.partialPivLu().solve(b), r = D * F - offset;
  const Quad small = 1e-28, force = F.cwiseAbs().maxCoeff(), gap = offset.cwiseAbs().maxCoeff();
  for (int p = 0; p < contact.count; ++p) {
    const int normal = m * p, tangential = normal + 1;
    EXPECT_LE(F(normal), small * force) << p;
    EXPECT_LE(r(normal), small * gap) << p;
    EXPECT_LE(abs(F(normal) * r(normal)), small * force * gap) << p;
    if (m == 1) continue;
    EXPECT_LE(abs(F(tangential)), -Quad(contact.friction_at(p)) * F(normal) + small * force) << p;
    EXPECT_LE(F(tangential) * r(tangential), small * force * gap) << p;
    if (abs(r(tangential)) > small * gap) {
      EXPECT_GE(abs(F(tangential)), -Quad(contact.friction_at(p)) * F(normal) - small * force) << p;
    }
  }
  return F;
}

QuadSolution solve_in_quad(const ContactSystem& given, const Eigen::VectorXd& like) {
  const ContactPoints& contact = given.contact;
  const auto system = assemble_hybridized<Quad>(*given.problem, contact);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<Quad>, Eigen::Lower> factor(
      lower_triangle(system.K));
  EXPECT_EQ(factor.info(), Eigen::Success);
  QuadMatrix sides = QuadMatrix::Zero(system.b.size(), system.n_c);
  sides.bottomRows(system.n_c).setIdentity();
  const QuadMatrix X = factor.solve(sides);
  const QuadVector x = factor.solve(system.b);
  QuadSolution solution;
  solution.D = X.bottomRows(system.n_c);
  solution.G = -x.tail(system.n_c);
  QuadVector offset = solution.G;
  if (contact.gap.size() > 0) offset += contact.gap.cast<Quad>();
  solution.F_C = solve_law(solution.D, offset, contact, contact_states(contact, like), like);
  solution.stress = hybridized_stress(*given.problem, system, QuadVector(x + X * solution.F_C));
  return solution;
}

struct Errors {
  double force, stress;
};

Errors errors(const Problem& problem, const QuadSolution& exact, const Eigen::VectorXd& F_C,
              const StressField& stress) {
  const auto norm = [&](const QuadVector& F) { return sqrt(Quad(F.dot(exact.D * F))); };
  const QuadVector difference = F_C.cast<Quad>() - exact.F_C;
  return {static_cast<double>(norm(difference) / norm(exact.F_C)),
          stress_distance(problem, stress, exact.stress) /
              std::sqrt(stress_norm_squared(problem, exact.stress))};
}

struct Case {
  const char* name;
  Scene scene;
};

std::vector<Case> cases() {
  return {{"default", {}},
          {"frictionless", {.friction = 0}},
          {"body force", {.body_force_N_per_mm3 = {0.5, -2}}}};
}

class ExtendedPrecision : public ::testing::TestWithParam<int> {
 protected:
  const Mesh mesh_ = testing::catalogue_mesh("Mesh" + std::to_string(GetParam()));
};

TEST_P(ExtendedPrecision, ErrorsOfTheReferenceAndOfHybrid) {
  for (const Case& c : cases()) {
    if (GetParam() > 0 && c.scene.friction == 0) continue;  // 128 bits are computed in software
    SCOPED_TRACE(c.name);
    const auto problem = testing::posed(c.scene, mesh_);
    const ContactSystem system = contact_system(problem);
    const Reference reference = compute_reference(system);
    const QuadSolution exact = solve_in_quad(system, reference.F_C);

    const Errors of_reference = errors(*problem, exact, reference.F_C, reference.stress);
    EXPECT_LE(of_reference.force, 1e-15);
    EXPECT_LE(of_reference.stress, 1e-15);
    EXPECT_LE(std::max(of_reference.force, of_reference.stress),
              10 * reference.error_estimate + 1e-16);
    EXPECT_LE(reference.error_estimate, 1e-14);

    RunControl control;
    control.contact.tolerance = 1e-14;  // to rounding: the error is that of D, G and stress
    const Solution hybrid = run(select_methods("HYBRID").front(), system, control);
    const Errors of_hybrid = errors(*problem, exact, hybrid.F_C, hybrid.stress);
    const double of_D =
        static_cast<double>((reference.condensed.D.cast<Quad>() - exact.D).norm() / exact.D.norm());
    const contact::Problem in_double = testing::condensed(*problem, system.contact);
    const double of_hybrids_D =
        static_cast<double>((in_double.D.cast<Quad>() - exact.D).norm() / exact.D.norm());
    EXPECT_LE(of_D, 1e-12);
    EXPECT_LE(of_hybrids_D, 1e-12);
    EXPECT_LE(of_hybrid.force, 1e-12);
    EXPECT_LE(of_hybrid.stress, 1e-12);
  }
}

TEST_P(ExtendedPrecision, HybridStressesAreTheAiryFunctionsElementByElement) {
  const auto problem = testing::posed(Scene{}, mesh_);
  const AirySystem system = airy_system(problem);
  const Solution hybrid = run(select_methods("HYBRID").front(), system, {});
  const Solution airy = run(select_methods("3STEPD:CHOLMOD").front(), system, {});
  ASSERT_EQ(hybrid.status, Status::ok);
  ASSERT_EQ(airy.status, Status::ok);
  double largest = 0;
  for (std::size_t t = 0; t < hybrid.stress.size(); ++t)
    largest =
        std::max(largest, (hybrid.stress[t] - airy.stress[t]).norm() / hybrid.stress[t].norm());
  EXPECT_LE(largest, 1e-9);
}

TEST(ExtendedPrecision, ErrorOfTheReferenceOnBodiesWithAHole) {
  const Mesh pin = testing::with_role(testing::small_ring(12, 3, 2, 6), BoundaryRole::force,
                                      BoundaryRole::contact);
  for (const Mesh& mesh : {testing::small_plate(1), pin}) {
    SCOPED_TRACE(mesh.name);
    const ContactSystem system = contact_system(testing::posed({.crown_radius_mm = {}}, mesh));
    const Reference reference = compute_reference(system);
    const Errors off = errors(*system.problem, solve_in_quad(system, reference.F_C), reference.F_C,
                              reference.stress);
    EXPECT_LE(off.force, 1e-15);
    EXPECT_LE(off.stress, 1e-15);
  }
}

INSTANTIATE_TEST_SUITE_P(Mesh, ExtendedPrecision, ::testing::Range(0, 2));

}  // namespace
}  // namespace airybench::extended_precision_test
