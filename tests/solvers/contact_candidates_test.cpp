// With contact formed at candidates alone the answer is that of all contact points.
#include "solvers/contact/contact_candidates.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "solvers/loading/load_steps.hpp"
#include "solvers/methods.hpp"
#include "tests/support/dense_algebra.hpp"
#include "tests/support/method_names.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/two_blocks.hpp"

namespace airybench::contact_candidates_test {
namespace {

using testing::posed;

class ContactCandidates : public ::testing::TestWithParam<Method> {
 protected:
  // The method, and the number of contact unknowns of each of its solves.
  Solve counted() {
    return [this](const ContactSystem& system, const RunControl& control) {
      sizes_.push_back(system.n_c());
      return GetParam().solve(system, control);
    };
  }
  static RunControl control() {
    RunControl tight;
    tight.tolerance = 1e-12;
    return tight;
  }
  static void expect_equal(const ContactSystem& system, const Solution& found,
                           const Solution& all) {
    ASSERT_EQ(found.status, Status::ok) << found.message;
    ASSERT_EQ(all.status, Status::ok) << all.message;
    EXPECT_LT(testing::distance(found.F_C, all.F_C), 1e-8 * all.F_C.norm());
    EXPECT_LT(testing::distance(found.contact_displacement, all.contact_displacement),
              1e-8 * all.contact_displacement.norm());
    EXPECT_EQ(found.F_C.size(), system.n_c());
    EXPECT_EQ(found.free_motion_mm.size(), all.free_motion_mm.size());
  }

  std::vector<int> sizes_;
};
INSTANTIATE_TEST_SUITE_P(Methods, ContactCandidates,
                         ::testing::ValuesIn(select_methods(testing::hybrid_of_every_degree() +
                                                            ",HYBRID:CHOLMOD,HYBRID:CG")),
                         testing::readable);

// The first closed edge alone.
std::vector<bool> first_closed_edge(const ContactSystem& system, const Solution& answer) {
  std::vector<bool> rows(system.problem->mesh.boundary.size(), false);
  const ContactPoints& contact = system.contact;
  for (int p = 0; p < contact.count; ++p)
    if (answer.F_C(contact.components * p) < 0) {
      rows[contact.boundary[p]] = true;
      break;
    }
  return rows;
}

// The block's head is moved so much at its ends.
LinearValue<Eigen::Vector2d> tilted_head(double left_mm, double right_mm) {
  return {{Eigen::Vector2d(0.002, left_mm), Eigen::Vector2d(0.002, right_mm)},
          {Eigen::Vector2d(0, 5), Eigen::Vector2d(12, 5)}};
}

struct Named {
  const char* name;
  std::shared_ptr<const Problem> problem;
};
std::vector<Named> problems() {
  Scene smooth;
  smooth.friction = 0;
  Scene rolling = testing::pressed(0.3);  // contact alone holds the block's motion along x
  rolling.boundary["displacement:head"].support = BoundaryValues::Support::normal;
  Scene tilted = testing::pressed(0.2);
  tilted.boundary["displacement:head"].displacement_mm = tilted_head(-0.02, 0.01);
  const Mesh blocks = testing::two_blocks(8, 8);
  return {{"tooth", posed({})},
          {"tooth without friction", posed(smooth)},
          {"blocks, tilted", posed(tilted, blocks)},
          {"blocks, one on rollers", posed(rolling, blocks)}};
}

TEST_P(ContactCandidates, GrowUntilNoOtherEdgeTouches) {
  for (const auto& [name, problem] : problems()) {
    SCOPED_TRACE(name);
    if (!problem->opposite.empty() && !GetParam().joins_bodies) continue;
    sizes_.clear();
    ContactSystem system = contact_system(problem, GetParam().degree);
    const Solution all = solve_load_case(GetParam().solve, system, control());
    ASSERT_EQ(all.status, Status::ok) << all.message;
    const std::vector<bool> few = first_closed_edge(system, all);
    ContactSystem again = contact_system(problem, GetParam().degree);
    const Solution found =
        solve_load_case(on_candidates(counted(), *problem, few), again, control());
    expect_equal(again, found, all);
    ASSERT_GT(sizes_.size(), 1u);
    EXPECT_TRUE(std::ranges::is_sorted(sizes_));
    EXPECT_LT(sizes_.front(), again.n_c() / 2);
  }
}

// From the closed edges of a coarse mesh one solve is enough, of fewer points.
TEST_P(ContactCandidates, OfACoarserMeshTakeOneSolve) {
  if (!GetParam().joins_bodies) GTEST_SKIP() << "it knows walls only";
  Scene tilted = testing::pressed(0.2);
  tilted.boundary["displacement:head"].displacement_mm = tilted_head(-0.02, 0.01);
  ContactSystem coarse =
      contact_system(posed(tilted, testing::two_blocks(12, 12)), GetParam().degree);
  ClosedEdges closed;
  closed.add(coarse, solve_load_case(GetParam().solve, coarse, control()));
  ContactSystem fine =
      contact_system(posed(tilted, testing::two_blocks(24, 24)), GetParam().degree);
  const Solution all = solve_load_case(GetParam().solve, fine, control());
  const Solve some = on_candidates(counted(), *fine.problem, closed.candidates(fine.problem->mesh));
  expect_equal(fine, solve_load_case(some, fine, control()), all);
  ASSERT_EQ(sizes_.size(), 1u);
  EXPECT_LT(sizes_.front(), fine.n_c());
}

// The block rocks from one end to the other: the body is condensed again where it touches anew.
TEST_P(ContactCandidates, FollowAPath) {
  if (!GetParam().joins_bodies) GTEST_SKIP() << "it knows walls only";
  const auto tilt = [](double left, double right) {
    Scene scene = testing::pressed(0.2);
    scene.boundary["displacement:head"].displacement_mm = tilted_head(left, right);
    return scene;
  };
  const Mesh mesh = testing::two_blocks(8, 8);
  Problem path = *posed(tilt(-0.02, 0.01), mesh);
  for (const Scene& scene : {tilt(-0.02, 0.009), tilt(0.01, -0.02), tilt(0.009, -0.02)})
    path.later_steps.push_back(posed(scene, mesh)->loads);
  const auto first = std::make_shared<const Problem>(path);
  std::vector<Solution> all;
  ContactSystem system = contact_system(first, GetParam().degree);
  solve_load_steps(GetParam().solve, system, control(),
                   [&](int, const ContactSystem&, const Solution& s) { all.push_back(s); });
  ASSERT_EQ(all.size(), 4u);
  ContactSystem again = contact_system(first, GetParam().degree);
  ContactSystem of_first = contact_system(first, GetParam().degree);
  const Solve some = on_candidates(counted(), *first, first_closed_edge(of_first, all.front()));
  int steps = 0;
  solve_load_steps(some, again, control(),
                   [&](int step, const ContactSystem& posed, const Solution& s) {
                     SCOPED_TRACE(step);
                     expect_equal(posed, s, all[static_cast<std::size_t>(step)]);
                     ++steps;
                   });
  EXPECT_EQ(steps, 4);
}

TEST(ContactPointsAtRows, KeepPairsGapsAndFriction) {
  const ContactSystem system =
      contact_system(posed(testing::pressed(0.2), testing::two_blocks(4, 4)), 2);
  const ContactPoints& all = system.contact;
  std::vector<bool> rows(system.problem->mesh.boundary.size(), false);
  const int row = all.boundary[all.per_edge];
  rows[row] = rows[system.problem->opposite_of(row)] = true;
  const ContactPoints few = at_rows(all, rows);
  ASSERT_EQ(few.count, 2 * all.per_edge);
  for (int p = 0; p < few.count; ++p) {
    EXPECT_TRUE(rows[few.boundary[p]]);
    ASSERT_NE(few.opposite_of(p), ContactPoints::no_point);
    EXPECT_EQ(few.opposite_of(few.opposite_of(p)), p);
    EXPECT_NE(few.boundary[few.opposite_of(p)], few.boundary[p]);
    EXPECT_EQ(few.friction_at(p), 0.2);
  }
  EXPECT_EQ(few.gap.size(), all.gap.size() > 0 ? few.size() : 0);
}

}  // namespace
}  // namespace airybench::contact_candidates_test
