// The constitutive relation error: an identity, signs, bounds, and that it sees what is spoiled.
#include "verify/discretisation_error.hpp"
#include "assembly/problem/pose.hpp"

#include <numeric>

#include "assembly/control_points.hpp"
#include "assembly/total_displacement.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/exact_fields.hpp"
#include "tests/support/small_meshes.hpp"
#include "tests/verify/solved_body.hpp"
#include "verify/verifier.hpp"

namespace airybench::discretisation_error_test {
namespace {

struct Solved : testing::Solved {
  Solution displacements = p2();

  using testing::Solved::Solved;
  ConstitutiveError error() const { return error_with(testing::displacement(displacements)); }
};

std::vector<Scene> scenes() {
  std::vector<Scene> all;
  for (const double mu : {0.0, 0.2, 1.0})
    for (const Eigen::Vector2d& body_force : {Eigen::Vector2d(0, 0), Eigen::Vector2d(30, -10)})
      for (const double clearance : {0.0, 0.01}) {
        all.push_back(
            {.friction = mu, .clearance_mm = clearance, .body_force_N_per_mm3 = body_force});
      }
  return all;
}

double value_at(std::vector<double> c, double s) {
  for (std::size_t step = 1; step < c.size(); ++step)
    for (std::size_t i = 0; i + step < c.size(); ++i) c[i] = (1 - s) * c[i] + s * c[i + 1];
  return c[0];
}

// ∫ μ|σ_n||u_t| over Γ_C by the midpoint rule. u: with the rigid motion.
double friction_work(const testing::Solved& s, const DisplacementField& u) {
  constexpr int steps = 2000;
  const Problem& problem = *s.system.problem;
  const ContactPoints& contact = s.system.contact;
  if (contact.components == 1) return 0;
  const int k = s.system.degree;
  double sum = 0;
  for (int p = 0; p < contact.count; p += k + 1) {
    const int row = contact.boundary[p];
    const auto [start, end] = problem.mesh.boundary[row].vertices;
    const EdgeFrame frame = edge_frame(problem.mesh.vertices[start], problem.mesh.vertices[end]);
    std::vector<double> u_t, force;
    with_degree(k, [&](auto degree) {
      for (const int node : boundary_nodes<degree + 1>(problem, row))
        u_t.push_back(frame.tangent.dot(u.col(node)));
      return 0;
    });
    for (int j = 0; j <= k; ++j) force.push_back(s.hybrid.F_C(2 * (p + j)));
    for (int i = 0; i < steps; ++i) {
      const double x = (i + 0.5) / steps;
      sum += (k + 1.) / steps * contact.friction_at(p) * std::abs(value_at(force, x)) *
             std::abs(value_at(u_t, x));
    }
  }
  return sum;
}

// e² = 2 (Π(u) + Π*(σ) + ∫ μ|σ_n||u_t|), of no part negative.
void expect_identity(const testing::Solved& s, const DisplacementField& u) {
  const ConstitutiveError error = s.error_with(u);
  const double squared = error.squared_Nmm(), rounding = 1e-9 * squared,  // contact is met to 1e-12
      gap = error.upper_bound_Nmm - error.lower_bound_Nmm,
               friction = friction_work(s, with_rigid_motion(*s.system.problem, u));
  EXPECT_EQ(error.flaw, "");
  EXPECT_EQ(error.guaranteed, !s.system.problem->has_friction());
  EXPECT_NEAR(squared, 2 * (gap + friction),
              1e-6 * std::max(squared, friction) + 1e-10 * std::abs(error.upper_bound_Nmm));
  EXPECT_GT(error.body_Nmm, 0);
  EXPECT_GE(error.normal_contact_Nmm, -rounding);
  EXPECT_GE(error.tangential_contact_Nmm, -rounding);
  for (const double part : error.of_triangle_Nmm) EXPECT_GT(part, -rounding);
  EXPECT_NEAR(std::accumulate(error.of_triangle_Nmm.begin(), error.of_triangle_Nmm.end(), 0.),
              squared, 1e-12 * squared);
}

TEST(ConstitutiveError, IsTwiceTheEnergyGapWithTheFrictionWorkAndTheSumOfTheTriangles) {
  for (const Scene& scene : scenes())
    for (int k = 1; k <= highest_stress_degree; ++k) {
      SCOPED_TRACE(::testing::Message() << "friction " << scene.friction << ", degree " << k);
      const testing::Solved s(scene, testing::small_tooth(3, 3), k);
      expect_identity(s, s.w);
      if (k == 1) expect_identity(s, testing::displacement(s.p2()));
    }
}

TEST(ConstitutiveError, RefusesADisplacementOfAnotherDegree) {
  const testing::Solved s(Scene{}, testing::small_tooth(2, 2), 2);
  const DisplacementField quadratic =
      DisplacementField::Zero(2, displacement_nodes(*s.system.problem, 2));
  try {
    s.error_with(quadratic);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "a displacement of degree 2 for stresses of degree 2 (allowed: 3)");
  }
}

// True errors by the energies of stresses of degree 7 on a graded mesh: without friction
// ‖σ − σ_exact‖² ≤ 2 (Π*(σ) − Π*(σ_exact)).
TEST(ConstitutiveError, OfEveryDegreeItIsNearTheTrueError) {
  constexpr double exact_Nmm = 26.5292017;
  for (int k = 1; k <= highest_stress_degree; ++k) {
    const testing::Solved s({.friction = 0}, testing::catalogue_mesh("Mesh0"), k);
    const ConstitutiveError error = s.error();
    EXPECT_TRUE(error.guaranteed) << k;
    EXPECT_LT(error.lower_bound_Nmm, exact_Nmm);
    EXPECT_GT(error.upper_bound_Nmm, exact_Nmm);
    const double ratio = std::sqrt(error.squared_Nmm() / (2 * (exact_Nmm - error.lower_bound_Nmm)));
    EXPECT_GT(ratio, 1) << k;
    EXPECT_LT(ratio, 2) << k;
  }
}

// Constant stress with a shear τ between a body and a wall; slid along it by so many mm.
Solved exact_solution(double tau, double slip) {
  constexpr double young = 2000, poisson = 0.3, mu = 0.25;
  const Eigen::Matrix3d c = compliance({young, poisson}, Plane::stress);
  const Eigen::Vector3d stress(-100, -100 * poisson, tau), strain = c * stress;
  testing::ExactField exact;
  exact.body_force.setZero();
  exact.stress = [=](const Eigen::Vector2d&) { return stress; };
  exact.displacement = [=](const Eigen::Vector2d& x) {
    return Eigen::Vector2d(strain(0) * (x.x() - 10), strain(2) * (x.x() - 10) + slip);
  };
  return Solved(make_problem(testing::small_tooth(5, 4), {c}, testing::loads_of(exact), mu));
}

TEST(ConstitutiveError, IsZeroWhereBothSolutionsAreExact) {
  for (const auto& [tau, slip] : {std::pair{10.0, 0.0}, {25.0, -0.5}, {-25.0, 0.3}}) {
    const Solved s = exact_solution(tau, slip);
    const ConstitutiveError error = s.error();
    const double squared = stress_norm_squared(*s.system.problem, s.hybrid.stress);
    EXPECT_LT(error.body_Nmm, 1e-18 * squared) << tau;
    // First order in the rounding of the contact law.
    EXPECT_LT(std::abs(error.normal_contact_Nmm), 1e-11 * squared) << tau;
    EXPECT_LT(std::abs(error.tangential_contact_Nmm), 1e-11 * squared) << tau;
  }
}

// A friction force a little too large makes e² negative.
TEST(ConstitutiveError, BelowZeroByRoundingItIsThatRounding) {
  const Solved s = exact_solution(25, -0.5);
  const auto error = [&](double excess) {
    Eigen::VectorXd F_C = s.hybrid.F_C;
    for (Eigen::Index t = 1; t < F_C.size(); t += 2) F_C(t) *= 1 + excess;
    return constitutive_error(s.system, s.hybrid.stress, F_C,
                              testing::displacement(s.displacements));
  };
  const ConstitutiveError rounded = error(1e-12), wrong = error(1e-6);
  EXPECT_LT(rounded.squared_Nmm(), 0);
  EXPECT_EQ(rounded.flaw, "");
  EXPECT_GT(rounded.relative, 0);
  EXPECT_LT(rounded.relative, 1e-5);
  EXPECT_TRUE(testing::contains(wrong.flaw, "e² is"));
}

TEST(ConstitutiveError, AFieldThatIsNotAdmissibleGuaranteesNothing) {
  const Solved s({.friction = 0}, testing::small_tooth(6, 5));
  DisplacementField through_the_wall = testing::displacement(s.displacements);
  through_the_wall.row(0).array() += 0.01;
  const auto error = [&](const Eigen::VectorXd& F_C, const DisplacementField& u) {
    return constitutive_error(s.system, s.hybrid.stress, F_C, u);
  };
  EXPECT_FALSE(error(s.hybrid.F_C, through_the_wall).guaranteed);
  EXPECT_LT(error(s.hybrid.F_C, through_the_wall).normal_contact_Nmm, 0);
  Eigen::VectorXd pulling = s.hybrid.F_C;
  pulling(0) = 10;
  EXPECT_FALSE(error(pulling, testing::displacement(s.displacements)).guaranteed);
  DisplacementField no_number = testing::displacement(s.displacements);
  no_number(0, 3) = std::nan("");
  EXPECT_FALSE(error(s.hybrid.F_C, no_number).guaranteed);
  EXPECT_EQ(error(s.hybrid.F_C, no_number).flaw, "stresses or displacements are not finite");
}

TEST(ConstitutiveError, WithNextToNoStressItIsRelativeToTheLoads) {
  const ConstitutiveError error = Solved({.clearance_mm = 1}, testing::small_tooth(6, 5)).error();
  EXPECT_LT(error.relative, 1e-9);
}

// The verifier of displacement methods.

TEST(DisplacementVerifier, AcceptsARightSolution) {
  for (const Scene& scene : scenes()) {
    const Solved s(scene, testing::small_tooth(6, 5));
    const Verification v = verify_displacement(s.system, s.displacements);
    EXPECT_LT(worst_measure(v).value, 1e-10);
    EXPECT_FALSE(v.error_stress);
    EXPECT_FALSE(v.error_force);
    EXPECT_FALSE(v.complementary_energy_Nmm);
    EXPECT_EQ(*v.n_open + *v.n_stick + *v.n_slip, 11);  // five edges, six vertices
  }
}

TEST(DisplacementVerifier, FindsWhatIsSpoiled) {
  const Solved s(Scene{}, testing::small_tooth(6, 5));
  const auto worst = [&](auto spoil) {
    Solution solution = s.displacements;
    spoil(solution);
    return worst_measure(verify_displacement(s.system, solution)).value;
  };
  for (Eigen::Index node = 0; node < testing::displacement(s.displacements).cols(); ++node)
    EXPECT_GT(worst([&](Solution& x) { std::get<Displacements>(x.unknowns).w(1, node) += 1e-5; }),
              1e-4)
        << node;
  for (Eigen::Index i = 0; i < s.displacements.F_C.size(); ++i)
    EXPECT_GT(worst([&](Solution& x) { x.F_C(i) += 1; }), 1e-5) << i;
  EXPECT_TRUE(std::isnan(
      worst([](Solution& x) { std::get<Displacements>(x.unknowns).w(0, 40) = std::nan(""); })));
}

// Equilibrium and contact law say nothing of a displacement that is right for another one given.
TEST(DisplacementVerifier, ComparesWithTheGivenDisplacement) {
  const auto stretched = [](double by_mm) {
    Scene scene;
    scene.boundary["displacement:root"].displacement_mm = {
        .values = {Eigen::Vector2d(0.02, -by_mm), {0.02, by_mm}}, .at_mm = {{{0, 0}, {0, 10}}}};
    return Solved(scene, testing::small_block(6, 6, 0));
  };
  const Solved s = stretched(1e-3), other = stretched(1.1e-3);
  const auto worst = [&](const Solved& answer, double printed = 0) {
    Solution solution = answer.displacements;
    if (printed > 0)
      std::get<Displacements>(solution.unknowns).by_program.emplace().print_precision = printed;
    return worst_measure(verify_displacement(s.system, solution)).value;
  };
  EXPECT_LT(worst(s), 1e-10);
  EXPECT_GT(worst(other), 1e-4);
  EXPECT_LT(worst(s, 5e-7), 1e-10);
  EXPECT_GT(worst(other, 5e-7), 1e-4);
}

// Between a floor and a ramp: without friction the force at their common vertex may have any
// direction between their normals, but for P2, whose law has their mean.
TEST(DisplacementVerifier, LeavesAProgramTheDirectionOfTheForceInACornerOfTwoWalls) {
  constexpr double pressure_MPa = 10;
  Scene scene{.friction = 0};
  scene.crown_radius_mm.reset();
  for (const char* group : {"force:flank", "force:side"})
    scene.boundary[group].pressure_MPa.emplace().values.fill(pressure_MPa);
  const auto problem = std::make_shared<const Problem>(
      pose(scene, read_msh(testing::source_folder() / "bench/scenes/check/block.msh")));
  const ContactSystem system = contact_system(problem);
  const auto vertices = static_cast<Eigen::Index>(problem->mesh.vertices.size());
  const auto unbalanced = [&](const Eigen::Matrix2d& gradient, bool is_of_program) {
    Solution solution;
    DisplacementField w(2, displacement_nodes(*problem));
    for (Eigen::Index node = 0; node < w.cols(); ++node) {
      Eigen::Vector2d at;
      if (node < vertices) {
        at = problem->mesh.vertices[node];
      } else {
        const auto& [a, b] = problem->edges.vertices[node - vertices];
        at = (problem->mesh.vertices[a] + problem->mesh.vertices[b]) / 2;
      }
      w.col(node) = gradient * at;
    }
    solution.stress = stress_of_displacement(*problem, w);
    solution.F_C = contact_reactions(*problem, control_points(*problem), w);
    solution.unknowns = Displacements{w};
    if (is_of_program) std::get<Displacements>(solution.unknowns).by_program.emplace();
    return *verify_displacement(system, solution).equilibrium_residual;
  };
  const Eigen::Vector3d strain =
      problem->compliance_of(0) * Eigen::Vector3d(-pressure_MPa, -pressure_MPa, 0);
  Eigen::Matrix2d pressed = strain(0) * Eigen::Matrix2d::Identity();
  EXPECT_LT(unbalanced(pressed, true), 1e-12);
  EXPECT_GT(unbalanced(pressed, false), 1e-3);
  pressed(0, 1) += strain(0);  // shear, which the walls do not take
  EXPECT_GT(unbalanced(pressed, true), 1e-3);
  EXPECT_GT(unbalanced(-strain(0) * Eigen::Matrix2d::Identity(), true), 1e-3);  // they do not pull
}

}  // namespace
}  // namespace airybench::discretisation_error_test
