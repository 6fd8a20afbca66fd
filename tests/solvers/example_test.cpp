// The examples of docs/adding-a-method.md do what they say.
#include <gtest/gtest.h>

#include "solvers/preconditioners/preconditioner.hpp"
#include "tests/support/places.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/solved.hpp"

// Under other names than those of copies in solvers/, which who follows the document makes.
#define three_step_simplicial example_of_a_method
#define jacobi_kind example_of_a_preconditioner
#include "tests/solvers/example/jacobi.cpp"
#include "tests/solvers/example/three_step_simplicial.cpp"
#undef three_step_simplicial
#undef jacobi_kind

namespace airybench::example_test {
namespace {

TEST(Example, TheMethodHasTheAnswerOfHybrid) {
  const AirySystem system = testing::system_of({}, testing::catalogue_mesh("Mesh0"));
  const Solution solution = run(example_of_a_method(), system, {});
  ASSERT_EQ(solution.status, Status::ok) << solution.message;
  const Solution other = testing::solved_by("HYBRID", system);
  EXPECT_LE(testing::force_error(solution, other), 1e-8);
  EXPECT_LE(testing::stress_error(*system.problem, solution, other), 1e-8);
  for (const Stage stage : example_of_a_method().stages) EXPECT_TRUE(solution.times[stage]);
  EXPECT_EQ(run(example_of_a_method(), system, testing::out_of_time()).status, Status::timeout);
}

TEST(Example, ThePreconditionerDividesByTheDiagonal) {
  SparseColumns S(3, 3);
  S.insert(0, 0) = 2;
  S.insert(1, 0) = 1;
  S.insert(1, 1) = 4;
  S.insert(2, 2) = 8;
  LaneBlock X = LaneBlock::Ones(3, 1);
  example_of_a_preconditioner().make(S, 0, {}).applier(1)(X);
  EXPECT_EQ(X, Eigen::Vector3d(0.5, 0.25, 0.125));
  S.coeffRef(2, 2) = 0;
  EXPECT_THROW(example_of_a_preconditioner().make(S, 0, {}), Breakdown);
}

}  // namespace
}  // namespace airybench::example_test
