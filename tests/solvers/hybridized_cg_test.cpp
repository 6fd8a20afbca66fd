// HYBRID:CG against HYBRID, the same discrete problem by a factor; how its iterations grow.
#include <gtest/gtest.h>

#include "mesh/msh_format.hpp"
#include "mesh/refinement.hpp"
#include "solvers/contact/condensed.hpp"
#include "solvers/krylov/gmres.hpp"
#include "solvers/two_level/two_levels.hpp"
#include "tests/support/condensed_problem.hpp"
#include "tests/support/named_scenes.hpp"
#include "tests/support/places.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/random_scenes.hpp"
#include "tests/support/sanitized.hpp"
#include "tests/support/solved.hpp"

namespace airybench::hybridized_cg_test {
namespace {

using testing::posed, testing::small_rack, testing::small_tooth;

Solution solve(const char* method, const std::shared_ptr<const Problem>& problem,
               const RunControl& control = {}) {
  return testing::solved_by(method, contact_system(problem), control);
}

// As the harness begins with it.
RunControl first_control() {
  return testing::with_tolerance(select_methods("HYBRID:CG").front().first_tolerance *
                                 RunControl().target_error);
}

// The larger of the relative errors in stress and force, energy norms, HYBRID being right to 1e-10.
double true_error(const Problem& problem, const Solution& solution, const Solution& exact) {
  const ContactPoints contact = contact_system(std::make_shared<const Problem>(problem)).contact;
  const Eigen::MatrixXd D = testing::condensed(problem, contact).D;
  const double stress = std::sqrt(stress_norm_squared(problem, exact.stress)),
               force = D_norm(D, exact.F_C);
  const double off = stress_distance(problem, solution.stress, exact.stress),
               force_off = D_norm(D, solution.F_C - exact.F_C);
  return std::max(stress > 0 ? off / stress : off, force > 0 ? force_off / force : force_off);
}

testing::NamedScenes scenes() {
  return testing::scenes_named({"default", "frictionless", "friction 1", "friction 3, sheared",
                                "plane stress", "body force", "flat face", "clearance",
                                "nearly incompressible", "nothing touches"});
}

TEST(HybridizedCg, AgreesWithHybridAndItsEstimateIsHonest) {
  std::vector<Mesh> meshes = {small_tooth(8, 6), small_rack(2, 4, 3)};
  for (const char* name : {"Mesh0", "Mesh2"})
    if (!testing::sanitized) meshes.push_back(read_msh(testing::mesh_file(name)));
  for (const Mesh& mesh : meshes)
    for (const auto& [name, scene] : scenes()) {
      const auto problem = posed(scene, mesh);
      const Solution exact = solve("HYBRID", problem),
                     solution = solve("HYBRID:CG", problem, first_control());
      ASSERT_EQ(exact.status, Status::ok) << mesh.name << ' ' << name;
      ASSERT_EQ(solution.status, Status::ok) << mesh.name << ' ' << name << solution.message;
      const double error = true_error(*problem, solution, exact);
      EXPECT_LE(error, 1e-6) << mesh.name << ' ' << name;
      EXPECT_LE(error, std::max(1e-9, *solution.error_estimate)) << mesh.name << ' ' << name;
    }
}

// With ρ = 1/D_jj, and the displacements that its forces make. On layers of 1e-8 a rough ρ hid more
// than half of it.
TEST(HybridizedCg, ItsEstimateCoversTheContactLaw) {
  testing::NamedScenes all = scenes();
  for (const double stiffness : {1e-8, 1e-4, 1e4})
    all.emplace_back("layers", testing::layered_scene({1, 0}, stiffness));
  for (const Mesh& mesh : {small_tooth(8, 6), small_rack(2, 4, 3)})
    for (const auto& [name, scene] : all) {
      const auto problem = posed(scene, mesh);
      const ContactPoints contact = contact_points(*problem);
      const Solution solution = solve("HYBRID:CG", problem, first_control());
      if (!solution.error_estimate) continue;  // not converged
      const contact::Problem condensed = testing::condensed(*problem, contact);
      const double map = relative_natural_map(condensed, solution.F_C);
      EXPECT_LE(map, std::max(1e-9, 1.05 * *solution.error_estimate)) << mesh.name << ' ' << name;
    }
}

// To 1e-8, those of its check counted.
TEST(HybridizedCg, ItsIterationsDoNotGrowWithTheMesh) {
  constexpr int levels = testing::sanitized ? 3 : 4;
  for (const auto& [poisson, most] : {std::pair{0.3, 40}, {0.4999, 65}}) {
    Scene scene;
    scene.material.poisson = poisson;
    scene.friction = 0;
    scene.clearance_mm = 1;  // one linear system
    scene.body_force_N_per_mm3 = {3, -1};
    Mesh mesh = read_msh(testing::mesh_file("Mesh0"));
    std::vector<std::int64_t> counts;
    for (int level = 0; level < levels; ++level, mesh = uniformly_refined(mesh)) {
      const Solution solution =
          solve("HYBRID:CG", posed(scene, mesh), testing::with_tolerance(1e-8));
      ASSERT_EQ(solution.status, Status::ok) << solution.message;
      counts.push_back(*solution.linear_iterations);
      EXPECT_LE(counts.back(), most) << poisson << " at level " << level;
    }
    EXPECT_LE(counts.back(), counts[1] + 8) << poisson;
  }
}

TEST(HybridizedCg, WithContactItTakesAFewOfThem) {
  Mesh mesh = small_tooth(16, 12);
  for (int level = 0; level < 3; ++level, mesh = uniformly_refined(mesh)) {
    const Solution solution = solve("HYBRID:CG", posed({}, mesh), first_control());
    ASSERT_EQ(solution.status, Status::ok) << solution.message;
    EXPECT_LE(*solution.linear_iterations, 120) << level;
  }
}

// Pieces of edges, and sums, are the same for any number of threads.
TEST(HybridizedCg, ThreadsDoNotChangeTheAnswer) {
  Mesh mesh = testing::sanitized ? small_tooth(9, 7) : small_tooth(16, 12);  // 2 or 6 pieces
  for (int level = 0; level < 3; ++level) mesh = uniformly_refined(mesh);
  const auto problem = posed({}, mesh);
  const Solution alone = solve("HYBRID:CG", problem, first_control());
  ASSERT_EQ(alone.status, Status::ok) << alone.message;
  for (int threads = 2; threads <= (testing::sanitized ? 2 : 3); ++threads) {
    RunControl control = first_control();
    control.threads = threads;
    const Solution together = solve("HYBRID:CG", problem, control);
    ASSERT_EQ(together.status, Status::ok) << together.message;
    EXPECT_EQ(together.linear_iterations, alone.linear_iterations) << threads;
    EXPECT_LT(testing::force_error(together, alone), 1e-9) << threads;
    EXPECT_LT(testing::stress_error(*problem, together, alone), 1e-9) << threads;
  }
}

TEST(HybridizedCg, SaysWhichCoarseDisplacementsItChose) {
  for (const auto& [poisson, chosen] :
       {std::pair(0.3, "coarse=linear"), {0.49, "coarse=per-edge"}}) {
    Scene scene;
    scene.material.poisson = poisson;
    const Solution solution = solve("HYBRID:CG", posed(scene, small_tooth(4, 4)));
    EXPECT_TRUE(solution.parameters.starts_with(chosen)) << solution.parameters;
  }
}

// Ok and right, or honestly not ok.
TEST(HybridizedCg, RandomScenesAreSolvedOrItSaysThatTheyAreNot) {
  constexpr int scenes_tried = 60;
  const Mesh mesh = small_tooth(8, 6);
  int posed_scenes = 0, solved = 0;
  for (int number = 0; number < scenes_tried; ++number) {
    const Scene scene = testing::random_scene(19, number);
    std::shared_ptr<const Problem> problem;
    try {
      problem = posed(scene, mesh);
    } catch (const InputError&) {
      continue;
    }
    const Solution exact = solve("HYBRID", problem);
    if (exact.status != Status::ok) continue;
    ++posed_scenes;
    RunControl control = first_control();
    Solution solution = solve("HYBRID:CG", problem, control);
    control.tolerance /= 10;  // as the harness tightens it
    if (solution.status == Status::inaccurate) solution = solve("HYBRID:CG", problem, control);
    if (solution.status != Status::ok) continue;
    ++solved;
    const double size = std::sqrt(stress_norm_squared(*problem, exact.stress));
    if (size < 1e-6 || exact.F_C.norm() < 1e-6) continue;  // relative to the loads
    EXPECT_LE(true_error(*problem, solution, exact), 1e-5) << number << ": " << scene.about;
  }
  EXPECT_GE(solved, posed_scenes * 9 / 10) << posed_scenes;
}

TEST(TwoLevels, AreSymmetricAndAboveTheStiffness) {
  Mesh mesh = small_tooth(4, 3);
  for (const CoarseKind kind : {CoarseKind::linear, CoarseKind::per_edge}) {
    const ContactSystem airy = contact_system(posed({}, mesh));
    const HybridizedSystem system = assemble_hybridized(*airy.problem, airy.contact);
    const EdgeMatrix K = make_edge_matrix(*airy.problem, system);
    auto coarse = std::make_unique<CoarseDisplacements>(*airy.problem, airy.contact, K, kind);
    StageTimes times;
    coarse->factorise(coarse->galerkin(*airy.problem, K, system), {}, times);
    TwoLevelPreconditioner M(K, std::move(coarse));
    const std::vector<Eigen::Index> held = prescribed_slots(K, system.unknown);
    M.hold(held);
    std::srand(7);
    const auto random = [&] {
      Eigen::VectorXd x = Eigen::VectorXd::Random(K.slots());
      for (const Eigen::Index slot : held) x(slot) = 0;
      return x;
    };
    for (int i = 0; i < 20; ++i) {
      const Eigen::VectorXd a = random(), b = random();
      Eigen::VectorXd Ma, Mb, Ka, MKa;
      M.apply(a, Ma);
      M.apply(b, Mb);
      EXPECT_NEAR(a.dot(Mb), b.dot(Ma), 1e-9 * std::sqrt(a.dot(Ma) * b.dot(Mb)));
      K.multiply(a, Ka);
      for (const Eigen::Index slot : held) Ka(slot) = 0;
      M.apply(Ka, MKa);
      EXPECT_LE(Ka.dot(MKa), a.dot(Ka) * (1 + 1e-9));
      EXPECT_GT(Ka.dot(MKa), 0.02 * a.dot(Ka));
    }
  }
}

TEST(Gmres, SolvesANonsymmetricSystemInAsManyStepsAsItHasRows) {
  constexpr int n = 12;
  std::srand(3);
  const Eigen::MatrixXd A = 4 * Eigen::MatrixXd::Identity(n, n) + Eigen::MatrixXd::Random(n, n);
  const Eigen::VectorXd r = Eigen::VectorXd::Random(n), m = r.cwiseAbs() + Eigen::VectorXd::Ones(n);
  Eigen::VectorXd x;
  KrylovSpace space;
  const auto multiply = [&](const Eigen::VectorXd& v, Eigen::VectorXd& y) { y = A * v; };
  const auto divide = [&](const Eigen::VectorXd& v, Eigen::VectorXd& y) { y = v.cwiseQuotient(m); };
  const auto poison = [](const Eigen::VectorXd& v, Eigen::VectorXd& y) { y = v * NAN; };
  const GmresResult result =
      solve_by_gmres(multiply, divide, r, {.tolerance = 1e-12}, {}, space, x);
  EXPECT_LE(result.iterations, n);
  EXPECT_LT(testing::residual(A, x, r), 1e-9 * r.norm());
  EXPECT_THROW(solve_by_gmres(multiply, poison, r, {}, {}, space, x), Breakdown);
}

}  // namespace
}  // namespace airybench::hybridized_cg_test
