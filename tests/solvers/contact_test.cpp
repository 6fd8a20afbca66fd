#include <gtest/gtest.h>

#include <random>

#include "solvers/contact/active_set.hpp"
#include "solvers/contact/admm.hpp"
#include "solvers/contact/anderson.hpp"
#include "solvers/contact/coulomb_law.hpp"
#include "solvers/contact/gauss_seidel.hpp"
#include "tests/support/dense_algebra.hpp"

namespace airybench::contact_test {
namespace {

// Every clause of the law, to a relative tolerance; scale_N and scale_mm make it dimensionless.
void expect_coulomb_law(const Eigen::Vector2d& F, const Eigen::Vector2d& r, double mu,
                        double scale_N, double scale_mm) {
  const double small_N = 1e-12 * scale_N, small_mm = 1e-12 * scale_mm;
  EXPECT_LE(F(0), small_N);
  EXPECT_LE(r(0), small_mm);
  EXPECT_LE(std::abs(F(0) * r(0)), 1e-12 * scale_N * scale_mm);
  EXPECT_LE(std::abs(F(1)), -mu * F(0) + small_N);
  EXPECT_LE(F(1) * r(1), 1e-12 * scale_N * scale_mm);
  if (std::abs(r(1)) > small_mm) {
    EXPECT_NEAR(std::abs(F(1)), -mu * F(0), small_N);
  }
}

TEST(CoulombLaw, IsMetExactlyByRandomPoints) {
  std::mt19937 generator(9);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int open = 0, stick = 0, slip = 0;
  for (int i = 0; i < 20000; ++i) {
    Eigen::Matrix2d root;
    root << uniform(generator), uniform(generator), uniform(generator), uniform(generator);
    const Eigen::Matrix2d D = root * root.transpose() + 0.05 * Eigen::Matrix2d::Identity();
    const Eigen::Vector2d b(uniform(generator), uniform(generator));
    const double mu = 0.5 * std::abs(uniform(generator));
    if (mu * std::abs(D(0, 1)) >= D(0, 0)) continue;  // not unique there
    const Eigen::Vector2d F = solve_coulomb_law(D, b, mu), r = D * F + b;
    expect_coulomb_law(F, r, mu, 50, 2);
    if (F.isZero(0))
      ++open;
    else if (r.norm() < 1e-12)
      ++stick;
    else
      ++slip;
  }
  EXPECT_GT(open, 100);
  EXPECT_GT(stick, 100);
  EXPECT_GT(slip, 100);
}

TEST(CoulombLaw, ProjectionClipsTheNormalForceFirst) {
  EXPECT_EQ(project_on_coulomb({5, 3}, 0.2), Eigen::Vector2d(0, 0));
  EXPECT_EQ(project_on_coulomb({-10, 3}, 0.2), Eigen::Vector2d(-10, 2));
  EXPECT_EQ(project_on_coulomb({-10, -3}, 0.2), Eigen::Vector2d(-10, -2));
  EXPECT_EQ(project_on_coulomb({-10, 1}, 0.2), Eigen::Vector2d(-10, 1));
}

TEST(SignoriniLaw, PressesOrOpens) {
  EXPECT_EQ(solve_signorini_law(2, 1), -0.5);
  EXPECT_EQ(solve_signorini_law(2, -1), 0);
}

ContactPoints points(int count, int components, double mu) {
  ContactPoints contact;
  contact.count = count;
  contact.components = components;
  contact.friction.assign(static_cast<std::size_t>(count), mu);
  contact.gap = Eigen::VectorXd::Zero(contact.size());
  for (int p = 0; p < count; ++p) {
    contact.gap(components * p) = 0.01;
    if (components == 2) contact.gap(2 * p + 1) = 0.002 * (p - 5);  // moved along the wall
  }
  return contact;
}

// With twelve points.
contact::Problem random_problem(int components, double mu, unsigned seed) {
  std::srand(seed);
  const int size = 12 * components;
  const Eigen::MatrixXd root = Eigen::MatrixXd::Random(size, size);
  return {root * root.transpose() + size * Eigen::MatrixXd::Identity(size, size),
          -size * Eigen::VectorXd::Random(size).cwiseAbs(), points(12, components, mu)};
}

TEST(GaussSeidel, MeetsTheLawAtEveryPoint) {
  const contact::Problem problem = random_problem(2, 0.3, 10);
  const ContactResult result = solve_contact_by_gauss_seidel(problem);
  ASSERT_TRUE(result.converged);
  EXPECT_LE(result.natural_map_residual, 1e-12);
  const Eigen::VectorXd r = problem.D * result.F_C - problem.G - problem.points.gap;
  for (int p = 0; p < 12; ++p)
    expect_coulomb_law(result.F_C.segment<2>(2 * p), r.segment<2>(2 * p), 0.3, 100, 100);
}

TEST(GaussSeidel, WithoutFrictionItIsTheComplementarityProblem) {
  const contact::Problem problem = random_problem(1, 0, 11);
  const ContactResult result = solve_contact_by_gauss_seidel(problem);
  ASSERT_TRUE(result.converged);
  const Eigen::VectorXd r = problem.D * result.F_C - problem.G - problem.points.gap;
  EXPECT_LE(result.F_C.maxCoeff(), 0);
  EXPECT_LE(r.maxCoeff(), 1e-10);
  EXPECT_LE((result.F_C.cwiseProduct(r)).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(GaussSeidel, NothingTouchesAndZeroForcesConverge) {
  contact::Problem problem = random_problem(2, 0.3, 12);
  problem.G.setConstant(1);  // displacements −1: away from the wall
  const ContactResult result = solve_contact_by_gauss_seidel(problem);
  EXPECT_TRUE(result.converged);
  EXPECT_TRUE(result.F_C.isZero(0));
}

TEST(GaussSeidel, KeepsAHistoryOnRequest) {
  const contact::Problem problem = random_problem(2, 0.3, 14);
  const ContactResult result = solve_contact_by_gauss_seidel(problem, {.history = true});
  EXPECT_EQ(result.history.size(), static_cast<std::size_t>(result.iterations));
  EXPECT_LE(result.history.back(), ContactOptions().tolerance);
  EXPECT_TRUE(solve_contact_by_gauss_seidel(problem).history.empty());
}

// A compliance like that of a thin layer between long waves: sweeps carry little from end to end.
contact::Problem stiff_problem(int components) {
  const int count = 40, size = count * components;
  Eigen::MatrixXd D = 1e-4 * Eigen::MatrixXd::Identity(size, size);
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j)
      if (i % components == j % components)
        D(i, j) += std::min(i, j) / components + 1 + (i % components);
  Eigen::VectorXd G(size);
  for (int i = 0; i < size; ++i) G(i) = i % components == 0 ? -1 - 0.01 * i : 0.3 - 0.02 * i;
  return {D, G, points(count, components, components == 2 ? 0.3 : 0)};
}

TEST(ActiveSet, FinishesWhereSweepsAreSlow) {
  for (const int components : {1, 2}) {
    const contact::Problem problem = stiff_problem(components);
    ContactResult result = solve_contact_by_gauss_seidel(problem, {.max_iterations = 300});
    ASSERT_FALSE(result.converged) << components;
    finish_by_active_set(problem, {}, {}, result);
    EXPECT_TRUE(result.converged) << components;
    EXPECT_LE(result.natural_map_residual, ContactOptions().tolerance);
    EXPECT_GT(result.active_set_steps, 0);
    if (components == 1) continue;
    const Eigen::VectorXd r = problem.D * result.F_C - problem.G - problem.points.gap;
    for (int p = 0; p < problem.points.count; ++p)
      expect_coulomb_law(result.F_C.segment<2>(2 * p), r.segment<2>(2 * p), 0.3, 100, 100);
  }
}

TEST(ActiveSet, AStepFromTheSolutionStaysThere) {
  const contact::Problem problem = random_problem(2, 0.3, 17);
  const Eigen::VectorXd F = solve_contact_by_gauss_seidel(problem).F_C;
  const Eigen::VectorXd r = problem.D * F - problem.G - problem.points.gap;
  EXPECT_LT(testing::distance(active_set_step(problem.D, problem.points, F, r), F),
            1e-11 * F.norm());
}

TEST(Anderson, NeedsFewerThanTheSweeps) {
  for (const int components : {1, 2}) {
    const contact::Problem problem = stiff_problem(components);
    const ContactResult sweeps = solve_contact_by_gauss_seidel(problem);
    const ContactResult result = solve_contact_by_anderson(problem);
    ASSERT_TRUE(sweeps.converged && result.converged) << components;
    EXPECT_LT(2 * result.iterations, sweeps.iterations);
    EXPECT_LT(testing::distance(result.F_C, sweeps.F_C), 1e-8 * sweeps.F_C.norm());
  }
}

// Whatever the unit of D, the weights follow.
TEST(Admm, DoesNotDependOnTheUnits) {
  contact::Problem problem = random_problem(2, 0.3, 20);
  const int iterations = solve_contact_by_admm(problem).iterations;
  problem.D *= 0x1p-40;
  problem.G *= 0x1p-40;
  problem.points.gap *= 0x1p-40;
  EXPECT_EQ(solve_contact_by_admm(problem).iterations, iterations);
}

TEST(ContactSolvers, HaveTheSolutionOfTheSweeps) {
  for (const int components : {1, 2}) {
    const contact::Problem problem = random_problem(components, components == 2 ? 0.3 : 0, 19);
    const Eigen::VectorXd F = solve_contact_by_gauss_seidel(problem).F_C;
    for (const auto& [solver, sweeps, off] : {std::tuple(ContactSolver::newton, 1, 1e-11),
                                              {ContactSolver::anderson, 1000, 1e-9},
                                              {ContactSolver::admm, 1000, 1e-9}}) {
      const ContactResult result =
          solve_contact(problem, {.solver = solver, .max_iterations = sweeps});
      EXPECT_TRUE(result.converged) << name_of(solver) << components;
      EXPECT_LT(testing::distance(result.F_C, F), off * F.norm()) << name_of(solver) << components;
    }
  }
}

TEST(ContactSolvers, TooFewIterationsOrNaNIsNotConverged) {
  contact::Problem problem = random_problem(2, 0.3, 21);
  contact::Problem poisoned = problem;
  poisoned.G(3) = std::nan("");
  for (const ContactSolver solver : all_contact_solvers) {
    ContactOptions options = {.solver = solver};
    EXPECT_TRUE(solve_contact(problem, options).converged) << name_of(solver);
    const ContactResult of_nan = solve_contact(poisoned, options);
    EXPECT_FALSE(of_nan.converged) << name_of(solver);
    EXPECT_EQ(of_nan.F_C.size(), problem.points.size()) << name_of(solver);
    options.max_iterations = 0;
    EXPECT_FALSE(solve_contact(poisoned, options).converged) << name_of(solver);
    options = {.solver = solver, .tolerance = -1};
    EXPECT_THROW(solve_contact(problem, options, Deadline::after(-1)), TimeoutReached)
        << name_of(solver);
  }
}

// What presses is only the rounding of displacements and gap: errors relative to it would never
// become small.
TEST(ContactSolvers, EndWhereBodiesJustTouch) {
  contact::Problem problem = random_problem(2, 0.3, 16);
  problem.points.gap = -problem.G + 1e-13 * problem.G.norm() * Eigen::VectorXd::Random(24);
  for (const ContactSolver solver : all_contact_solvers) {
    ContactOptions options;
    options.solver = solver;
    const ContactResult result = solve_contact(problem, options);
    EXPECT_TRUE(result.converged) << name_of(solver);
    EXPECT_LE(result.iterations, 100) << name_of(solver);
    EXPECT_LE(result.F_C.norm(), 1e-11 * undoing_force_N(problem)) << name_of(solver);
  }
}

TEST(NaturalMap, IsZeroExactlyWhereTheLawHolds) {
  const ContactPoints contact = points(2, 2, 0.5);
  const Eigen::VectorXd diagonal = Eigen::VectorXd::Constant(4, 2.0);
  // Point 1 sticks under −10, 2; point 2 is open, 0.3 away. ū_C = r + gap.
  const Eigen::Vector4d F(-10, 2, 0, 0), r(0, 0, -0.3, 0.4), u = r + contact.gap;
  EXPECT_LT(natural_map(contact, diagonal, F, u).norm(), 1e-14);
  const Eigen::Vector4d penetrating = u + Eigen::Vector4d(0.2, 0, 0, 0);
  EXPECT_NEAR(natural_map(contact, diagonal, F, penetrating)(0), 0.1, 1e-14);  // r_n / D_nn
  const Eigen::Vector4d pulling(1, 0, 0, 0);
  EXPECT_GT(natural_map(contact, diagonal, pulling, u).norm(), 0.9);
}

}  // namespace
}  // namespace airybench::contact_test
