// A method's own estimate of its error, and refinement, with the exact solve of a small saddle
// matrix in place of a method's factors.
#include "solvers/condensation/airy_refinement.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "assembly/problem/scene.hpp"
#include "solvers/condensation/airy_residual.hpp"
#include "solvers/condensation/three_step.hpp"
#include "solvers/direct/skyline.hpp"
#include "tests/support/dense_operators.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/solved.hpp"

namespace airybench::airy_refinement_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Dense {
  AirySystem system;
  std::function<MatrixXd(MatrixXd)> solve_with;

  explicit Dense(const Scene& scene)
      : system(testing::system_of(scene, testing::small_tooth(4, 3))),
        solve_with(testing::factorised(testing::saddle_matrix(system))) {}
  SaddleSolve solve() const {
    return [this](SaddleVector& v) {
      VectorXd all(system.n() + system.n_f() + system.n_c());
      all << v.x, v.lambda_F, v.lambda_C;
      all = solve_with(all);
      v = {all.head(system.n()), all.segment(system.n(), system.n_f()), all.tail(system.n_c())};
    };
  }
  // Displacements per contact force.
  MatrixXd D() const {
    MatrixXd D(system.n_c(), system.n_c());
    for (int i = 0; i < system.n_c(); ++i) {
      SaddleVector unit = {VectorXd::Zero(system.n()), VectorXd::Zero(system.n_f()),
                           VectorXd::Unit(system.n_c(), i)};
      solve()(unit);
      D.col(i) = -unit.lambda_C;
    }
    return D;
  }
  VectorXd or_zero(const VectorXd& v, int size) const {
    return v.size() > 0 ? v : VectorXd(VectorXd::Zero(size));
  }
  SaddleVector answer(const VectorXd& F_C) const {
    SaddleVector v = {or_zero(system.q, system.n()), or_zero(system.F, system.n_f()),
                      F_C - or_zero(system.F0, system.n_c())};
    solve()(v);
    return v;
  }
  Solution solution() const {
    Solution result = testing::solved_by("3STEPD:REFINED", system);
    EXPECT_EQ(result.status, Status::ok) << result.message;
    return result;
  }
  Solution unjudged(const SaddleVector& answer, const VectorXd& F_C) const {
    Solution result;
    result.status = Status::ok;
    result.F_C = F_C;
    result.stress = stress_of_airy_function(*system.problem, airy_function(system, answer.x));
    return result;
  }
  // The estimate of an answer, and what is said about it, for a target.
  Solution checked(const MatrixXd& own_D, const SaddleSolve& own_solve, const SaddleVector& answer,
                   const VectorXd& F_C, double target = 1e-6) const {
    Solution result = unjudged(answer, F_C);
    RunControl control;
    control.target_error = target;
    check_airy_answer(system, {.D = own_D, .points = system.contact}, own_solve, answer, control,
                      result);
    return result;
  }
  // What refinement with this solve makes of an answer.
  Solution refined(const MatrixXd& own_D, const SaddleSolve& own_solve, const SaddleVector& answer,
                   const VectorXd& F_C) const {
    Solution result = unjudged(answer, F_C);
    refine_airy_answer(system, {.D = own_D, .points = system.contact}, own_solve, answer, {},
                       result);
    return result;
  }
  double energy_norm(const VectorXd& x) const {
    return std::sqrt(x.dot(system.S.selfadjointView<Eigen::Lower>() * x));
  }
  // A stress without forces on the boundary, so that the energy norm measures it alone: the
  // response to a compatibility residual.
  VectorXd self_stress(double norm) const {
    SaddleVector v = {VectorXd::Random(system.n()), VectorXd::Zero(system.n_f()),
                      VectorXd::Zero(system.n_c())};
    solve()(v);
    return norm / energy_norm(v.x) * v.x;
  }
};

// The default scene, its contact forces and answer.
class AiryRefinement : public ::testing::Test {
 protected:
  Dense d{Scene{}};
  const MatrixXd D = d.D();
  const VectorXd F_C = d.solution().F_C;
  const SaddleVector exact = d.answer(F_C);
  const double norm = d.energy_norm(exact.x);

  SaddleVector wrong_by(const VectorXd& self_stress) const {
    return {exact.x + self_stress, exact.lambda_F, exact.lambda_C};
  }
  Solution checked(const SaddleSolve& solve, const SaddleVector& answer) const {
    return d.checked(D, solve, answer, F_C);
  }
  Solution refined(const SaddleSolve& solve, const SaddleVector& answer) const {
    return d.refined(D, solve, answer, F_C);
  }
};

std::vector<Scene> scenes() {
  std::vector<Scene> all(6);
  all[1].body_force_N_per_mm3 = {0.3, -0.7};
  all[2].friction = 0;
  all[3].mesh.keep_contact_edges = 0;
  all[4].mesh.keep_force_edges = 0;
  all[5].layers.count = 2;
  all[5].layer_materials.resize(2);
  all[5].layer_materials[1].young_MPa = 70000;
  all[5].body_force_N_per_mm3 = {0.3, -0.7};
  return all;
}

WideVector in_long(const VectorXd& v) { return v.cast<Wide>(); }

TEST(AiryResidual, IsThatOfTheBlocksForAnyVector) {
  int number = 0;
  for (const Scene& scene : scenes()) {
    SCOPED_TRACE(number++);
    const Dense d(scene);
    const AirySystem& s = d.system;
    std::srand(7);
    const VectorXd x = VectorXd::Random(s.n()), lambda_F = VectorXd::Random(s.n_f()),
                   lambda_C = VectorXd::Random(s.n_c()), F_C = VectorXd::Random(s.n_c());
    const LongSaddleVector r =
        airy_residual(s, {in_long(x), in_long(lambda_F), in_long(lambda_C)}, F_C).residual;
    const auto expect_same = [](const WideVector& found, const VectorXd& by_blocks) {
      ASSERT_EQ(found.size(), by_blocks.size());
      EXPECT_LE((found.cast<double>() - by_blocks).norm(), 1e-10 * by_blocks.norm());
    };
    expect_same(r.x, d.or_zero(s.q, s.n()) - s.S.selfadjointView<Eigen::Lower>() * x -
                         s.C_F.transpose() * lambda_F - s.C_C.transpose() * lambda_C);
    const AiryProduct product = airy_product(s, x);
    const VectorXd S_x = s.S.selfadjointView<Eigen::Lower>() * x;
    EXPECT_LE((product.S_x - S_x).norm(), 1e-10 * S_x.norm());
    EXPECT_NEAR(product.stress_norm, std::sqrt(x.dot(S_x)), 1e-10 * product.stress_norm);
    expect_same(r.lambda_F, d.or_zero(s.F, s.n_f()) - s.C_F * x);
    expect_same(r.lambda_C, F_C - d.or_zero(s.F0, s.n_c()) - s.C_C * x);
  }
}

TEST_F(AiryRefinement, LeavesResidualsAtRounding) {
  int number = 0;
  for (const Scene& scene : scenes()) {
    SCOPED_TRACE(number++);
    const Dense of_scene(scene);
    const auto answer = [&](const Solution& s) { return of_scene.answer(s.F_C); };
    const MatrixXd own_D = of_scene.D();
    Solution result = of_scene.solution();
    refine_airy_answer(of_scene.system, {.D = own_D, .points = of_scene.system.contact},
                       of_scene.solve(), answer(result), {}, result);
    EXPECT_LE(result.error_estimate.value_or(1), 1e-14);
    EXPECT_EQ(result.status, Status::ok);
    EXPECT_EQ(of_scene.checked(own_D, of_scene.solve(), answer(result), result.F_C, 1e-10).status,
              Status::ok);
  }
}

TEST_F(AiryRefinement, EstimatesAKnownErrorAndSaysWhenItIsAboveTheTarget) {
  const auto expect_estimate = [&](const SaddleVector& answer, const VectorXd& F, double error) {
    const Solution above = d.checked(D, d.solve(), answer, F, error / 20);
    ASSERT_TRUE(above.error_estimate);
    EXPECT_GE(*above.error_estimate, error / 10);
    EXPECT_LE(*above.error_estimate, error * 10);
    EXPECT_EQ(above.status, Status::inaccurate);
    EXPECT_EQ(d.checked(D, d.solve(), answer, F, error * 20).status, Status::ok);
  };
  for (const double error : {1e-3, 1e-6, 1e-9}) {
    SCOPED_TRACE(error);
    expect_estimate(wrong_by(d.self_stress(error * norm)), F_C, error);
    // Contact forces that are not the law's, everything else as they want it: displacements follow,
    // and the natural map is off by about as much.
    const VectorXd F_wrong = (1 + error) * F_C;
    expect_estimate(d.answer(F_wrong), F_wrong, error);
  }
}

// On slivers S is indefinite, by rounding: xᵀSx is negative for a correction as large as the
// answer.
TEST_F(AiryRefinement, MeasuresCorrectionsByTheirStressesAndNotByS) {
  const VectorXd off = d.self_stress(1e-3 * norm);
  const MatrixXd S = MatrixXd(d.system.S).selfadjointView<Eigen::Lower>();
  const VectorXd S_off = S * off;
  const MatrixXd indefinite = S - 2 / off.dot(S_off) * S_off * S_off.transpose();
  d.system.S = testing::lower_of(indefinite);
  ASSERT_LT(off.dot(indefinite * off), 0);

  const Solution check = checked(d.solve(), wrong_by(off));
  EXPECT_EQ(check.status, Status::inaccurate);
  EXPECT_NEAR(check.error_estimate.value_or(0), 1e-3, 1e-5);
  // Corrections that never end.
  const SaddleSolve lost = [&](SaddleVector& v) {
    v = {off, VectorXd::Zero(d.system.n_f()), VectorXd::Zero(d.system.n_c())};
  };
  const Solution result = refined(lost, wrong_by(off));
  EXPECT_EQ(result.status, Status::inaccurate);
  EXPECT_GE(result.error_estimate.value_or(0), 1e-4);
}

// A solve that does half of what it should: the corrections' sum is no less than the error.
TEST_F(AiryRefinement, MeasuresWhatSeveralCorrectionsTogetherCorrect) {
  const SaddleSolve half = [&](SaddleVector& v) {
    d.solve()(v);
    for (VectorXd* part : {&v.x, &v.lambda_F, &v.lambda_C}) *part /= 2;
  };
  const SaddleVector wrong = wrong_by(d.self_stress(1e-3 * norm));
  EXPECT_NEAR(checked(d.solve(), wrong).error_estimate.value(), 1e-3, 1e-5);
  // Work tells each correction that it is half of what is left: 1 + 1/2 + 1/4 + …
  const double estimate = checked(half, wrong).error_estimate.value();
  EXPECT_GT(estimate, 0.97e-3);
  EXPECT_LT(estimate, 2.1e-3);
}

// On slivers the factor may be hundreds of times as stiff as S in one direction, or indefinite.
TEST_F(AiryRefinement, MeasuresWhatAFactorThatIsTooStiffDoesNotCorrect) {
  const SaddleVector wrong = wrong_by(d.self_stress(1e-3 * norm));
  for (const double stiffness : {1.0, 300.0, -300.0, 1e9}) {
    SCOPED_TRACE(stiffness);
    const SaddleSolve stiff = [&](SaddleVector& v) {
      d.solve()(v);
      v.x /= stiffness;
    };
    const Solution check = checked(stiff, wrong);
    EXPECT_EQ(check.status, Status::inaccurate);
    EXPECT_GE(check.error_estimate.value_or(0), 0.9e-3);
    EXPECT_LE(check.error_estimate.value_or(1), 1e-2);
    if (stiffness == 1) continue;
    const Solution result = refined(stiff, wrong);
    EXPECT_EQ(result.status, Status::inaccurate);
    EXPECT_GE(result.error_estimate.value_or(0), 0.9e-3);
  }
}

// Rounding makes W, and D with it, a matrix that is only half right, or nothing like it; contact
// forces, recovery and corrections are all made with that.
TEST_F(AiryRefinement, AWrongDIsMendedOrNoticed) {
  Solution stages;
  const SkylineFactor factor = factor_in_stages(d.system.S, {}, stages);
  const SolveInPlace solve_S = [&](Eigen::Ref<MatrixXd> X) { solve_in_place(factor, X, {}, 1); };
  ThreeStep steps = condense_in_three_steps(d.system, solve_S);
  const contact::Problem right = steps.condensed;
  const VectorXd soft = VectorXd::Random(d.system.n_c()).normalized();
  for (const double size : {1e-9, 1e-6, 1e-3, 0.5, 3.0, 1e3, 1e8, 1e15}) {
    for (const bool all : {true, false}) {
      SCOPED_TRACE(::testing::Message() << size << (all ? " in all" : " in one direction"));
      MatrixXd wrong_D = right.D;
      if (all)
        wrong_D *= 1 + size;
      else
        wrong_D += size * wrong_D.norm() * soft * soft.transpose();
      steps.condensed.D = wrong_D;
      steps.condensed.G = wrong_D * testing::solved(right.D, right.G);
      const SaddleSolve solve = [&](SaddleVector& v) { solve_saddle(steps, d.system, solve_S, v); };
      Solution solution;
      solve_condensed_contact(steps.condensed, {}, solution);
      const SaddleVector answer = recover_airy_unknowns(steps, d.system, solution.F_C, solve_S);
      const auto expect_honest = [&](const Solution& found) {
        if (found.status == Status::ok)
          EXPECT_LE((found.F_C - F_C).norm(), 1e-5 * F_C.norm());
        else
          EXPECT_EQ(found.status, Status::inaccurate) << found.message;
      };
      expect_honest(d.refined(wrong_D, solve, answer, solution.F_C));
      expect_honest(d.checked(wrong_D, solve, answer, solution.F_C));
    }
  }
}

TEST_F(AiryRefinement, ErrorsAreRelativeToTheRefinedStress) {
  const VectorXd left = d.self_stress(1e-3 * norm);
  const SaddleSolve poor = [&](SaddleVector& v) {
    d.solve()(v);
    v.x += left;
  };
  const Solution result = refined(poor, wrong_by(d.self_stress(1e10 * norm)));
  EXPECT_EQ(result.status, Status::inaccurate);
  EXPECT_GE(result.error_estimate.value_or(0), 5e-4);
}

TEST_F(AiryRefinement, ACorrectionThatIsNotANumberIsNoSmallOne) {
  for (const bool in_x : {true, false}) {
    const SaddleSolve broken = [&](SaddleVector& v) {
      (in_x ? v.x : v.lambda_C).setConstant(std::numeric_limits<double>::quiet_NaN());
    };
    EXPECT_EQ(refined(broken, exact).status, Status::breakdown);
    EXPECT_EQ(checked(broken, exact).status, Status::breakdown);
  }
}

TEST_F(AiryRefinement, MultipliersAloneAreCorrectedWithoutAnError) {
  // Displacements of the free boundary: no stress, no force.
  const SaddleVector wrong = {exact.x, 1.001 * exact.lambda_F, 1.001 * exact.lambda_C};
  EXPECT_LE(checked(d.solve(), wrong).error_estimate.value_or(1), 1e-10);
}

TEST_F(AiryRefinement, NoLoadIsNoError) {
  Scene scene;
  scene.displacement_mm = {0, 0};
  scene.crown_radius_mm.reset();
  const Dense free(scene);
  const VectorXd none = VectorXd::Zero(free.system.n_c());
  const SaddleVector zero = {VectorXd::Zero(free.system.n()), VectorXd::Zero(free.system.n_f()),
                             none};
  EXPECT_EQ(free.checked(free.D(), free.solve(), zero, none).error_estimate, 0.0);
  for (const char* method : {"3STEPD:REFINED", "BLIND:SCHUR:REFINED"}) {
    const Solution solution = testing::solved_by(method, free.system);
    EXPECT_EQ(solution.status, Status::ok) << method << ": " << solution.message;
    EXPECT_EQ(solution.error_estimate, 0.0) << method;
    EXPECT_TRUE(solution.F_C.isZero(0) && testing::phi(solution).isZero(0)) << method;
  }
}

}  // namespace
}  // namespace airybench::airy_refinement_test
