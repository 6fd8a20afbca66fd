// The judge must find what is wrong, so every test here spoils a right solution.
#include "bench/verify/verifier.hpp"

#include <gtest/gtest.h>

#include "assembly/scene.hpp"
#include "solvers/methods.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::verifier_test {
namespace {

class Verifier : public ::testing::Test {
 protected:
  void pose_scene(const Scene& scene) {
    problem_ = testing::posed(scene);
    system_ = assemble(problem_, Blocks::contact_points);
    reference_ = compute_reference(system_);
    solution_ = run(select_methods("HYBRID").front(), system_, {});
    ASSERT_EQ(solution_.status, Status::ok);
  }
  Verification verified() const { return verify(system_, solution_, &reference_); }

  std::shared_ptr<const Problem> problem_;
  DualSystem system_;
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
  for (ElementStress& stress : solution_.stress) stress *= 1.001;
  EXPECT_NEAR(*verified().error_stress, 1e-3, 1e-9);
}

TEST_F(Verifier, MeasuresAForceErrorInTheDNorm) {
  pose_scene({});
  solution_.F_C *= 1.01;
  EXPECT_NEAR(*verified().error_force, 1e-2, 1e-9);
}

TEST_F(Verifier, FindsAnUnbalancedElement) {
  pose_scene({});
  const double strain_energy = verified().strain_energy_Nmm;
  solution_.stress[7].row(0).array() += 1;  // 1 MPa, constant: no divergence, but jumps
  const Verification v = verified();
  EXPECT_GT(v.equilibrium_residual, 1e-4);
  EXPECT_NE(v.strain_energy_Nmm, strain_energy);
}

TEST_F(Verifier, FindsADivergence) {
  pose_scene({});
  solution_.stress[7](0, 2) += 1;  // xx at the centroid, in one third
  EXPECT_GT(verified().equilibrium_residual, 1e-4);
}

TEST_F(Verifier, FindsForcesThatAreNotTheStresses) {
  pose_scene({});
  solution_.F_C(2) *= 1.001;
  EXPECT_GT(verified().equilibrium_residual, 1e-5);
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

TEST_F(Verifier, WithoutFrictionThereIsNoTangentialLaw) {
  Scene scene;
  scene.friction = 0;
  pose_scene(scene);
  const Verification v = verified();
  EXPECT_FALSE(v.coulomb_violation_N);
  EXPECT_EQ(*v.tangential_resultant_N, 0);
  EXPECT_EQ(*v.n_stick, 0);
}

TEST_F(Verifier, ABodyThatIsOnlyMovedHasNoError) {
  Scene scene;
  scene.clearance_mm = 1;
  pose_scene(scene);
  EXPECT_LT(worst_measure(verified()).value, 1e-9);
  // … but a stress that is not there in truth is one.
  solution_.stress.assign(solution_.stress.size(), 0.1 * ElementStress::Ones());
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
  Scene scene;
  scene.crown_radius_mm.reset();
  scene.friction = 100;
  scene.displacement_mm = {0.02, 0};
  pose_scene(scene);
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

}  // namespace
}  // namespace airybench::verifier_test
