// P2, P3 and P4 follow curved sides: closed forms, with the order p of their stresses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "assembly/control_points.hpp"
#include "assembly/nodal_forces.hpp"
#include "solvers/loading/load_steps.hpp"
#include "tests/bench/measure/examined.hpp"
#include "tests/verify/round_bodies.hpp"
#include "tests/verify/solved_body.hpp"
#include "verify/verifier.hpp"

namespace airybench::round_displacements_test {
namespace {

using testing::ExactStress, testing::pressed, testing::quarter, testing::Rim,
    testing::RingInASocket, testing::stretched, testing::true_error;
using Point = Eigen::Vector2d;

class RoundDisplacements : public ::testing::TestWithParam<int> {
 protected:
  const int p = GetParam();

  struct Answer {
    ContactSystem system;
    Solution solution;
  };
  Answer solved(Problem problem) const {
    Answer answer{contact_system(std::make_shared<const Problem>(std::move(problem)), p - 1), {}};
    answer.solution = testing::answered_by(displacements_of_degree(p), answer.system);
    return answer;
  }
  // As the judge has it: to stresses that follow the curves, too.
  double total_error(const Answer& answer) const {
    const int degree = std::max(2, p - 1);
    const Problem& problem = *answer.system.problem;
    const testing::Solved stresses(problem, degree);
    const ConstitutiveError error = stresses.error_with(admissible_displacement(
        stresses.system, stresses.hybrid.F_C,
        elevated(problem, testing::displacement(answer.solution), degree + 1)));
    EXPECT_EQ(error.flaw, "");
    return error.relative;
  }
  // On two meshes.
  void expect_order(const ExactStress& exact, double outer_mm, int across, double poisson,
                    Rim rim = Rim::loaded) const {
    SCOPED_TRACE(::testing::Message() << "Poisson " << poisson);
    std::vector<double> truth;
    for (const int finer : {1, 2}) {
      const Answer answer =
          solved(quarter(4 * finer, across * finer, outer_mm, exact, poisson, rim));
      truth.push_back(true_error(*answer.system.problem, answer.solution.stress, exact));
      const double total = total_error(answer);
      EXPECT_GT(total, truth.back());
      EXPECT_LT(total, testing::most_overestimated(poisson, rim) * truth.back());
      EXPECT_LT(*verify(answer.system, answer.solution, nullptr).equilibrium_residual,
                poisson < 0.4 ? 1e-12 : 1e-9);
    }
    // Near incompressibility elements of degree 2 and 3 lose up to an order, on straight sides,
    // too.
    const double lost = poisson > 0.4 && p < 4 ? 1 : 0.3;
    EXPECT_GT(std::log2(truth[0] / truth[1]), p - lost);
  }
};
INSTANTIATE_TEST_SUITE_P(Degrees, RoundDisplacements, ::testing::Values(2, 3, 4),
                         [](const auto& test) { return "P" + std::to_string(test.param); });

TEST_P(RoundDisplacements, OfRingsUnderPressureAreOfFullOrder) {
  testing::for_pressed_rings([&](const auto&... ring) { expect_order(ring...); });
}

TEST_P(RoundDisplacements, OfAHoleUnderTensionAreOfFullOrder) {
  expect_order(stretched, 4, 4, 0.3);
  expect_order(stretched, 4, 4, 0.4999);
}

TEST_P(RoundDisplacements, OfARingInASocketAreOfFullOrder) {
  for (const double friction : {0., 0.2}) {
    SCOPED_TRACE(::testing::Message() << "friction " << friction);
    std::vector<double> truth, of_force;
    for (const int around : {4, 8}) {
      const Answer answer =
          solved(pose(RingInASocket::scene(friction), RingInASocket::mesh(around)));
      const Verification v = verify(answer.system, answer.solution, nullptr);
      EXPECT_LT(*v.equilibrium_residual, 1e-11);
      EXPECT_LT(*v.natural_map_residual, 1e-11);
      EXPECT_LT(*v.penetration_mm, 1e-12);
      truth.push_back(
          true_error(*answer.system.problem, answer.solution.stress, RingInASocket::exact));
      of_force.push_back(
          std::abs(*v.normal_resultant_N / (std::numbers::pi * RingInASocket::pressure) + 1));
      const double total = total_error(answer);
      EXPECT_GT(total, truth.back());
      EXPECT_LT(total, 2.5 * truth.back());
    }
    EXPECT_GT(std::log2(truth[0] / truth[1]), p - 0.3);
    EXPECT_LT(of_force[1], of_force[0] / 8);
  }
}

// The loads are those of the round body: ∫ b over its area, ∫ p n along its hole.
TEST_P(RoundDisplacements, HaveTheLoadsOfTheCurves) {
  Problem problem = quarter(4, 2, 2, pressed, 0.3);
  const auto on_hole = [](const Point& x) { return x.norm() < 1.5; };
  problem.loads.traction_MPa = [&](const Point& x, const Point& n, int) -> Point {
    return on_hole(x) ? Point(-n) : Point(0, 0);
  };
  const Point of_pressure = nodal_loads(problem, p).rowwise().sum();
  EXPECT_LT((of_pressure - Point(1, 1)).norm(), 1e-9);
  problem.loads.traction_MPa = nullptr;
  problem.loads.body_force_N_per_mm3 = {3, -2};
  const Point of_weight = nodal_loads(problem, p).rowwise().sum();
  EXPECT_LT((of_weight - 3 * std::numbers::pi / 4 * Point(3, -2)).norm(), 1e-9);
  const Point between_chords = nodal_loads(problem, p, Sides::chords).rowwise().sum();
  EXPECT_GT((of_weight - between_chords).norm(), 0.01);
}

// It expands without stress, up to its curves.
TEST_P(RoundDisplacements, OfAWarmBodyHaveItsLoadsStresses) {
  Problem problem = quarter(4, 2, 2, pressed, 0.3, Rim::loaded);
  const StressField cold = solved(problem).solution.stress;
  problem.loads.thermal = {{.at_origin = 1e-3}};
  const StressField warm = solved(problem).solution.stress;
  EXPECT_LT(stress_distance(problem, warm, cold),
            1e-11 * std::sqrt(stress_norm_squared(problem, cold)));
}

TEST_P(RoundDisplacements, OfAFreeBodyAreInBalance) {
  testing::RingInSocket ring;
  ContactSystem system = contact_system(
      std::make_shared<const Problem>(pose(ring.scene, std::move(ring.mesh))), p - 1);
  const Solution solution =
      solve_load_case(select_methods(displacements_of_degree(p)).front().solve, system, {});
  ASSERT_EQ(solution.status, Status::ok) << solution.message;
  const Verification v = verify(system, solution, nullptr);
  EXPECT_LT(*v.equilibrium_residual, 1e-10);
  EXPECT_LT(*v.unbalanced_N, 1e-9);
  EXPECT_LT(*v.natural_map_residual, 1e-10);
}

// Its stresses would otherwise be taken for those of the body between the chords.
TEST(RoundDisplacementsOfP2, HaveStressesOfDegreeTwo) {
  const auto degree = [](const Problem& problem) {
    return own_stress(problem, DisplacementField::Zero(2, displacement_nodes(problem))).degree();
  };
  const Problem round = quarter(4, 2, 2, pressed, 0.3);
  EXPECT_EQ(degree(round), 2);
  EXPECT_EQ(degree(with_chords(round)), 1);
}

TEST(RoundDisplacementsOfPrograms, HaveChords) {
  const auto problem = std::make_shared<const Problem>(quarter(4, 2, 2, pressed, 0.3));
  Method method = select_methods("P2").front();
  EXPECT_FALSE(assemble(method, problem)->problem->round.empty());
  method.program = "another";
  EXPECT_TRUE(assemble(method, problem)->problem->round.empty());
  Options options;
  options.limits.repetitions = 1;
  testing::CaseBench bench(problem, options);  // one after the other
  for (const Method& of_case : {select_methods("P2").front(), method, select_methods("P2").front()})
    EXPECT_LT(bench.examine(of_case, "").equilibrium_residual, 1e-10);
}

}  // namespace
}  // namespace airybench::round_displacements_test
