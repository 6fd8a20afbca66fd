// The judge must find what is wrong, so every test here spoils a right solution.
#include "verify/verifier.hpp"

#include <gtest/gtest.h>

#include "assembly/problem/scene.hpp"
#include "solvers/methods.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::verifier_test {
namespace {

class Verifier : public ::testing::Test {
 protected:
  void pose_scene(const Scene& scene) {
    problem_ = testing::posed(scene);
    system_ = contact_system(problem_);
    reference_ = compute_reference(system_);
    solution_ = run(select_methods("HYBRID").front(), system_, {});
    ASSERT_EQ(solution_.status, Status::ok);
  }
  Verification verified() const { return verify(system_, solution_, &reference_); }

  std::shared_ptr<const Problem> problem_;
  ContactSystem system_;
  Reference reference_;
  Solution solution_;
};

TEST_F(Verifier, AcceptsARightSolution) {
  pose_scene({});
  const Verification v = verified();
  EXPECT_LT(*v.error_stress, 1e-11);
  EXPECT_LT(*v.error_force, 1e-11);
  EXPECT_LT(v.equilibrium_residual, 1e-11);
  EXPECT_LT(*v.natural_map_residual, 1e-11);
  EXPECT_LT(worst_measure(v).value, 1e-11);
  EXPECT_EQ(*v.n_open + *v.n_stick + *v.n_slip, system_.contact.count);
  EXPECT_GT(*v.n_open, 0);
  EXPECT_GT(*v.n_stick, 0);
  EXPECT_GT(*v.n_slip, 0);
}

TEST_F(Verifier, MeasuresAStressErrorInTheEnergyNorm) {
  pose_scene({});
  solution_.stress.values() *= 1.001;
  EXPECT_NEAR(*verified().error_stress, 1e-3, 1e-9);
}

TEST_F(Verifier, MeasuresAForceErrorInTheDNorm) {
  pose_scene({});
  const Eigen::VectorXd right = solution_.F_C;
  const Eigen::MatrixXd& D = reference_.condensed.D;
  const double norm = std::sqrt(right.dot(D * right));
  for (const Eigen::Index i : {Eigen::Index{0}, right.size() / 2, right.size() - 1}) {
    solution_.F_C = right;
    solution_.F_C(i) += 3;
    EXPECT_NEAR(*verified().error_force, 3 * std::sqrt(D(i, i)) / norm, 1e-9) << i;
  }
}

TEST_F(Verifier, JudgesStressesOfEveryDegree) {
  for (const int k : {1, 2, 3, 4}) {
    Scene scene{.friction = 0.2};
    scene.body_force_N_per_mm3 = {0.4, -0.2};
    system_ = contact_system(testing::posed(scene, testing::small_tooth(4, 3)), k);
    reference_ = compute_reference(system_);
    const Solution right = run(select_methods(hybrid_of_degree(k)).front(), system_, {});
    ASSERT_EQ(right.status, Status::ok) << right.message;
    solution_ = right;
    EXPECT_LT(worst_measure(verified()).value, 1e-10) << k;
    const auto unbalanced_by = [&](int column) {  // of one triangle's first third
      solution_ = right;
      solution_.stress[7](0, column) += 1;
      return verified().equilibrium_residual.value();
    };
    EXPECT_GT(unbalanced_by(1), 1e-4) << k;                       // on an edge of the mesh
    EXPECT_GT(unbalanced_by(ring_place(k, 0, 1)), 1e-4) << k;     // between thirds
    EXPECT_GT(unbalanced_by(bernstein_count(k) - 1), 1e-4) << k;  // at the centroid
    solution_ = right;
    Eigen::Index largest;
    solution_.F_C.cwiseAbs().maxCoeff(&largest);
    solution_.F_C(largest) *= 1.001;
    EXPECT_GT(verified().equilibrium_residual, 1e-5) << k;
    EXPECT_GT(verified().natural_map_residual, 1e-5) << k;
  }
}

TEST_F(Verifier, FindsEveryViolationOfTheContactLaw) {
  pose_scene({});
  const Eigen::VectorXd right = solution_.F_C;
  for (int p = 0; p < system_.contact.count; ++p) {
    solution_.F_C = right;
    solution_.F_C(2 * p) += 10;  // pulls, or presses less than it must
    EXPECT_GT(*verified().signorini_violation_N, 1) << p;
    solution_.F_C = right;
    solution_.F_C(2 * p + 1) += 10;
    EXPECT_GT(*verified().coulomb_violation_N, 1) << p;
    EXPECT_GT(*verified().natural_map_residual, 1e-4) << p;
  }
}

TEST_F(Verifier, SaysTheSameOfTheContactProblemAlone) {
  pose_scene({});
  solution_.F_C *= 1.01;
  const Verification v = verified(), alone = verify(reference_.condensed, solution_.F_C);
  EXPECT_EQ(alone.natural_map_residual, v.natural_map_residual);
  EXPECT_EQ(alone.signorini_violation_N, v.signorini_violation_N);
  EXPECT_EQ(alone.coulomb_violation_N, v.coulomb_violation_N);
  EXPECT_EQ(alone.normal_resultant_N, v.normal_resultant_N);
  EXPECT_EQ(alone.n_slip, v.n_slip);
  EXPECT_EQ(alone.friction_coupling, v.friction_coupling);
  EXPECT_FALSE(alone.equilibrium_residual || alone.error_stress || alone.error_force);
}

TEST_F(Verifier, WithoutFrictionThereIsNoTangentialLaw) {
  pose_scene({.friction = 0});
  const Verification v = verified();
  EXPECT_FALSE(v.coulomb_violation_N);
  EXPECT_EQ(*v.tangential_resultant_N, 0);
  EXPECT_EQ(*v.n_stick, 0);
}

TEST_F(Verifier, ABodyThatIsOnlyMovedHasNoError) {
  pose_scene({.clearance_mm = 1});
  EXPECT_LT(worst_measure(verified()).value, 1e-9);
  // … but a stress that is not there in truth is one.
  solution_.stress.values().setConstant(0.1);
  EXPECT_GT(*verified().error_stress, 1e-4);
}

TEST_F(Verifier, NaNIsTheWorstMeasure) {
  pose_scene({});
  solution_.F_C(0) = std::nan("");
  EXPECT_TRUE(std::isnan(worst_measure(verified()).value));
  Verification first;
  first.equilibrium_residual = std::nan("");
  first.error_stress = 0.5;
  EXPECT_TRUE(std::isnan(worst_measure(first).value));
}

TEST_F(Verifier, EnergiesAreClapeyrons) {
  // Flat wall, no gap: the loads work only at Γ_D, so Π* = U − 2U = −U (friction does no work where
  // nothing slides: μ large).
  pose_scene({.friction = 100, .crown_radius_mm = {}, .displacement_mm = {0.02, 0}});
  const Verification v = verified();
  EXPECT_EQ(*v.n_stick, system_.contact.count);
  EXPECT_NEAR(*v.complementary_energy_Nmm, -v.strain_energy_Nmm, 1e-9 * v.strain_energy_Nmm);
}

TEST_F(Verifier, WithoutAReferenceErrorsAreUnknownNotZero) {
  pose_scene({});
  const Verification v = verify(system_, solution_, nullptr);
  EXPECT_FALSE(v.error_stress);
  EXPECT_FALSE(v.error_force);
  EXPECT_FALSE(v.reference_error);
  EXPECT_LT(*v.natural_map_residual, 1e-10);  // by its own edge moments
  EXPECT_LT(v.equilibrium_residual, 1e-11);
}

// Where there is no reference, an answer's own edge moments stand in for it.
class WithoutAReference : public ::testing::Test {
 protected:
  Solution solve(const char* method, double friction) {
    system_ = contact_system(testing::posed({.friction = friction}, testing::small_tooth(8, 6)));
    RunControl control;
    control.tolerance = 1e-10;
    return run(select_methods(method).front(), system_, control);
  }
  double worst(const Solution& solution) const {
    return worst_measure(verify(system_, solution, nullptr)).value;
  }
  ContactSystem system_;
};

TEST_F(WithoutAReference, FindsNothingWrongWithARightAnswer) {
  for (const double friction : {0.2, 0.0})
    for (const char* method : {"HYBRID", "HYBRID:CG"}) {
      const Solution solution = solve(method, friction);
      const Verification v = verify(system_, solution, nullptr);
      ASSERT_TRUE(v.stress_of_moments_off && v.natural_map_residual) << method;
      EXPECT_LT(*v.stress_of_moments_off, 1e-10) << method;
      EXPECT_LT(*v.natural_map_residual, 1e-7) << method;
      EXPECT_LT(v.equilibrium_residual, 1e-7) << method;
      EXPECT_FALSE(v.error_stress || v.error_force || v.reference_error) << method;
    }
}

TEST_F(WithoutAReference, SeesEveryPartOfAnAnswerThatIsWrong) {
  const Solution right = solve("HYBRID:CG", 0.2);
  const auto after = [&](auto change) {
    Solution wrong = right;
    change(wrong);
    return worst(wrong);
  };
  EXPECT_LT(worst(right), 1e-7);
  EXPECT_GT(after([](Solution& s) { s.F_C *= 1.001; }), 1e-5);
  EXPECT_GT(after([](Solution& s) {
              s.stress.values() *= 1.001;  // it balances but for F_C
            }),
            1e-5);
  EXPECT_GT(after([](Solution& s) { std::get<EdgeDisplacements>(s.unknowns).moments *= 1.001; }),
            1e-5);
  // In balance and compatible, through the wall.
  system_ = contact_system(testing::posed({.clearance_mm = 1}, testing::small_tooth(8, 6)));
  EXPECT_GT(worst(right), 1e-5);
}

}  // namespace
}  // namespace airybench::verifier_test
