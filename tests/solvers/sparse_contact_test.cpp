// Contact problems of many rigid bodies: D by rows, and D that is not formed, against the dense
// one.
#include <gtest/gtest.h>

#include "solvers/condensation/global_problem.hpp"
#include "solvers/contact/active_set.hpp"
#include "solvers/contact/compliance.hpp"
#include "solvers/contact/coulomb_law.hpp"
#include "solvers/contact/proximal_points.hpp"
#include "tests/support/packings.hpp"

namespace airybench::sparse_contact_test {
namespace {

using testing::Packed;
using testing::Packing;
using testing::packing;

constexpr CondensationLimit nothing = {.entries = 0, .times = 0};

contact::Problem condensed(const Packing& of, const CondensationLimit& limit = {}) {
  contact::Problem problem = condense_global(of.M, of.H, of.f, of.w, limit);
  problem.points = of.points;
  return problem;
}

contact::Problem dense(contact::Problem problem) {
  problem.D = problem.rows;
  problem.rows.resize(0, 0);
  return problem;
}
contact::Problem dense(const Packing& of) { return dense(of.problem()); }

ContactResult iterated(const contact::Problem& problem, ContactSolver solver, int times) {
  return solve_contact(problem, {.solver = solver, .max_iterations = times});
}

class PackingTest : public ::testing::TestWithParam<std::tuple<Packed, int>> {
 protected:
  const int components_ = std::get<1>(GetParam());
  const Packing packed_ = packing(std::get<0>(GetParam()), components_, 320, 1);
};

TEST_P(PackingTest, HasTheChosenAnswer) {
  const contact::Problem problem = packed_.problem();
  EXPECT_GE(problem.points.count, 320);
  if (packed_.F.size() == 0) return;  // none is chosen
  EXPECT_LT(relative_natural_map(problem, packed_.F), 1e-14);
  EXPECT_GT(relative_natural_map(problem, 1.01 * packed_.F), 1e-4);
  const Packing other = packing(std::get<0>(GetParam()), components_, 320, 2);
  EXPECT_NE(other.points.friction, packed_.points.friction);
}

TEST_P(PackingTest, IsCondensedByBodies) {
  const contact::Problem expected = packed_.problem(), problem = condensed(packed_);
  EXPECT_EQ(problem.how, "condensed, sparse");
  EXPECT_EQ(problem.rows.nonZeros(), expected.rows.nonZeros());
  EXPECT_LT((problem.rows - expected.rows).norm(), 1e-13 * expected.rows.norm());
  EXPECT_LT((problem.G - expected.G).norm(), 1e-13 * expected.G.norm());
}

// Whatever form D has, an iteration is the same but for rounding.
TEST_P(PackingTest, EveryFormGivesTheSame) {
  const contact::Problem by_rows = packed_.problem(), whole = dense(packed_),
                         unformed = condensed(packed_, nothing);
  EXPECT_EQ(unformed.how, "not formed");
  const Eigen::VectorXd F =
      project_on_coulomb(packed_.points, -Eigen::VectorXd::LinSpaced(packed_.points.size(), 1, 2));
  const Eigen::VectorXd DF = D_times(whole, F);
  for (const contact::Problem* other : {&by_rows, &unformed}) {
    EXPECT_LT((D_times(*other, F) - DF).norm(), 1e-12 * DF.norm());
    EXPECT_LT((D_diagonal(*other) - D_diagonal(whole)).norm(), 1e-12 * D_diagonal(whole).norm());
    const auto expect_same = [&](ContactSolver solver) {
      const Eigen::VectorXd expected = iterated(whole, solver, 3).F_C;
      EXPECT_LT((iterated(*other, solver, 3).F_C - expected).norm(), 1e-9 * expected.norm())
          << name_of(solver);
    };
    expect_same(ContactSolver::admm);
    if (!other->bodies) expect_same(ContactSolver::gauss_seidel);
  }
  EXPECT_LT((D_of_point(by_rows, 3) - D_of_point(whole, 3)).norm(), 1e-15);
}

// From a swept start, where it changes what is open, sticks and slips. D is singular: of the many
// changes of F the displacements count.
TEST_P(PackingTest, AStepOfTheActiveSetsIsTheSame) {
  const contact::Problem by_rows = packed_.problem(), unformed = condensed(packed_, nothing);
  const Eigen::VectorXd F = iterated(by_rows, ContactSolver::gauss_seidel, 30).F_C;
  const Eigen::VectorXd r = D_times(by_rows, F) - by_rows.G;
  const Eigen::VectorXd expected = D_times(by_rows, active_set_step(by_rows, F, r)),
                        other = D_times(by_rows, active_set_step(unformed, F, r));
  EXPECT_GT((expected - D_times(by_rows, F)).norm(), 1e-3 * expected.norm());
  EXPECT_LT((other - expected).norm(), 1e-4 * expected.norm());
}

INSTANTIATE_TEST_SUITE_P(All, PackingTest,
                         ::testing::Combine(::testing::Values(Packed::brick_wall,
                                                              Packed::periodic_box, Packed::flow),
                                            ::testing::Values(2, 3)));

TEST(SparseContact, NewtonSolvesHyperstaticWalls) {
  for (const int components : {2, 3}) {
    const Packing wall = packing(Packed::brick_wall, components, 120, 3);
    EXPECT_GT(wall.points.size(), wall.M.rows());  // W is singular
    for (const contact::Problem& problem : {wall.problem(), condensed(wall, nothing)}) {
      const ContactResult result = iterated(problem, ContactSolver::newton, 2000);
      EXPECT_TRUE(result.converged) << components << " " << result.natural_map_residual;
      EXPECT_LT(relative_natural_map(dense(wall), result.F_C), 1e-11);
    }
  }
}

// From ten sweeps, where active sets alone do not end.
ContactResult finished_by_points_alone(const contact::Problem& problem) {
  ContactResult result = iterated(problem, ContactSolver::gauss_seidel, 10);
  finish_by_active_set(problem, {}, {}, result);
  EXPECT_FALSE(result.converged) << problem.points.count;
  const double before = result.natural_map_residual;
  finish_by_proximal_points(problem, {}, {}, result);
  EXPECT_TRUE(result.converged) << problem.points.count << ": " << before;
  return result;
}

TEST(SparseContact, ProximalPointsSolveWhatActiveSetsAloneDoNot) {
  for (const auto& [shape, contacts, seed] : {std::tuple(Packed::brick_wall, 500, 1),
                                              {Packed::periodic_box, 500, 1},
                                              {Packed::flow, 300, 1}}) {
    const contact::Problem problem = packing(shape, 2, contacts, seed).problem();
    const ContactResult result = finished_by_points_alone(problem);
    EXPECT_LT(relative_natural_map(dense(problem), result.F_C), 1e-11);
  }
}

TEST(SparseContact, ProximalPointsTakeADenseD) {
  for (const int components : {2, 3}) {
    const contact::Problem whole = dense(packing(Packed::flow, components, 60, 1));
    ContactResult result = iterated(whole, ContactSolver::gauss_seidel, 10);
    EXPECT_FALSE(result.converged);
    finish_by_proximal_points(whole, {}, {}, result);
    EXPECT_TRUE(result.converged) << components << ": " << result.natural_map_residual;
    EXPECT_LT(relative_natural_map(whole, result.F_C), 1e-11);
  }
}

// Where both solve it: points take tens of steps, each a factor of a full matrix.
TEST(SparseContact, ADenseDIsSweptAgainBeforeProximalPoints) {
  for (const int seed : {2, 3}) {
    const contact::Problem whole = dense(packing(Packed::periodic_box, 2, 120, seed));
    finished_by_points_alone(whole);
    const ContactResult newton = solve_contact_by_newton(whole);
    EXPECT_TRUE(newton.converged) << seed;
    EXPECT_GT(newton.iterations, 10) << seed;
    const ContactResult without_more = iterated(whole, ContactSolver::newton, 10);
    EXPECT_TRUE(without_more.converged) << seed;
    EXPECT_EQ(without_more.iterations, 10) << seed;
  }
}

TEST(SparseContact, SweepsSayThatTheyNeedTheRows) {
  const contact::Problem problem = condensed(packing(Packed::periodic_box, 2, 40, 1), nothing);
  for (const ContactSolver solver : {ContactSolver::gauss_seidel, ContactSolver::anderson})
    EXPECT_THROW(solve_contact(problem, {.solver = solver}), Breakdown);
}

TEST(SparseContact, IsHeldSparseByItsEntries) {
  EXPECT_FALSE(held_sparse(300, 0));
  EXPECT_TRUE(held_sparse(301, 301));
  EXPECT_FALSE(held_sparse(1000, 125'000));
  EXPECT_TRUE(held_sparse(100'000, 1'000'000'000));
}

}  // namespace
}  // namespace airybench::sparse_contact_test
