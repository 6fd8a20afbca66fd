// D and G from the Airy system, blindly and in three steps, and from the hybridized one.
#include <gtest/gtest.h>

#include <limits>

#include "solvers/condensation/blind.hpp"
#include "solvers/condensation/hybridized.hpp"
#include "solvers/condensation/three_step.hpp"
#include "solvers/direct/mumps.hpp"
#include "solvers/direct/skyline.hpp"
#include "solvers/methods.hpp"
#include "tests/support/condensed_problem.hpp"
#include "tests/support/dense_algebra.hpp"
#include "tests/support/named_scenes.hpp"
#include "tests/support/posed.hpp"

namespace airybench::condensation_test {
namespace {

using testing::posed;
using testing::scene_variants;

contact::Problem three_step_condensed(const AirySystem& system) {
  const SkylineFactor factor = factor_ldlt(analyse_skyline(system.S), system.S);
  return condense_in_three_steps(system,
                                 [&](Eigen::Ref<Eigen::MatrixXd> X) { solve_in_place(factor, X); })
      .condensed;
}

TEST(Condensation, ComplianceIsSymmetricPositiveDefinite) {
  const contact::Problem condensed = three_step_condensed(airy_system(posed({})));
  EXPECT_EQ(testing::distance(condensed.D, condensed.D.transpose()), 0);
  const Eigen::VectorXd eigenvalues = testing::eigenvalues(condensed.D);
  EXPECT_GT(eigenvalues(0), 1e-5 * eigenvalues(eigenvalues.size() - 1));
}

TEST(Condensation, EverySystemGivesTheSameNumbers) {
  for (const auto& [name, scene] : scene_variants()) {
    const AirySystem system = airy_system(posed(scene));
    const contact::Problem reference = three_step_condensed(system);
    const auto expect_equal = [&, &label = name](const contact::Problem& other, const char* how,
                                                 double tolerance = 1e-10) {
      SCOPED_TRACE(label + how);
      EXPECT_LT(testing::distance(other.D, reference.D), tolerance * reference.D.norm());
      EXPECT_LE(testing::distance(other.G, reference.G), tolerance * reference.G.norm());
    };
    expect_equal(testing::condensed(*system.problem, system.contact), ", hybridized", 1e-11);
    const BlindSystem last = make_blind_system(system, BlindNumbering::multipliers_last);
    MumpsFactor whole, partial;
    whole.analyse(last.lower);
    whole.factor(last.lower);
    for (const int columns : {1, 7, 1000})
      expect_equal(condense_blindly(
                       system, last,
                       [&](Eigen::Ref<Eigen::MatrixXd> X) { whole.solve_in_place(X); }, columns),
                   ", solves");
    partial.analyse(last.lower, system.n_c());
    partial.factor(last.lower);
    expect_equal(condense_blindly(system.contact, partial.schur(),
                                  partial.reduce(blind_right_hand_side(system, last, {}))),
                 ", Schur");
    const BlindSystem mixed = make_blind_system(system, BlindNumbering::multipliers_after_unknowns);
    const SkylineFactor factor = factor_ldlt(analyse_skyline(mixed.lower), mixed.lower);
    expect_equal(
        condense_blindly(
            system, mixed, [&](Eigen::Ref<Eigen::MatrixXd> X) { solve_in_place(factor, X); }, 192),
        ", skyline");
  }
}

TEST(Condensation, ConstraintsThatDependOnEachOtherAreABreakdown) {
  AirySystem system = airy_system(posed({}));
  SparseRows doubled = system.C_F;
  doubled.row(1) = doubled.row(0);
  system.C_F = doubled;
  const Solution solution = run(select_methods("3STEPD").front(), system, {});
  EXPECT_EQ(solution.status, Status::breakdown);
  EXPECT_NE(solution.message.find("K_FF"), std::string::npos) << solution.message;
}

TEST(Condensation, NotFiniteInputIsABreakdown) {
  for (const double poison : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    for (const char* method : {"3STEPD", "3STEPD:CHOLMOD"}) {
      AirySystem system = airy_system(posed({}));
      system.S.valuePtr()[5] = poison;
      const Solution solution = run(select_methods(method).front(), system, {});
      EXPECT_TRUE(solution.status == Status::breakdown || solution.status == Status::not_converged)
          << method << ": " << name_of(solution.status);
    }
  }
}

}  // namespace
}  // namespace airybench::condensation_test
