// How much memory sparse contact problems take, against their file: 12 bytes an entry of W, and its
// vectors.
#include <gtest/gtest.h>

#include <functional>

#include "bench/measure/heap_probe.hpp"
#include "solvers/condensation/global_problem.hpp"
#include "solvers/contact/active_set.hpp"
#include "solvers/contact/admm.hpp"
#include "solvers/contact/gauss_seidel.hpp"
#include "solvers/contact/weighted_compliance.hpp"
#include "tests/support/packings.hpp"

namespace airybench::sparse_memory_test {
namespace {

using testing::Packed;

class SparseMemory : public ::testing::TestWithParam<std::tuple<Packed, int, int>> {};

// 20 000 contacts in the plane, 7 000 in space.
TEST_P(SparseMemory, IsTenTimesTheFileAtMost) {
  const auto [shape, components, contacts] = GetParam();
  const contact::Problem problem = testing::packing(shape, components, contacts, 1).problem();
  const auto file_bytes = 12 * problem.rows.nonZeros() + 8 * problem.G.size();
  const auto max_of = [&](const std::function<void()>& work) {
    const std::int64_t before = heap::live_bytes();
    heap::reset_peak();
    work();
    return heap::peak_bytes() - before + static_cast<std::int64_t>(problem.bytes());
  };
  Eigen::VectorXd F;
  EXPECT_LT(max_of([&] { F = solve_contact_by_gauss_seidel(problem, {.max_iterations = 3}).F_C; }),
            2 * file_bytes);
  EXPECT_LT(max_of([&] { active_set_step(problem, F, problem.rows * F - problem.G); }),
            10 * file_bytes);
  EXPECT_LT(max_of([&] { solve_contact_by_admm(problem, {.max_iterations = 3}); }),
            10 * file_bytes);
}

INSTANTIATE_TEST_SUITE_P(Of, SparseMemory,
                         ::testing::Values(std::tuple(Packed::brick_wall, 2, 20'000),
                                           std::tuple(Packed::periodic_box, 2, 20'000),
                                           std::tuple(Packed::brick_wall, 3, 7'000),
                                           std::tuple(Packed::periodic_box, 3, 7'000)));

// 3612 unknowns of finite elements, 602 contacts.
TEST(UnformedMemory, FiniteElementsAreSolvedWithoutRoomForW) {
  const testing::Packing strip = testing::elastic_strip(300, 1);
  const std::int64_t n_c = strip.points.size(), bytes_of_W = 8 * n_c * n_c;
  const std::int64_t of_input = 12 * (strip.M.nonZeros() + strip.H.nonZeros());
  ASSERT_GT(bytes_of_W, 20 * of_input);
  for (const ContactSolver solver : {ContactSolver::newton, ContactSolver::admm}) {
    SCOPED_TRACE(name_of(solver));
    const std::int64_t before = heap::live_bytes();
    heap::reset_peak();
    contact::Problem problem =
        condense_global(strip.M, strip.H, strip.f, strip.w, {.entries = 0, .times = 5});
    problem.points = strip.points;
    ASSERT_EQ(problem.how, "not formed");
    const ContactResult result = solve_contact(problem, {.solver = solver});
    EXPECT_LT(heap::peak_bytes() - before, bytes_of_W);
    EXPECT_TRUE(result.converged) << result.natural_map_residual;
    EXPECT_LT((result.F_C - strip.F).norm(), 1e-9 * strip.F.norm());
  }
}

TEST(SparseAllocations, NoneInsideASweep) {
  for (const int components : {2, 3}) {
    const contact::Problem problem =
        testing::packing(Packed::periodic_box, components, 200, 1).problem();
    const auto allocations = [&](int sweeps) {
      const std::int64_t before = heap::allocations();
      solve_contact_by_gauss_seidel(problem, {.tolerance = 0, .max_iterations = sweeps});
      return heap::allocations() - before;
    };
    EXPECT_EQ(allocations(3), allocations(30)) << components;
  }
}

}  // namespace
}  // namespace airybench::sparse_memory_test
