// HYBRID:k=…: the default tooth and others by stresses of every degree; the reference values as k
// grows, the contact law, loads and supports.
#include <gtest/gtest.h>

#include "assembly/elements/elasticity.hpp"
#include "assembly/elements/equilibrium_element.hpp"
#include "mesh/bisection.hpp"
#include "solvers/condensation/hybridized.hpp"
#include "solvers/contact/condensed.hpp"
#include "solvers/contact/linear_tractions.hpp"
#include "solvers/loading/load_steps.hpp"
#include "solvers/methods.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/exact_fields.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/sanitized.hpp"

namespace airybench::degrees_test {
namespace {

using testing::small_tooth;

struct Solved {
  ContactSystem system;
  Solution solution;
};

// The method's own estimate counts the contact law, equilibrium and the stresses.
Solved solved(const std::shared_ptr<const Problem>& problem, int degree,
              const std::string& name = "") {
  const Method method = select_methods(name.empty() ? hybrid_of_degree(degree) : name).front();
  EXPECT_EQ(method.degree, degree);
  ContactSystem system = contact_system(problem, degree);
  Solution solution = run(method, system, {});
  EXPECT_EQ(solution.status, Status::ok) << solution.message;
  EXPECT_LT(solution.error_estimate.value_or(1), 1e-8) << degree;  // 2e-9 on the graded tooth
  return {std::move(system), std::move(solution)};
}

double energy(const Solved& s) {
  return stress_norm_squared(*s.system.problem, s.solution.stress) / 2;
}

Eigen::Vector2d resultant(const Solved& s) {
  const int m = s.system.contact.components;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int i = 0; i < s.solution.F_C.size(); ++i) sum(i % m) += s.solution.F_C(i);
  return sum;
}

// Newton's method starts from the answer in linear tractions: the same answer in fewer steps of
// full size than from zero.
TEST(Degrees, ContactStartsFromLinearTractions) {
  Mesh mesh = small_tooth(8, 6);
  mesh = bisected(mesh, std::vector<int>(mesh.triangles.size(), 2)).mesh;
  Scene scene;
  scene.friction = 0.3;
  for (const int degree : {2, 3, 4}) {
    const Method method = select_methods(hybrid_of_degree(degree)).front();
    contact::Problem problem;
    RunControl control;
    control.contact.by = [&](const contact::Problem& condensed) {
      problem = condensed;
      return solve_contact(condensed);
    };
    run(method, contact_system(testing::posed(scene, mesh), degree), control);
    ASSERT_TRUE(has_linear_tractions(problem));
    const contact::Problem linear = in_linear_tractions(problem);
    EXPECT_EQ(linear.points.count * (degree + 1), problem.points.count * 2);
    EXPECT_FALSE(has_linear_tractions(linear));
    ContactOptions from_linear, from_zero;
    const Eigen::VectorXd F1 = solve_contact(linear).F_C;
    from_linear.start = of_linear_tractions(problem.points, F1);
    from_zero.start = Eigen::VectorXd::Zero(problem.points.size());
    const auto sums = [](const Eigen::VectorXd& F) {
      return Eigen::Vector2d(F.reshaped(2, F.size() / 2).rowwise().sum());
    };
    EXPECT_LT((sums(from_linear.start) - sums(F1)).norm(), 1e-12 * F1.norm());
    const ContactResult near = solve_contact(problem, from_linear),
                        far = solve_contact(problem, from_zero);
    ASSERT_TRUE(near.converged && far.converged) << degree;
    EXPECT_LT((near.F_C - far.F_C).norm(), 1e-9 * far.F_C.norm()) << degree;
    EXPECT_LT(near.active_set_steps, far.active_set_steps) << degree;
  }
}

// Linear stresses with tractions, displacements and body force; no contact.
TEST(Degrees, LinearStressesAreExactForEveryDegree) {
  constexpr double young = 210000, poisson = 0.3;
  const Mesh mesh =
      testing::with_role(small_tooth(2, 2), BoundaryRole::contact, BoundaryRole::force);
  for (const testing::ExactField& exact : testing::exact_fields(young, poisson)) {
    const auto problem = std::make_shared<const Problem>(make_problem(
        mesh, {compliance({young, poisson}, Plane::stress)}, testing::loads_of(exact), 0));
    for (int k = 1; k <= highest_stress_degree; ++k) {
      const StressField stress = solved(problem, k).solution.stress;
      double off = 0, size = 0;
      for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
        for (int i = 0; i < 3; ++i) {
          const Eigen::Vector3d expected = exact.stress(problem->vertices_of(t).col(i));
          const Eigen::Vector3d own = stress.corners(t).col(3 * i);
          off = std::max(off, (own - expected).cwiseAbs().maxCoeff());
          size = std::max(size, expected.cwiseAbs().maxCoeff());
        }
      EXPECT_LT(off, 1e-9 * size) << exact.name << ' ' << k;
    }
  }
}

// Smaller towards the corners, where the stress has singularities, and where points open or slip.
Mesh graded_tooth() {
  const std::array<Eigen::Vector2d, 4> corners = {Eigen::Vector2d(0, -5), Eigen::Vector2d(0, 5),
                                                  Eigen::Vector2d(10, -3), Eigen::Vector2d(10, 3)};
  return bisected(small_tooth(2, 2),
                  [&](const TrianglePart& part) {
                    const auto& [a, b, c] = part.corners;
                    const Eigen::Vector2d centre = (a + b + c) / 3;
                    double allowed = 10 - centre.x() < 0.2 ? 0.1 : 2;
                    for (const Eigen::Vector2d& corner : corners)
                      allowed = std::min(allowed, std::max(0.01, 0.7 * (centre - corner).norm()));
                    return std::max({(a - b).norm(), (b - c).norm(), (c - a).norm()}) > allowed;
                  })
      .mesh;
}

// The reference values are those of stresses of degree 7 on a graded mesh.
TEST(Degrees, TendsToTheReferenceValuesOfTheTooth) {
  struct Expected {
    double friction;
    Eigen::Vector2d resultant_N;
    double energy_Nmm;
  };
  const Expected cases[] = {{0.2, {-2910.0265, -196.4404}, 27.2027517},
                            {0, {-2905.9981, 0}, 26.5292017}};
  for (const Expected& expected : cases) {
    Scene scene;
    scene.friction = expected.friction;
    const auto problem = testing::posed(scene, graded_tooth());
    constexpr int highest = testing::sanitized ? 2 : highest_stress_degree;
    for (int k = 1; k <= highest; ++k) {
      const Solved answer = solved(problem, k);
      EXPECT_LT((resultant(answer) - expected.resultant_N).norm(), k == 1 ? 0.3 : 0.03) << k;
      EXPECT_NEAR(energy(answer), expected.energy_Nmm, k == 1 ? 6e-3 : 1e-4) << k;
    }
  }
}

TEST(Degrees, AreSolvedByEveryFactorAlike) {
  const auto problem = testing::posed(Scene{}, small_tooth(4, 3));
  for (const int k : {2, 3}) {
    const Solved own = solved(problem, k);
    for (const char* factor : {"CHOLMOD", "MUMPS"}) {
      const Solved other =
          solved(problem, k, std::string("HYBRID:") + factor + ",k=" + std::to_string(k));
      EXPECT_LT((own.solution.F_C - other.solution.F_C).norm(), 1e-9 * own.solution.F_C.norm());
    }
  }
}

// Pressed, sheared and brought back: at every step forces, energy and what friction takes.
std::vector<Eigen::Vector4d> along_a_path(const Mesh& mesh, int degree) {
  Scene scene;
  scene.displacement_mm = {0.02, 0};
  scene.later_steps.resize(2);
  scene.later_steps[0].displacement_mm = Eigen::Vector2d(0.02, 0.012);
  scene.later_steps[1].displacement_mm = Eigen::Vector2d(0.02, 0);
  std::vector<Eigen::Vector4d> path;
  solve_load_steps(select_methods(hybrid_of_degree(degree)).front(), testing::posed(scene, mesh),
                   {}, [&](int, const ContactSystem& system, const Solution& answer) {
                     EXPECT_EQ(answer.status, Status::ok) << answer.message;
                     EXPECT_LT(answer.error_estimate.value_or(1), 1e-8) << degree;
                     const Solved step{system, answer};
                     const Eigen::Vector2d sum = resultant(step);
                     path.emplace_back(sum.x(), sum.y(), energy(step),
                                       dissipation_Nmm(system, answer));
                   });
  return path;
}

TEST(Degrees, HaveLoadStepsWithFriction) {
  constexpr int highest = testing::sanitized ? 2 : highest_stress_degree;
  const std::vector<Eigen::Vector4d> fine = along_a_path(graded_tooth(), highest);
  ASSERT_EQ(fine.size(), 3u);
  EXPECT_GT(fine[1](3), 0.1);
  const auto off = [&](const Mesh& mesh, int degree) {
    Eigen::Vector4d worst = Eigen::Vector4d::Zero();
    const std::vector<Eigen::Vector4d> path = along_a_path(mesh, degree);
    for (std::size_t step = 0; step < fine.size(); ++step)
      worst = worst.cwiseMax((path[step] - fine[step]).cwiseAbs());
    return worst;
  };
  // On the fine mesh all agree; on a coarse one they are the nearer the higher the degree, until
  // the edges' length limits what of slip and stick they can tell apart.
  Eigen::Vector4d allowed = Eigen::Vector4d::Constant(1e3);
  for (int k = 1; k <= highest; ++k) {
    const Eigen::Vector4d on_fine = off(graded_tooth(), k), on_coarse = off(small_tooth(4, 3), k);
    EXPECT_LT(on_fine.head(2).norm(), k == 1 ? 0.4 : 0.06) << k;
    EXPECT_LT(on_fine(2), k == 1 ? 8e-3 : 2e-4) << k;
    EXPECT_LT(on_fine(3), k == 1 ? 1e-3 : 1e-4) << k;
    EXPECT_TRUE((on_coarse.array() < allowed.array()).all()) << k << ": " << on_coarse;
    allowed = 0.9 * (k == 1 ? on_coarse : allowed);
  }
}

TEST(Degrees, AreRefusedWhereTheyAreNot) {
  const std::string above = std::to_string(highest_stress_degree + 1),
                    allowed = "1 to " + std::to_string(highest_stress_degree);
  for (const auto& [options, wrong, valid] : std::vector<std::array<std::string, 3>>{
           {"k=" + above, "k='" + above + "'", allowed},
           {"k=1.5", "k='1.5'", allowed},
           {"CG,k=2", "'CG'", "CHOLMOD, MUMPS, PDAS, k=<degree>"},
           {"k=2,refine=yes", "unknown option 'refine'", "(valid: k)"}}) {
    const std::string name = "HYBRID:" + options;
    testing::expect_named(
        testing::complaint_of<std::invalid_argument>([&] { select_methods(name); }),
        {"method '" + name + "': " + wrong, valid});
  }
}

}  // namespace
}  // namespace airybench::degrees_test
