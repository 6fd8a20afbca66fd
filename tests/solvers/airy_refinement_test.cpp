// A method's own estimate of its error, and refinement, with the exact solve of a small saddle
// matrix in place of a method's factors.
#include "solvers/condensation/airy_refinement.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "assembly/scene.hpp"
#include "solvers/condensation/airy_residual.hpp"
#include "solvers/condensation/three_step.hpp"
#include "solvers/direct/factor_counts.hpp"
#include "solvers/direct/skyline.hpp"
#include "solvers/methods.hpp"
#include "tests/support/dense_algebra.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::airy_refinement_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Dense {
  DualSystem system;
  std::function<MatrixXd(MatrixXd)> solve_with;

  explicit Dense(const Scene& scene)
      : system(assemble(testing::posed(scene, testing::small_tooth(4, 3)))) {
    const int n = system.n(), n_f = system.n_f(), n_c = system.n_c();
    MatrixXd C(n_f + n_c, n);
    C << MatrixXd(system.C_F), MatrixXd(system.C_C);
    MatrixXd matrix = MatrixXd::Zero(n + n_f + n_c, n + n_f + n_c);
    matrix.topLeftCorner(n, n) = MatrixXd(system.S).selfadjointView<Eigen::Lower>();
    matrix.bottomLeftCorner(n_f + n_c, n) = C;
    matrix.topRightCorner(n, n_f + n_c) = C.transpose();
    solve_with = testing::factorised(matrix);
  }
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
    Solution result = run(select_methods("3STEPD:REFINED").front(), system, {});
    EXPECT_EQ(result.status, Status::ok) << result.message;
    return result;
  }
  // The estimate of an answer, and what is said about it, for a target.
  Solution checked(const SaddleVector& answer, const VectorXd& F_C, double target) const {
    return checked_with(D(), solve(), answer, F_C, target);
  }
  Solution checked_with(const MatrixXd& own_D, const SaddleSolve& own_solve,
                        const SaddleVector& answer, const VectorXd& F_C, double target) const {
    Solution result = unjudged(answer, F_C);
    RunControl control;
    control.target_error = target;
    check_airy_answer(system, own_D, own_solve, answer, control, result);
    return result;
  }
  Solution unjudged(const SaddleVector& answer, const VectorXd& F_C) const {
    Solution result;
    result.status = Status::ok;
    result.F_C = F_C;
    result.stress = stress_of_airy_function(*system.problem, airy_function(system, answer.x));
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
  // What refinement with this solve makes of an answer.
  Solution refined(const MatrixXd& own_D, const SaddleSolve& own_solve, const SaddleVector& answer,
                   const VectorXd& F_C) const {
    Solution result = unjudged(answer, F_C);
    refine_airy_answer(system, own_D, own_solve, answer, {}, result);
    return result;
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

LongVector in_long(const VectorXd& v) { return v.cast<long double>(); }

TEST(AiryResidual, IsThatOfTheBlocksForAnyVector) {
  int number = 0;
  for (const Scene& scene : scenes()) {
    SCOPED_TRACE(number++);
    const Dense d(scene);
    const DualSystem& s = d.system;
    std::srand(7);
    const VectorXd x = VectorXd::Random(s.n()), lambda_F = VectorXd::Random(s.n_f()),
                   lambda_C = VectorXd::Random(s.n_c()), F_C = VectorXd::Random(s.n_c());
    const LongSaddleVector r =
        airy_residual(s, {in_long(x), in_long(lambda_F), in_long(lambda_C)}, F_C).residual;
    const auto expect_same = [](const LongVector& found, const VectorXd& by_blocks) {
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

TEST(AiryRefinement, LeavesResidualsAtRounding) {
  int number = 0;
  for (const Scene& scene : scenes()) {
    SCOPED_TRACE(number++);
    const Dense d(scene);
    Solution refined = d.solution();
    refine_airy_answer(d.system, d.D(), d.solve(), d.answer(refined.F_C), {}, refined);
    EXPECT_LE(refined.error_estimate.value_or(1), 1e-14);
    EXPECT_EQ(refined.status, Status::ok);
    EXPECT_EQ(d.checked(d.answer(refined.F_C), refined.F_C, 1e-10).status, Status::ok);
  }
}

TEST(AiryRefinement, EstimatesAKnownErrorAndSaysWhenItIsAboveTheTarget) {
  const Dense d(Scene{});
  const VectorXd F_C = d.solution().F_C;
  const SaddleVector exact = d.answer(F_C);
  const auto expect_estimate = [&](const SaddleVector& answer, const VectorXd& F, double error) {
    const Solution above = d.checked(answer, F, error / 20);
    ASSERT_TRUE(above.error_estimate);
    EXPECT_GE(*above.error_estimate, error / 10);
    EXPECT_LE(*above.error_estimate, error * 10);
    EXPECT_EQ(above.status, Status::inaccurate);
    EXPECT_EQ(d.checked(answer, F, error * 20).status, Status::ok);
  };
  for (const double error : {1e-3, 1e-6, 1e-9}) {
    SCOPED_TRACE(error);
    SaddleVector wrong = exact;
    wrong.x += d.self_stress(error * d.energy_norm(exact.x));
    expect_estimate(wrong, F_C, error);

    // Contact forces that are not the law's, everything else as they want it: displacements follow,
    // and the natural map is off by about as much.
    const VectorXd F_wrong = (1 + error) * F_C;
    expect_estimate(d.answer(F_wrong), F_wrong, error);
  }
}

// On slivers S is indefinite, by rounding: xᵀSx is negative for a correction as large as the
// answer.
TEST(AiryRefinement, MeasuresCorrectionsByTheirStressesAndNotByS) {
  Dense d(Scene{});
  const VectorXd F_C = d.solution().F_C;
  const SaddleVector exact = d.answer(F_C);
  const VectorXd off = d.self_stress(1e-3 * d.energy_norm(exact.x));
  SaddleVector wrong = exact;
  wrong.x += off;
  const MatrixXd D = d.D();
  const MatrixXd S = MatrixXd(d.system.S).selfadjointView<Eigen::Lower>();
  const VectorXd S_off = S * off;
  const MatrixXd indefinite = S - 2 / off.dot(S_off) * S_off * S_off.transpose();
  d.system.S = MatrixXd(indefinite.triangularView<Eigen::Lower>()).sparseView();
  ASSERT_LT(off.dot(indefinite * off), 0);

  const Solution checked = d.checked(wrong, F_C, 1e-6);
  EXPECT_EQ(checked.status, Status::inaccurate);
  EXPECT_NEAR(checked.error_estimate.value_or(0), 1e-3, 1e-5);
  // Corrections that never end.
  const SaddleSolve lost = [&](SaddleVector& v) {
    v = {off, VectorXd::Zero(d.system.n_f()), VectorXd::Zero(d.system.n_c())};
  };
  const Solution refined = d.refined(D, lost, wrong, F_C);
  EXPECT_EQ(refined.status, Status::inaccurate);
  EXPECT_GE(refined.error_estimate.value_or(0), 1e-4);
}

// A solve that does half of what it should: the corrections' sum is no less than the error.
TEST(AiryRefinement, MeasuresWhatSeveralCorrectionsTogetherCorrect) {
  const Dense d(Scene{});
  const VectorXd F_C = d.solution().F_C;
  const SaddleVector exact = d.answer(F_C);
  const SaddleSolve half = [&](SaddleVector& v) {
    d.solve()(v);
    for (VectorXd* part : {&v.x, &v.lambda_F, &v.lambda_C}) *part /= 2;
  };
  SaddleVector wrong = exact;
  wrong.x += d.self_stress(1e-3 * d.energy_norm(exact.x));
  const auto estimate = [&](const SaddleSolve& solve) {
    return d.checked_with(d.D(), solve, wrong, F_C, 1e-6).error_estimate.value();
  };
  EXPECT_NEAR(estimate(d.solve()), 1e-3, 1e-5);
  // Work tells each correction that it is half of what is left: 1 + 1/2 + 1/4 + …
  EXPECT_GT(estimate(half), 0.97e-3);
  EXPECT_LT(estimate(half), 2.1e-3);
}

// On slivers the factor may be hundreds of times as stiff as S in one direction, or indefinite.
TEST(AiryRefinement, MeasuresWhatAFactorThatIsTooStiffDoesNotCorrect) {
  const Dense d(Scene{});
  const VectorXd F_C = d.solution().F_C;
  const SaddleVector exact = d.answer(F_C);
  SaddleVector wrong = exact;
  wrong.x += d.self_stress(1e-3 * d.energy_norm(exact.x));
  for (const double stiffness : {1.0, 300.0, -300.0, 1e9}) {
    SCOPED_TRACE(stiffness);
    const SaddleSolve stiff = [&](SaddleVector& v) {
      d.solve()(v);
      v.x /= stiffness;
    };
    const Solution checked = d.checked_with(d.D(), stiff, wrong, F_C, 1e-6);
    EXPECT_EQ(checked.status, Status::inaccurate);
    EXPECT_GE(checked.error_estimate.value_or(0), 0.9e-3);
    EXPECT_LE(checked.error_estimate.value_or(1), 1e-2);
    if (stiffness == 1) continue;
    const Solution refined = d.refined(d.D(), stiff, wrong, F_C);
    EXPECT_EQ(refined.status, Status::inaccurate);
    EXPECT_GE(refined.error_estimate.value_or(0), 0.9e-3);
  }
}

// Rounding makes W, and D with it, a matrix that is only half right, or nothing like it; contact
// forces, recovery and corrections are all made with that.
TEST(AiryRefinement, AWrongDIsMendedOrNoticed) {
  const Dense d(Scene{});
  const VectorXd F_exact = d.solution().F_C;
  Solution stages;
  const SkylineFactor factor = factor_in_stages(d.system.S, {}, stages);
  const SolveInPlace solve_S = [&](Eigen::Ref<MatrixXd> X) { solve_in_place(factor, X, {}, 1); };
  ThreeStep steps = condense_in_three_steps(d.system, solve_S);
  const contact::Problem right = steps.condensed;
  const VectorXd soft = VectorXd::Random(d.system.n_c()).normalized();
  for (const double size : {1e-9, 1e-6, 1e-3, 0.5, 3.0, 1e3, 1e8, 1e15}) {
    for (const bool all : {true, false}) {
      SCOPED_TRACE(::testing::Message() << size << (all ? " in all" : " in one direction"));
      MatrixXd D = right.D;
      if (all)
        D *= 1 + size;
      else
        D += size * D.norm() * soft * soft.transpose();
      steps.condensed.D = D;
      steps.condensed.G = D * testing::solved(right.D, right.G);
      const SaddleSolve solve = [&](SaddleVector& v) { solve_saddle(steps, d.system, solve_S, v); };
      Solution solution;
      solve_condensed_contact(steps.condensed, {}, solution);
      const SaddleVector answer = recover_airy_unknowns(steps, d.system, solution.F_C, solve_S);
      const auto expect_honest = [&](const Solution& found) {
        if (found.status == Status::ok)
          EXPECT_LE((found.F_C - F_exact).norm(), 1e-5 * F_exact.norm());
        else
          EXPECT_EQ(found.status, Status::inaccurate) << found.message;
      };
      expect_honest(d.refined(D, solve, answer, solution.F_C));
      expect_honest(d.checked_with(D, solve, answer, solution.F_C, 1e-6));
    }
  }
}

TEST(AiryRefinement, ErrorsAreRelativeToTheRefinedStress) {
  const Dense d(Scene{});
  const VectorXd F_C = d.solution().F_C;
  SaddleVector answer = d.answer(F_C);
  const double norm = d.energy_norm(answer.x);
  const VectorXd left = d.self_stress(1e-3 * norm);
  answer.x += d.self_stress(1e10 * norm);
  const SaddleSolve poor = [&](SaddleVector& v) {
    d.solve()(v);
    v.x += left;
  };
  const Solution refined = d.refined(d.D(), poor, answer, F_C);
  EXPECT_EQ(refined.status, Status::inaccurate);
  EXPECT_GE(refined.error_estimate.value_or(0), 5e-4);
}

TEST(AiryRefinement, ACorrectionThatIsNotANumberIsNoSmallOne) {
  const Dense d(Scene{});
  const VectorXd F_C = d.solution().F_C;
  const SaddleVector exact = d.answer(F_C);
  for (const bool in_x : {true, false}) {
    const SaddleSolve broken = [&](SaddleVector& v) {
      (in_x ? v.x : v.lambda_C).setConstant(std::numeric_limits<double>::quiet_NaN());
    };
    EXPECT_EQ(d.refined(d.D(), broken, exact, F_C).status, Status::inaccurate);
    EXPECT_EQ(d.checked_with(d.D(), broken, exact, F_C, 1e-6).status, Status::inaccurate);
  }
}

TEST(AiryRefinement, MultipliersAloneAreCorrectedWithoutAnError) {
  const Dense d(Scene{});
  const VectorXd F_C = d.solution().F_C;
  SaddleVector wrong = d.answer(F_C);
  wrong.lambda_F *= 1.001;  // displacements of the free boundary: no stress, no force
  wrong.lambda_C *= 1.001;
  EXPECT_LE(d.checked(wrong, F_C, 1e-6).error_estimate.value_or(1), 1e-10);
}

TEST(AiryRefinement, NoLoadIsNoError) {
  Scene scene;
  scene.displacement_mm = {0, 0};
  scene.crown_radius_mm.reset();
  const Dense d(scene);
  const VectorXd none = VectorXd::Zero(d.system.n_c());
  const SaddleVector zero = {VectorXd::Zero(d.system.n()), VectorXd::Zero(d.system.n_f()), none};
  EXPECT_EQ(d.checked(zero, none, 1e-6).error_estimate, 0.0);
  for (const char* method : {"3STEPD:REFINED", "BLIND:SCHUR:REFINED"}) {
    const Solution solution = run(select_methods(method).front(), d.system, {});
    EXPECT_EQ(solution.status, Status::ok) << method << ": " << solution.message;
    EXPECT_EQ(solution.error_estimate, 0.0) << method;
    EXPECT_TRUE(solution.F_C.isZero(0) && solution.phi.isZero(0)) << method;
  }
}

}  // namespace
}  // namespace airybench::airy_refinement_test
