// Methods on small systems: exact fields, scenes, and injected failures. Each kind of method is
// there once, the preconditioned ones with one preconditioner of every kind; all of them are in
// product_test.cpp.
#include "solvers/methods.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <limits>
#include <ostream>
#include <set>

#include "assembly/edge_forces.hpp"
#include "assembly/scene.hpp"
#include "solvers/condensation/blind.hpp"
#include "solvers/condensation/hybridized.hpp"
#include "solvers/condensation/three_step.hpp"
#include "solvers/direct/mumps.hpp"
#include "solvers/direct/skyline.hpp"
#include "solvers/preconditioners/preconditioner.hpp"
#include "tests/support/exact_fields.hpp"
#include "tests/support/method_names.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::methods_test {

void PrintTo(const Method& method, std::ostream* out) { *out << method.name; }

namespace {

using testing::small_tooth;

std::shared_ptr<const Problem> posed(const Scene& scene, Mesh mesh = small_tooth(6, 5)) {
  return std::make_shared<const Problem>(pose(scene, std::move(mesh)));
}

std::vector<Method> kinds_of_methods() {
  std::vector<Method> kinds;
  for (const Method& method : methods())  // displacements: quadratic_displacements_test.cpp
    if (!method.is_iterative() && !method.in_displacements) kinds.push_back(method);
  for (const char* name : {"HYBRID:CG", "ALM:r=20,rho=20", "ALM:AUTO", "SYMMLQ:DTIC4,lanes=1",
                           "3STEPCG:DTIC4,lanes=1", "SYMMLQ:DTIC3", "SYMMLQ:FLIC2", "SYMMLQ:SKY",
                           "3STEPCG:DTIC3", "3STEPCG:FLIC2", "3STEPCG:SKY"})
    kinds.push_back(select_methods(name).front());
#ifndef AIRYBENCH_SANITIZED  // thousands of iterations; preconditioners_test has these, too
  for (const char* name : {"SYMMLQ:SKY,schur=sparse", "SYMMLQ:SSOR1.0", "SYMMLQ:NONE",
                           "3STEPCG:SSOR1.0", "3STEPCG:NONE"})
    kinds.push_back(select_methods(name).front());
#endif
  return kinds;
}

class EveryKindOfMethod : public ::testing::TestWithParam<Method> {
 protected:
  // Iterative methods as far as rounding lets them go.
  static RunControl tight() {
    RunControl control;
    control.tolerance = 1e-13;
    return control;
  }
  Solution solve(std::shared_ptr<const Problem> problem, const RunControl& control = tight()) {
    system_ = assemble(std::move(problem), GetParam().blocks);
    return run(GetParam(), system_, control);
  }
  // The largest deviation from an exact stress, relative to its largest value.
  static double deviation(const Problem& problem, const StressField& field,
                          const std::function<Eigen::Vector3d(const Eigen::Vector2d&)>& exact) {
    double worst = 0, size = 0;
    for (int t = 0; t < static_cast<int>(field.size()); ++t) {
      const TriangleVertices v = problem.vertices_of(t);
      for (int c = 0; c < 9; ++c) {
        const Eigen::Vector2d x = c % 3 == 2 ? Eigen::Vector2d(v.rowwise().mean())
                                             : Eigen::Vector2d(v.col((c / 3 + c % 3) % 3));
        worst = std::max(worst, (field[t].col(c) - exact(x)).cwiseAbs().maxCoeff());
        size = std::max(size, exact(x).cwiseAbs().maxCoeff());
      }
    }
    return worst / size;
  }
  // The answer of a method of another kind.
  static Solution other_answer(const std::shared_ptr<const Problem>& problem) {
    const Method other = select_methods(GetParam().name == "HYBRID" ? "3STEPD" : "HYBRID").front();
    return run(other, assemble(problem, other.blocks), {});
  }
  DualSystem system_;
};
INSTANTIATE_TEST_SUITE_P(Table, EveryKindOfMethod, ::testing::ValuesIn(kinds_of_methods()),
                         testing::readable);

TEST_P(EveryKindOfMethod, ReproducesLinearStressesExactlyWithoutContact) {
  Mesh mesh = small_tooth(5, 4);
  for (BoundaryEdge& edge : mesh.boundary)
    if (edge.role == BoundaryRole::contact) edge.role = BoundaryRole::force;
  constexpr double young = 2000, poisson = 0.3;
  for (const testing::ExactField& exact : testing::exact_fields(young, poisson)) {
    const auto problem = std::make_shared<const Problem>(make_problem(
        mesh, {compliance({young, poisson}, Plane::stress)}, testing::loads_of(exact), 0.2));
    const Solution solution = solve(problem);
    ASSERT_EQ(solution.status, Status::ok) << solution.message;
    EXPECT_LT(deviation(*problem, solution.stress, exact.stress), 1e-10) << exact.name;
    EXPECT_FALSE(solution.contact_iterations) << exact.name;
    EXPECT_FALSE(solution.times[Stage::contact]) << exact.name;
  }
}

TEST_P(EveryKindOfMethod, ReproducesLinearStressesExactlyWithNoConstraintAtAll) {
  Mesh mesh = small_tooth(5, 4);
  for (BoundaryEdge& edge : mesh.boundary) edge.role = BoundaryRole::displacement;
  constexpr double young = 2000, poisson = 0.3;
  for (const testing::ExactField& exact : testing::exact_fields(young, poisson)) {
    const auto problem = std::make_shared<const Problem>(make_problem(
        mesh, {compliance({young, poisson}, Plane::stress)}, testing::loads_of(exact), 0.2));
    const Solution solution = solve(problem);
    ASSERT_EQ(solution.status, Status::ok) << exact.name << ": " << solution.message;
    EXPECT_EQ(system_.n_f() + system_.n_c(), 0);
    EXPECT_LT(deviation(*problem, solution.stress, exact.stress), 1e-10) << exact.name;
  }
}

TEST_P(EveryKindOfMethod, ReproducesAConstantStressThatSticksOrSlipsOnTheWall) {
  // A flat wall at x = 10: u_n = 0 there. σ = (−100, σyy, τ) with εyy = 0 sticks for |τ| < 100 μ;
  // for τ = 100 μ it slips by any amount against the friction.
  constexpr double young = 2000, poisson = 0.3, mu = 0.25;
  const Eigen::Matrix3d c = compliance({young, poisson}, Plane::stress);
  for (const auto& [tau, slip] : {std::pair{10.0, 0.0}, {-20.0, 0.0}, {25.0, -0.5}, {-25.0, 0.3}}) {
    const Eigen::Vector3d stress(-100, -100 * poisson, tau);
    const Eigen::Vector3d strain = c * stress;
    testing::ExactField exact;
    exact.body_force.setZero();
    exact.stress = [=](const Eigen::Vector2d&) { return stress; };
    exact.displacement = [=, slip = slip](const Eigen::Vector2d& x) {
      return Eigen::Vector2d(strain(0) * (x.x() - 10), strain(2) * (x.x() - 10) + slip);
    };
    const auto problem = std::make_shared<const Problem>(
        make_problem(small_tooth(5, 4), {c}, testing::loads_of(exact), mu));
    const Solution solution = solve(problem);
    ASSERT_EQ(solution.status, Status::ok) << solution.message;
    EXPECT_LT(deviation(*problem, solution.stress, exact.stress), 1e-9) << tau;
    for (int p = 0; p < system_.contact.count; ++p) {  // four edges of 1.5 mm
      EXPECT_NEAR(solution.F_C(2 * p), -75, 1e-7);
      EXPECT_NEAR(solution.F_C(2 * p + 1), 0.75 * tau, 1e-7);
    }
  }
}

struct NamedScene {
  std::string name;
  Scene scene;
};

std::vector<NamedScene> scene_variants() {
  const auto with = [](const char* name, auto change) {
    Scene scene;
    change(scene);
    return NamedScene{name, scene};
  };
  return {
      with("default", [](Scene&) {}),
      with("frictionless", [](Scene& s) { s.friction = 0; }),
      with("plane stress", [](Scene& s) { s.plane = Plane::stress; }),
      with("body force",
           [](Scene& s) {
             s.body_force_N_per_mm3 = {3, -1};
           }),
      with("frictionless, body force",
           [](Scene& s) {
             s.friction = 0;
             s.body_force_N_per_mm3 = {3, -1};
           }),
      with("flat face", [](Scene& s) { s.crown_radius_mm.reset(); }),
      with("clearance", [](Scene& s) { s.clearance_mm = 0.005; }),
      with("high friction", [](Scene& s) { s.friction = 5; }),
      with("no load", [](Scene& s) { s.displacement_mm.setZero(); }),
      with("nothing touches", [](Scene& s) { s.clearance_mm = 1; }),
      with("pulled away", [](Scene& s) { s.displacement_mm.x() = -0.02; }),
  };
}

TEST_P(EveryKindOfMethod, AgreesWithAnotherKindOfMethodOnEveryScene) {
  for (const auto& [name, scene] : scene_variants()) {
    const auto problem = posed(scene);
    const Solution solution = solve(problem);
    ASSERT_EQ(solution.status, Status::ok) << name << ": " << solution.message;
    const Solution other = other_answer(problem);
    EXPECT_LE((solution.F_C - other.F_C).norm(), 1e-9 * other.F_C.norm()) << name;
    // The norm is about 7 where the body is stressed, and 0 where it is only moved.
    EXPECT_LE(stress_distance(*problem, solution.stress, other.stress), 1e-9) << name;
  }
}

TEST_P(EveryKindOfMethod, ScenesWithNoForceHaveNoStress) {
  for (const char* name : {"no load", "nothing touches", "pulled away"}) {
    const std::vector<NamedScene> variants = scene_variants();
    const auto variant = std::find_if(variants.begin(), variants.end(),
                                      [&](const NamedScene& v) { return v.name == name; });
    const auto problem = posed(variant->scene);
    const Solution solution = solve(problem);
    EXPECT_TRUE(solution.F_C.isZero(0)) << name;
    EXPECT_LT(std::sqrt(stress_norm_squared(*problem, solution.stress)), 1e-9) << name;
  }
}

TEST_P(EveryKindOfMethod, StressIsStrictlyAdmissibleOnWholeContactEdges) {
  const auto problem = posed({});
  const Solution solution = solve(problem);
  const double largest = solution.F_C.cwiseAbs().maxCoeff();
  for (std::size_t row = 0; row < problem->mesh.boundary.size(); ++row) {
    if (problem->mesh.boundary[row].role != BoundaryRole::contact) continue;
    const int edge = problem->edges.of_boundary[row];
    const double mu = problem->friction_at(static_cast<int>(row));
    for (int t = 0; t < static_cast<int>(problem->mesh.triangles.size()); ++t) {
      for (int k = 0; k < 3; ++k) {
        if (problem->edges.of_triangle[t][k] != edge) continue;
        const TriangleVertices v = problem->vertices_of(t);
        const EdgeFrame frame = edge_frame(v.col(k), v.col((k + 1) % 3));
        for (int i = 0; i <= 10; ++i) {  // the stress is linear along the edge
          const Eigen::Vector3d stress = (1 - i / 10.) * solution.stress[t].col(3 * k) +
                                         i / 10. * solution.stress[t].col(3 * k + 1);
          const Eigen::Vector2d force = frame.length_mm / 2 * traction(stress, frame.normal);
          const double normal = force.dot(frame.normal), tangential = force.dot(frame.tangent);
          EXPECT_LE(normal, 1e-9 * largest);
          EXPECT_LE(std::abs(tangential), -mu * normal + 1e-9 * largest);
        }
      }
    }
  }
}

TEST_P(EveryKindOfMethod, TwoMaterialsAndStiffContrastAgreeWithAnotherKindOfMethod) {
  Mesh mesh = small_tooth(6, 5);
  mesh.body_names = {"root", "tip"};
  for (std::size_t t = mesh.triangles.size() / 2; t < mesh.triangles.size(); ++t)
    mesh.triangle_body[t] = 1;
  Scene scene;
  scene.materials["tip"] = {2100, 0.45};
  const auto problem = posed(scene, mesh);
  const Solution solution = solve(problem);
  ASSERT_EQ(solution.status, Status::ok) << solution.message;
  const Solution other = other_answer(problem);
  EXPECT_LE((solution.F_C - other.F_C).norm(), 1e-8 * other.F_C.norm());
}

TEST_P(EveryKindOfMethod, ReactionsAndContactForcesBalanceTheBodyForce) {
  for (const double mu : {0.2, 0.0}) {
    Scene scene;
    scene.friction = mu;
    scene.body_force_N_per_mm3 = {3, -1};
    const auto problem = posed(scene);
    const Solution solution = solve(problem);
    ASSERT_EQ(solution.status, Status::ok) << solution.message;
    Eigen::Vector2d reactions = Eigen::Vector2d::Zero(), contact = Eigen::Vector2d::Zero();
    for (int t = 0; t < static_cast<int>(problem->mesh.triangles.size()); ++t)
      for (int k = 0; k < 3; ++k)
        for (std::size_t row = 0; row < problem->mesh.boundary.size(); ++row)
          if (problem->edges.of_boundary[row] == problem->edges.of_triangle[t][k] &&
              problem->mesh.boundary[row].role == BoundaryRole::displacement)
            reactions +=
                element_edge_forces(problem->vertices_of(t), solution.stress[t], k).rowwise().sum();
    for (int p = 0; p < system_.contact.count; ++p)  // n = x, s = y on the tip
      for (int k = 0; k < system_.contact.components; ++k)
        contact(k) += solution.F_C(system_.contact.components * p + k);
    const Eigen::Vector2d weight = 80 * scene.body_force_N_per_mm3;  // 80 mm² of body
    EXPECT_LT((reactions + contact + weight).norm(), 1e-9 * reactions.norm()) << mu;
  }
}

TEST_P(EveryKindOfMethod, ABodyFarFromTheOriginHasTheSameAnswer) {
  Mesh moved = small_tooth(6, 5);
  for (Eigen::Vector2d& x : moved.vertices) x += Eigen::Vector2d(1e5, -2e5);
  Scene scene;
  scene.crown_radius_mm.reset();
  const Solution here = solve(posed(scene)), there = solve(posed(scene, moved));
  ASSERT_EQ(there.status, Status::ok) << there.message;
  // The moved coordinates themselves are rounded to 3e-11 mm.
  EXPECT_LT((here.F_C - there.F_C).norm(), 1e-8 * here.F_C.norm());
}

TEST_P(EveryKindOfMethod, OutOfTimeIsATimeout) {
  RunControl control;
  control.deadline = Deadline::after(-1);
  const Solution solution = solve(posed({}), control);
  EXPECT_EQ(solution.status, Status::timeout);
  EXPECT_NE(solution.message.find("time limit reached during"), std::string::npos);
}

TEST_P(EveryKindOfMethod, TooFewSweepsIsNotConverged) {
  if (GetParam().name.starts_with("ALM") || GetParam().name == "HYBRID:CG")
    GTEST_SKIP() << "it makes no sweeps";
  RunControl control;
  control.contact_sweeps = 1;
  control.contact = ContactSolver::gauss_seidel;
  const Solution solution = solve(posed({}), control);
  EXPECT_EQ(solution.status, Status::not_converged);
  EXPECT_NE(solution.message.find("natural map residual"), std::string::npos);
  control.contact = ContactSolver::newton;  // it needs no more sweeps
  EXPECT_EQ(solve(posed({}), control).status, Status::ok);
}

TEST_P(EveryKindOfMethod, CountsItsStorage) { EXPECT_GT(matrix_bytes(solve(posed({}))), 0u); }

// Entries and flops of the factor or preconditioner; none where there is none.
TEST(WorkCounts, AreThoseOfTheFactor) {
  const DualSystem system = assemble(posed({}));
  const auto counted = [&](const char* name) {
    return run(select_methods(name).front(), system, {});
  };
  const SkylineProfile profile = analyse_skyline(system.S);
  for (const char* name : {"3STEPD", "3STEPCG:SKY"}) {
    EXPECT_EQ(counted(name).factor_entries, profile.profile) << name;
    EXPECT_EQ(counted(name).factor_flops, profile.factor_flops) << name;
  }
  EXPECT_EQ(counted("3STEPCG:DTIC3").factor_flops, profile.factor_flops);  // then dropped
  EXPECT_LT(counted("3STEPCG:DTIC3").factor_entries, profile.profile);
  EXPECT_LT(counted("3STEPCG:FLIC1").factor_flops, counted("3STEPCG:FLIC3").factor_flops);
  for (const char* name : {"3STEPD:CHOLMOD", "HYBRID", "P2", "BLIND"}) {
    const Solution solution = counted(name);
    EXPECT_GT(solution.factor_flops.value(), static_cast<double>(*solution.factor_entries)) << name;
  }
  EXPECT_TRUE(counted("BLIND").library_bytes);  // MUMPS's: in units of 10⁶, here 0
  const Solution by_cholmod = counted("3STEPD:CHOLMOD");
  EXPECT_GT(by_cholmod.library_bytes, 8 * *by_cholmod.factor_entries);
  EXPECT_FALSE(counted("HYBRID").library_bytes);
  EXPECT_FALSE(counted("3STEPCG:NONE").factor_entries);
  EXPECT_FALSE(counted("3STEPCG:SSOR1.0").factor_flops);
  EXPECT_FALSE(counted("3STEPD").library_bytes);
}

TEST(StageObservers, OfAllScopesAreToldInsideOut) {
  struct Noting : StageObserver {
    Noting(std::string name, std::string& seen) : name_(std::move(name)), seen_(seen) {}
    void begins(Stage) override { seen_ += name_ + "("; }
    void ends(Stage) override { seen_ += name_ + ")"; }
    std::string name_;
    std::string& seen_;
  };
  std::string seen;
  Noting outer("o", seen), inner("i", seen);
  StageTimes times;
  const ObservedStages observed(&outer);
  {
    const ObservedStages too(&inner);
    const StageTimer timer(times, Stage::factor);
  }
  const StageTimer timer(times, Stage::check);
  EXPECT_EQ(seen, "i(o(i)o)o(");
}

TEST(Methods, SelectionByNamesAndGlobs) {
  EXPECT_EQ(select_methods("3STEPD").size(), 1u);
  std::set<std::string> identities;
  for (const Method& method : methods()) identities.insert(method.identity());
  EXPECT_EQ(select_methods("*").size(), identities.size());
  EXPECT_EQ(select_methods("HYBRID,3STEPD").front().name, "3STEPD");  // in the table's order
  EXPECT_EQ(select_methods("3STEPD,3STEP*,3STEPD").size(), select_methods("3STEP*").size());
  try {
    select_methods("3STEPD,4STEP");
    FAIL() << "an unknown method was accepted";
  } catch (const std::invalid_argument& error) {
    std::string valid;
    for (const Method& method : methods())
      if (!is_general_name(method.name)) valid += (valid.empty() ? "" : ", ") + method.name;
    EXPECT_EQ(error.what(), "no method matches '4STEP' (valid: " + valid +
                                ", 3STEPCG:<preconditioner>, SYMMLQ:<preconditioner>, "
                                "ALM:r=<r>,rho=<rho>; globs like '3STEP*')");
  }
  EXPECT_THROW(select_methods(""), std::invalid_argument);
}

// What records and figures group methods by.
TEST(Methods, EachSaysItsFamilyAndItsPreconditioner) {
  const std::set<std::string> iterative = {"3STEPCG", "ALM", "HYBRID:CG", "SYMMLQ"},
                              direct = {"3STEPD", "BLIND", "HYBRID", "P2"};
  const std::vector<std::string>& known = preconditioner_names();
  std::set<std::string> families;
  for (const Method& method : methods()) {
    families.insert(method.family);
    EXPECT_EQ(method.is_iterative(), iterative.contains(method.family)) << method.name;
    EXPECT_TRUE(method.identity().starts_with(method.family)) << method.name;
    const bool has_one = method.family == "3STEPCG" || method.family == "SYMMLQ";
    EXPECT_EQ(std::count(known.begin(), known.end(), method.preconditioner), has_one)
        << method.name << ": " << method.preconditioner;
    if (has_one) {
      EXPECT_EQ(method.identity(), method.family + ":" + method.preconditioner);
    }
    EXPECT_EQ(std::count(method.stages.begin(), method.stages.end(), Stage::precondition),
              has_one || method.family == "HYBRID:CG")
        << method.name;
  }
  std::set<std::string> all = iterative;
  all.insert(direct.begin(), direct.end());
  EXPECT_EQ(families, all);
}

TEST(Methods, APreconditionerHasOneSpelling) {
  for (const auto& [name, spelling] : {std::pair{"SYMMLQ:SSOR1", "SSOR1.0"},
                                       {"SYMMLQ:SSOR1.00,schur=sparse", "SSOR1.0"},
                                       {"3STEPCG:SSOR.7,lanes=1", "SSOR0.7"},
                                       {"3STEPCG:DTIC3.0", "DTIC3"},
                                       {"SSKY", "SKY"}})
    EXPECT_EQ(select_methods(name).front().preconditioner, spelling) << name;
}

Method made_up(std::function<Solution(const DualSystem&, const RunControl&)> solve) {
  Method method;
  method.name = "MADE_UP";
  method.blocks = Blocks::contact_points;
  method.solve = std::move(solve);
  return method;
}

TEST(Methods, WhateverAMethodDoesBecomesAStatus) {
  const DualSystem system = assemble(posed({}), Blocks::contact_points);
  const auto status = [&](auto solve) { return run(made_up(solve), system, {}).status; };
  EXPECT_EQ(status([](auto&, auto&) -> Solution { throw std::bad_alloc(); }),
            Status::out_of_memory);
  EXPECT_EQ(status([](auto&, auto&) -> Solution { throw Breakdown("x"); }), Status::breakdown);
  EXPECT_EQ(status([](auto&, auto&) -> Solution { throw TimeoutReached("x"); }), Status::timeout);
  EXPECT_EQ(status([](auto&, auto&) -> Solution { throw std::logic_error("x"); }), Status::crashed);
  EXPECT_EQ(status([](auto&, auto&) { return Solution{}; }), Status::crashed);
  const auto claim_success = [](auto change) {
    return [=](const DualSystem& s, const RunControl&) {
      Solution solution;
      solution.status = Status::ok;
      solution.F_C = Eigen::VectorXd::Zero(s.contact.size());
      solution.stress.assign(s.problem->mesh.triangles.size(), ElementStress::Zero());
      change(solution);
      return solution;
    };
  };
  EXPECT_EQ(status(claim_success([](Solution&) {})), Status::ok);
  EXPECT_EQ(status(claim_success([](Solution& s) { s.F_C(1) = std::nan(""); })), Status::breakdown);
  EXPECT_EQ(status(claim_success([](Solution& s) { s.stress[3](1, 2) = INFINITY; })),
            Status::breakdown);
  EXPECT_EQ(status(claim_success([](Solution& s) { s.stress.clear(); })), Status::breakdown);
  EXPECT_EQ(status(claim_success([](Solution& s) { s.F_C.resize(1); })), Status::breakdown);
}

CondensedSystem three_step_condensed(const DualSystem& system) {
  const SkylineFactor factor = factor_ldlt(analyse_skyline(system.S), system.S);
  return condense_in_three_steps(system,
                                 [&](Eigen::Ref<Eigen::MatrixXd> X) { solve_in_place(factor, X); })
      .condensed;
}

TEST(Condensation, ComplianceIsSymmetricPositiveDefinite) {
  const CondensedSystem condensed = three_step_condensed(assemble(posed({})));
  EXPECT_EQ((condensed.D - condensed.D.transpose()).norm(), 0);
  const Eigen::VectorXd eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(condensed.D).eigenvalues();
  EXPECT_GT(eigenvalues(0), 1e-5 * eigenvalues(eigenvalues.size() - 1));
}

TEST(Condensation, HybridizedAndAirySystemsGiveTheSameNumbers) {
  for (const auto& [name, scene] : scene_variants()) {
    const DualSystem system = assemble(posed(scene));
    const CondensedSystem airy = three_step_condensed(system);
    const HybridizedSystem hybrid = assemble_hybridized(*system.problem, system.contact);
    StiffnessFactor factor;
    factor.cholesky.analyse(hybrid.K, hybrid.n_c);
    factor.cholesky.factor(hybrid.K);
    factor.y = factor.cholesky.forward(hybrid.b);
    const CondensedSystem other = condense(factor);
    EXPECT_LT((airy.D - other.D).norm(), 1e-11 * other.D.norm()) << name;
    EXPECT_LE((airy.G - other.G).norm(), 1e-11 * other.G.norm()) << name;
  }
}

TEST(Condensation, BlindAndThreeStepGiveTheSameNumbers) {
  for (const auto& [name, scene] : scene_variants()) {
    const DualSystem system = assemble(posed(scene));
    const CondensedSystem reference = three_step_condensed(system);
    const auto expect_equal = [&, &label = name](const CondensedSystem& other, const char* how) {
      EXPECT_LT((other.D - reference.D).norm(), 1e-10 * reference.D.norm()) << label << how;
      EXPECT_LE((other.G - reference.G).norm(), 1e-10 * reference.G.norm()) << label << how;
    };
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
    expect_equal(
        condense_blindly(partial.schur(), partial.reduce(blind_right_hand_side(system, last, {}))),
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
  DualSystem system = assemble(posed({}));
  SparseRows doubled = system.C_F;
  doubled.row(1) = doubled.row(0);
  system.C_F = doubled;
  const Solution solution = run(select_methods("3STEPD").front(), system, {});
  EXPECT_EQ(solution.status, Status::breakdown);
  EXPECT_EQ(solution.message, "three-step condensation: K_FF is not positive definite to rounding");
}

TEST(Condensation, NotFiniteInputIsABreakdown) {
  for (const double poison : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    for (const char* method : {"3STEPD", "3STEPD:CHOLMOD"}) {
      DualSystem system = assemble(posed({}));
      system.S.valuePtr()[5] = poison;
      const Solution solution = run(select_methods(method).front(), system, {});
      EXPECT_TRUE(solution.status == Status::breakdown || solution.status == Status::not_converged)
          << method << ": " << name_of(solution.status);
    }
  }
}

}  // namespace
}  // namespace airybench::methods_test
