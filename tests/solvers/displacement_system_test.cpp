// P2, P3, P4 are other discrete problems than all the others: exactness where the exact field has
// their degree, admissibility, and their own contact law.
#include "solvers/displacement/displacement_system.hpp"

#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <complex>

#include "assembly/control_points.hpp"
#include "assembly/elements/edge_forces.hpp"
#include "assembly/total_displacement.hpp"
#include "solvers/loading/load_steps.hpp"
#include "tests/support/exact_fields.hpp"
#include "tests/support/far_from_origin.hpp"
#include "tests/support/method_names.hpp"
#include "tests/support/pieces.hpp"
#include "tests/support/polynomial.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/solved.hpp"

namespace airybench::displacement_system_test {
namespace {

using testing::displacement_deviation, testing::posed, testing::small_tooth;
constexpr double young = 2000, poisson = 0.3;

class Displacements : public ::testing::TestWithParam<Method> {
 protected:
  const int k = GetParam().degree, p = k + 1;

  ContactSystem assembled(const std::shared_ptr<const Problem>& problem) const {
    return contact_system(problem, k);
  }
  Solution solve(const std::shared_ptr<const Problem>& problem,
                 const RunControl& control = {}) const {
    return run(GetParam(), assembled(problem), control);
  }
};
INSTANTIATE_TEST_SUITE_P(Degrees, Displacements, ::testing::ValuesIn(select_methods("P2,P3,P4")),
                         testing::readable);

TEST_P(Displacements, ReproduceQuadraticFieldsExactlyWithBodyForceAndTractions) {
  const Mesh mesh =
      testing::with_role(small_tooth(5, 4), BoundaryRole::contact, BoundaryRole::force);
  for (const testing::ExactField& exact : testing::exact_fields(young, poisson)) {
    const auto problem = std::make_shared<const Problem>(make_problem(
        mesh, {compliance({young, poisson}, Plane::stress)}, testing::loads_of(exact), 0.2));
    const Solution solution = solve(problem);
    ASSERT_EQ(solution.status, Status::ok) << solution.message;
    EXPECT_LT(displacement_deviation(*problem, testing::displacement(solution), exact), 1e-11)
        << exact.name;
    EXPECT_LT(testing::stress_deviation(*problem, solution.stress, exact), 1e-10) << exact.name;
    EXPECT_EQ(solution.F_C.size(), 0);
    EXPECT_FALSE(solution.contact_iterations);  // no contact loop
    EXPECT_FALSE(solution.times[Stage::contact]);
  }
}

using Complex = std::complex<double>;
Complex power(Complex z, int n) { return n == 0 ? 1 : z * power(z, n - 1); }

// 2G u = κ φ(z) − z conj(φ'(z)), which needs no body force; plane strain.
template <typename Function, typename Derivative>
auto displacement_of(double nu, Function phi, Derivative of_phi) {
  return [=](const Eigen::Vector2d& x) -> Eigen::Vector2d {
    const Complex z(x.x() / 10, x.y() / 10), u = (3 - 4 * nu) * phi(z) - z * std::conj(of_phi(z));
    return {u.real(), u.imag()};
  };
}

// The discrete solution between boundary values that interpolate u; no loads, all of the boundary
// held.
template <int p, typename Function>
DisplacementField between_values_of(const Function& u, const Problem& problem) {
  DisplacementSystem system = assemble_displacement_system(problem, p);
  system.given.u = testing::interpolated(problem, p, u);
  for (std::size_t node = 0; node < system.given.at.size(); ++node)
    if (!system.given.at[node]) system.given.u.col(static_cast<Eigen::Index>(node)).setZero();
  const Eigen::VectorXd b =
      unbalanced_forces(problem, system, nodal_forces(problem, system.given.u), {});
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(lower_triangle(system.K));
  return displacement_field(problem, system, factor.solve(b));
}

Problem held_all_around(int cells, double nu) {
  Mesh mesh = small_tooth(cells, cells);
  for (BoundaryEdge& edge : mesh.boundary) edge.role = BoundaryRole::displacement;
  return make_problem(mesh, {compliance({young, nu}, Plane::strain)}, {}, 0);
}

TEST_P(Displacements, ReproducePolynomialsOfTheirDegreeUpToIncompressibility) {
  with_degree(k, [&](auto stress_degree) {
    constexpr int degree = stress_degree + 1;
    for (const double nu : {0.3, 0.4999}) {
      const Problem problem = held_all_around(3, nu);
      const auto exact = displacement_of(
          nu, [n = degree](Complex z) { return power(z, n); },
          [n = degree](Complex z) { return power(z, n - 1) * double(n); });
      const DisplacementField expected = testing::interpolated(problem, degree, exact);
      EXPECT_LT((between_values_of<degree>(exact, problem) - expected).norm(),
                (nu > 0.4 ? 1e-9 : 1e-12) * expected.norm())
          << nu;
    }
  });
}

TEST_P(Displacements, AreOfTheNextOrderWhereTheSolutionIsSmooth) {
  with_degree(k, [&](auto stress_degree) {
    constexpr int degree = stress_degree + 1;
    const auto wave = [](Complex z) { return std::exp(2. * z); };
    const auto of_wave = [](Complex z) { return 2. * std::exp(2. * z); };
    const auto exact = displacement_of(poisson, wave, of_wave);
    std::array<double, 2> error{};
    for (const int finer : {0, 1}) {
      const Problem problem = held_all_around(finer == 1 ? 8 : 4, poisson);
      const DisplacementField u = between_values_of<degree>(exact, problem);
      for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t) {
        const Eigen::Vector3d lambda(0.2, 0.5, 0.3);
        error[finer] += problem.area_mm2(t) * (displacement_at(problem, u, t, lambda) -
                                               exact(problem.vertices_of(t) * lambda))
                                                  .squaredNorm();
      }
    }
    EXPECT_NEAR(std::log2(error[0] / error[1]) / 2, degree + 1, 0.5);
  });
}

// Pressed between three rollers and a wall that is met everywhere: u is cubic, and quadratic on
// every edge of the block. φ = c (x⁴ − y⁴) has no shear.
TEST_P(Displacements, FromDegreeThreeOnACubicFieldAgainstAWallIsExact) {
  constexpr double c = 0.1;
  const Eigen::Matrix3d C = compliance({young, poisson}, Plane::strain);
  const double e = 12 * c * C(0, 0), cross = -12 * c * C(0, 1);  // ε_xx = −e y² − cross x²
  testing::ExactField exact;
  exact.body_force.setZero();
  exact.stress = [=](const Eigen::Vector2d& x) {
    return Eigen::Vector3d(-12 * c * x.y() * x.y(), 12 * c * x.x() * x.x(), 0);
  };
  exact.displacement = [=](const Eigen::Vector2d& x) {
    return Eigen::Vector2d(-e * x.x() * x.y() * x.y() - cross * std::pow(x.x(), 3) / 3,
                           e * x.x() * x.x() * x.y() + cross * std::pow(x.y(), 3) / 3);
  };
  Mesh mesh = testing::with_role(testing::small_block(3, 3, 0), BoundaryRole::force,
                                 BoundaryRole::displacement);
  Loads loads;
  loads.displacement_mm = [&](const Eigen::Vector2d& x, int) { return exact.displacement(x); };
  loads.gap_mm = [&](const Eigen::Vector2d& x, int) { return exact.displacement(x).x(); };
  for (const BoundaryEdge& edge : mesh.boundary)
    loads.rollers.push_back(edge.role == BoundaryRole::displacement);
  const auto problem = std::make_shared<const Problem>(make_problem(mesh, {C}, loads, 0));
  const Solution solution = solve(problem);
  ASSERT_EQ(solution.status, Status::ok) << solution.message;
  const double off = displacement_deviation(*problem, testing::displacement(solution), exact);
  if (p == 2)
    EXPECT_GT(off, 1e-4);
  else
    EXPECT_LT(off, 1e-10);
  if (p > 2) {
    EXPECT_LT(testing::stress_deviation(*problem, solution.stress, exact), 1e-9);
    EXPECT_NEAR(solution.F_C.sum(), -4 * c * 1000, 1e-7);  // ∫ −12 c y² dy
  }
}

TEST_P(Displacements, NowherePenetrateTheWallAndMeetWhatIsPrescribed) {
  for (const double mu : {0.0, 0.2, 1.0})
    for (const Eigen::Vector2d& body_force : {Eigen::Vector2d(0, 0), Eigen::Vector2d(30, -10)}) {
      Scene scene;
      scene.friction = mu;
      scene.body_force_N_per_mm3 = body_force;
      const auto problem = posed(scene);
      const Solution solution = solve(problem);
      ASSERT_EQ(solution.status, Status::ok) << solution.message;
      const DisplacementField field = with_rigid_motion(*problem, testing::displacement(solution));
      double closest = -1;
      for (int row = 0; row < static_cast<int>(problem->mesh.boundary.size()); ++row) {
        const BoundaryEdge& edge = problem->mesh.boundary[row];
        if (edge.role == BoundaryRole::force) continue;
        const auto &a = problem->mesh.vertices[edge.vertices[0]],
                   &b = problem->mesh.vertices[edge.vertices[1]];
        std::vector<Eigen::Vector2d> coefficients;
        with_degree(k, [&](auto stress_degree) {
          for (const int node : boundary_nodes<stress_degree + 1>(*problem, row))
            coefficients.emplace_back(field.col(node));
        });
        for (int i = 0; i <= 100; ++i) {
          const double s = i / 100.;
          const Eigen::Vector2d x = (1 - s) * a + s * b, u = bernstein_value(coefficients, s);
          if (edge.role == BoundaryRole::displacement) {
            EXPECT_LT((u - scene.displacement_mm).norm(), 1e-15);
          } else {
            const double r = edge_frame(a, b).normal.dot(u) - problem->loads.gap_mm(x, row);
            EXPECT_LE(r, 1e-13) << "at y = " << x.y();
            closest = std::max(closest, r);
          }
        }
      }
      EXPECT_GT(closest, -1e-12);  // it does touch
    }
}

TEST_P(Displacements, ContactForcesBalanceReactionsAndLoads) {
  Scene scene;
  scene.body_force_N_per_mm3 = {3, -1};
  const auto problem = posed(scene);
  const DisplacementSystem system = assemble_displacement_system(*problem, p);
  const Solution solution = solve(problem);
  // Reactions from the definition: Σ over all nodes of the elements' forces is zero.
  Eigen::Vector2d reactions = Eigen::Vector2d::Zero(), contact = Eigen::Vector2d::Zero();
  const auto& triangle = DisplacementTriangle::of_degree(p);
  for (int t = 0; t < static_cast<int>(problem->mesh.triangles.size()); ++t) {
    const auto K = triangle.stiffness(TriangleShape(problem->vertices_of(t)),
                                      elasticity_of(problem->compliance_of(t)));
    const auto nodes = triangle_nodes(*problem, p, t);
    const Eigen::VectorXd force =
        K * of_triangle(*problem, p, testing::displacement(solution), t).reshaped();
    for (int m = 0; m < triangle.nodes; ++m)
      if (system.given.at[nodes[m]]) reactions += force.segment<2>(2 * m);
  }
  const Eigen::Matrix2Xd loads = nodal_loads(*problem, p);
  for (Eigen::Index node = 0; node < loads.cols(); ++node)
    if (system.given.at[node]) reactions -= loads.col(node);
  for (int i = 0; i < system.control.law.count; ++i)  // n = x, s = y on the tip
    contact += solution.F_C.segment<2>(2 * i);
  const Eigen::Vector2d weight = 80 * scene.body_force_N_per_mm3;
  EXPECT_LT((reactions + contact + weight).norm(), 1e-9 * reactions.norm());
}

// Without friction the energy is above that of degrees_test.cpp's graded mesh, the nearer the
// higher the degree; the forces are HYBRID's.
TEST(DisplacementDegrees, AreNearerToTheEnergyOfTheToothOneByOne) {
  constexpr double energy_Nmm = 26.5292017;
  double before = 1;
  for (int degree = 2; degree <= 4; ++degree)
    for (const double friction : {0., 0.2}) {
      Scene scene;
      scene.friction = friction;
      const auto problem = posed(scene, small_tooth(12, 9));
      const ContactSystem system = contact_system(problem, degree - 1);
      const Solution own = testing::solved_by(displacements_of_degree(degree), system),
                     hybrid = testing::solved_by(hybrid_of_degree(degree - 1), system);
      const int m = system.contact.components;
      const auto sum = [m](const Solution& s) {
        return Eigen::VectorXd(s.F_C.reshaped(m, s.F_C.size() / m).rowwise().sum());
      };
      EXPECT_LT((sum(own) - sum(hybrid)).norm(), 0.01 * sum(hybrid).norm()) << degree;
      if (friction > 0) continue;
      const double energy = stress_norm_squared(*problem, own.stress) / 2 - energy_Nmm;
      EXPECT_GT(energy, 0) << degree;
      EXPECT_LT(energy, 0.7 * before) << degree;
      before = energy;
    }
}

TEST_P(Displacements, AContactVertexOnThePrescribedBoundaryHasNoLaw) {
  const Mesh mesh =
      testing::with_role(small_tooth(6, 5), BoundaryRole::force, BoundaryRole::displacement);
  Scene scene;
  scene.displacement_mm = {0.005, 0.002};  // less than the gap at the face's ends
  const auto problem = posed(scene, mesh);
  const Solution solution = solve(problem);
  ASSERT_EQ(solution.status, Status::ok) << solution.message;
  EXPECT_EQ(solution.F_C.size(), 2 * (5 * p + 1 - 2));  // five edges, less the face's ends
  const DisplacementField u = with_rigid_motion(*problem, testing::displacement(solution));
  for (const BoundaryEdge& edge : mesh.boundary) {
    if (edge.role != BoundaryRole::displacement) continue;
    for (const int vertex : edge.vertices)
      EXPECT_LT((u.col(vertex) - scene.displacement_mm).norm(), 1e-16);
  }
}

// A block under 25 MPa that a roller on its left moves along a wall or another block, 2 mm wide:
// all of it slips, also where the roller meets the face.
Mesh pushed_block(bool on_block, const std::string& beside_base) {
  Mesh mesh;
  mesh.name = "pushed";
  if (on_block)
    testing::add_block(mesh, "base", {0, -1}, {2, 0}, 4, 2,
                       {"displacement:floor", "force", "contact:base", beside_base});
  testing::add_block(mesh, "block", {0, 0}, {2, 1}, on_block ? 3 : 4, 2,
                     {"contact:block", "force", "force:top", "displacement:side"});
  validate(mesh);
  return mesh;
}

Scene pushing(const Mesh& mesh, double moved_mm) {
  const auto constant = [](const Eigen::Vector2d& u) {
    return LinearValue<Eigen::Vector2d>{{u, u}};
  };
  Scene scene;
  scene.crown_radius_mm.reset();
  scene.friction = 0.2;
  if (mesh.body_names.size() == 2)
    scene.contacts = {
        {.between = {{{"contact:block"}, {"contact:base"}}}, .friction = scene.friction}};
  scene.boundary["force:top"].pressure_MPa = LinearValue<double>{{25, 25}};
  scene.displacement_mm = {0, 0};
  scene.boundary["displacement:side"].displacement_mm = constant({moved_mm, 0});
  for (const std::string& group : mesh.boundary_groups)
    if (group == "side" || group == "rest")
      scene.boundary["displacement:" + group].support = BoundaryValues::Support::normal;
  return scene;
}

double friction_on_block(const ContactSystem& system, const Solution& solution) {
  const ControlPoints control = control_points(*system.problem, system.degree + 1);
  const Mesh& mesh = system.problem->mesh;
  double sum = 0;
  for (int p = 0; p < control.law.count; ++p)
    if (boundary_label(mesh, mesh.boundary[control.law.boundary[p]]) == "contact:block")
      sum += solution.F_C(2 * p + 1);
  return sum;
}

TEST_P(Displacements, KeepFrictionWhereARollerMeetsTheFace) {
  for (const auto& [on_block, beside_base] :
       {std::pair{false, ""}, {true, "force"}, {true, "displacement:rest"}})
    for (const double moved_mm : {0.001, -0.001}) {
      SCOPED_TRACE(::testing::Message() << beside_base << " " << moved_mm);
      const Mesh mesh = pushed_block(on_block, beside_base);
      Scene scene = pushing(mesh, moved_mm);
      LoadStep back;
      back.boundary["displacement:side"].displacement_mm =
          LinearValue<Eigen::Vector2d>{{Eigen::Vector2d(0, 0), Eigen::Vector2d(0, 0)}};
      scene.later_steps = {back};
      const auto problem = posed(scene, mesh);
      std::vector<double> friction_N, dissipated, of_hybrid;
      ContactSystem system = assembled(problem);
      solve_load_steps(GetParam().solve, system, {},
                       [&](int, const ContactSystem& step, const Solution& solution) {
                         ASSERT_EQ(solution.status, Status::ok) << solution.message;
                         friction_N.push_back(friction_on_block(step, solution));
                         dissipated.push_back(dissipation_Nmm(step, solution));
                       });
      ContactSystem in_stresses = assembled(problem);
      solve_load_steps(select_methods(hybrid_of_degree(k)).front().solve, in_stresses, {},
                       [&](int, const ContactSystem& step, const Solution& solution) {
                         of_hybrid.push_back(dissipation_Nmm(step, solution));
                       });
      ASSERT_EQ(friction_N.size(), 2u);
      ASSERT_EQ(of_hybrid.size(), 2u);
      EXPECT_NEAR(friction_N[0], -std::copysign(10, moved_mm), 1e-7);
      EXPECT_NEAR(friction_N[1], std::copysign(10, moved_mm), 1e-7);
      for (std::size_t step = 0; step < 2; ++step)
        EXPECT_NEAR(dissipated[step], of_hybrid[step], 0.04 * of_hybrid[step]);
    }
}

// Its slip is zero up to rounding: no friction comes of that.
TEST_P(Displacements, OfARollerThatRestsAreWithoutFriction) {
  const Mesh mesh = pushed_block(false, "");
  const Scene scene = pushing(mesh, 0);
  const ContactSystem system = assembled(posed(scene, mesh));
  const Solution solution = run(GetParam(), system, {});
  ASSERT_EQ(solution.status, Status::ok) << solution.message;
  const ControlPoints control = control_points(*system.problem, p);
  for (int point = 0; point < control.law.count; ++point)
    if (control.on_roller[point]) {
      EXPECT_EQ(solution.F_C(2 * point + 1), 0);
    }
}

TEST_P(Displacements, OfABodyThatOnlyMovesHaveNoStress) {
  Scene scene;
  scene.clearance_mm = 1;
  const auto problem = posed(scene);
  const Solution solution = solve(problem);
  EXPECT_TRUE(solution.F_C.isZero(0));
  EXPECT_LT(std::sqrt(stress_norm_squared(*problem, solution.stress)), 1e-9);
  testing::ExactField moved;
  moved.displacement = [&](const auto&) { return scene.displacement_mm; };
  EXPECT_LT(displacement_deviation(*problem, testing::displacement(solution), moved), 1e-12);
}

TEST_P(Displacements, OfABodyFarFromTheOriginAreTheSame) {
  testing::expect_the_same_far_from_the_origin([&](const auto& problem) { return solve(problem); });
}

TEST_P(Displacements, WhatGoesWrongBecomesAStatus) {
  EXPECT_EQ(solve(posed({}), testing::out_of_time()).status, Status::timeout);

  const auto problem = posed({});
  const ContactSystem system = assembled(problem);
  const auto spoiled = [&](auto spoil) {
    return run(
        [&](const ContactSystem& s, const RunControl& control) {
          Solution solution = GetParam().solve(s, control);
          spoil(solution);
          return solution;
        },
        system, {});
  };
  EXPECT_EQ(spoiled([](Solution&) {}).status, Status::ok);
  EXPECT_EQ(spoiled([](Solution& s) { s.F_C.conservativeResize(5); }).status, Status::breakdown);
  EXPECT_EQ(spoiled([](Solution& s) {
              s.unknowns = airybench::Displacements{DisplacementField::Zero(2, 3)};
            }).status,
            Status::breakdown);
  EXPECT_EQ(spoiled([](Solution& s) {
              std::get<airybench::Displacements>(s.unknowns).w(1, 4) = std::nan("");
            }).status,
            Status::breakdown);
}

}  // namespace
}  // namespace airybench::displacement_system_test
