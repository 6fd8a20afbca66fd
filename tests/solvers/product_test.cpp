// Every method with every preconditioner, on a tooth and on a rack. Not built with the sanitizers,
// under which it would take many minutes; methods_test.cpp has one of each kind for them.
#include <gtest/gtest.h>

#include <map>

#include "solvers/condensation/symmlq_condensation.hpp"
#include "solvers/condensation/three_step.hpp"
#include "solvers/direct/skyline.hpp"
#include "solvers/krylov/conjugate_gradients.hpp"
#include "tests/support/condensed_problem.hpp"
#include "tests/support/method_names.hpp"
#include "tests/support/places.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/solved.hpp"

namespace airybench::product_test {

namespace {

Mesh mesh_named(const std::string& name) {
  if (name == "SmallTooth") return testing::small_tooth(8, 6);
  if (name == "SmallRack") return testing::small_rack(4, 8, 6);
  return testing::catalogue_mesh(name);
}

// Assembled once.
const AirySystem& system_of(const std::string& mesh) {
  static std::map<std::string, AirySystem> systems;
  if (!systems.contains(mesh))
    systems.emplace(mesh, airy_system(testing::posed({}, mesh_named(mesh))));
  return systems.at(mesh);
}

const Solution& reference(const std::string& mesh) {
  static std::map<std::string, Solution> solutions;
  Solution& solution = solutions[mesh];
  if (solution.status != Status::ok) solution = testing::solved_by("HYBRID", system_of(mesh));
  return solution;
}

using MethodOnMesh = std::tuple<std::string, Method>;

class Answer : public ::testing::TestWithParam<MethodOnMesh> {
 public:
  static std::string name_of(const ::testing::TestParamInfo<MethodOnMesh>& test) {
    return testing::readable_name(std::get<Method>(test.param).name);
  }
};

TEST_P(Answer, HasTheReferencesForcesAndStresses) {
  const auto& [mesh, method] = GetParam();
  const AirySystem& system = system_of(mesh);
  const Solution solution = run(method, system, testing::with_tolerance(1e-10));
  ASSERT_EQ(solution.status, Status::ok) << solution.message;
  const Solution& other = reference(mesh);
  EXPECT_LE(testing::force_error(solution, other), 1e-6);
  EXPECT_LE(testing::stress_error(*system.problem, solution, other), 1e-6);
  EXPECT_EQ(solution.linear_iterations.has_value(),
            method.identity().starts_with("SYMMLQ") || method.identity().starts_with("3STEPCG") ||
                method.name == "HYBRID:PDAS" || method.name == "HYBRID:CG");
  EXPECT_EQ(solution.uzawa_iterations.has_value(), method.name.starts_with("ALM"));
}

// Hundreds of iterations for every right-hand side: of each kind one is on Mesh0, the others are on
// the small tooth.
bool is_for_the_small_tooth(const Method& method) {
  const auto has = [&](const char* part) { return method.name.find(part) != std::string::npos; };
  if (method.name == "SYMMLQ:SSOR1.0" || method.name == "3STEPCG:NONE") return false;
  return has("SSOR") || has("NONE");
}

std::vector<Method> tooth_methods(bool small) {
  std::vector<Method> all = select_methods("*");
  std::erase_if(all, [&](const Method& method) {
    return method.in_displacements() || is_for_the_small_tooth(method) != small;
  });
  return all;
}

// Also on Mesh4, which is five times as large as the small rack and graded.
const std::string rack_methods =
    "3STEPD,3STEPD:FILE,3STEPD:LEAN,3STEPD:CHOLMOD,BLIND,BLIND:SCHUR,BLIND:SKY,HYBRID,"
    "HYBRID:CHOLMOD,HYBRID:MUMPS,HYBRID:PDAS,"
    "3STEPCG:SKY,SYMMLQ:DTIC6,SYMMLQ:SKY,ALM:r=20,rho=20";
const std::string small_rack_methods =
    rack_methods + ",3STEPCG:DTIC4,3STEPCG:DTIC5,3STEPCG:DTIC6,SYMMLQ:DTIC4,SYMMLQ:DTIC5";

using ::testing::Combine, ::testing::Values, ::testing::ValuesIn;
INSTANTIATE_TEST_SUITE_P(Mesh0, Answer, Combine(Values("Mesh0"), ValuesIn(tooth_methods(false))),
                         Answer::name_of);
INSTANTIATE_TEST_SUITE_P(SmallTooth, Answer,
                         Combine(Values("SmallTooth"), ValuesIn(tooth_methods(true))),
                         Answer::name_of);
INSTANTIATE_TEST_SUITE_P(Mesh4, Answer,
                         Combine(Values("Mesh4"), ValuesIn(select_methods(rack_methods))),
                         Answer::name_of);
INSTANTIATE_TEST_SUITE_P(SmallRack, Answer,
                         Combine(Values("SmallRack"), ValuesIn(select_methods(small_rack_methods))),
                         Answer::name_of);

using PreconditionerOnMesh = std::tuple<std::string, std::string>;

class KernelsOnARack : public ::testing::TestWithParam<PreconditionerOnMesh> {
 public:
  static std::string name_of(const ::testing::TestParamInfo<PreconditionerOnMesh>& test) {
    return testing::readable_name(std::get<1>(test.param));
  }

 protected:
  static const AirySystem& system() { return system_of(std::get<0>(GetParam())); }
  static const std::string& preconditioner() { return std::get<1>(GetParam()); }
  // By a factor of the hybridized system, computed once.
  static const Eigen::MatrixXd& exact_D() {
    static std::map<std::string, Eigen::MatrixXd> all;
    Eigen::MatrixXd& D = all[std::get<0>(GetParam())];
    if (D.size() == 0) D = testing::condensed(*system().problem, system().contact).D;
    return D;
  }
  // How many right-hand sides: one for the preconditioners that need thousands of iterations.
  static int sides() {
    return preconditioner().starts_with("SSOR") || preconditioner() == "NONE" ? 1 : max_lanes;
  }
  // Rows of [C_F; C_C] as right-hand sides, evenly chosen.
  static Eigen::MatrixXd loads() {
    const int rows = system().n_f() + system().n_c();
    Eigen::MatrixXd B = Eigen::MatrixXd::Zero(system().n(), sides());
    for (int l = 0; l < sides(); ++l)
      for (auto entry = constraint_row(system(), l * rows / sides()); entry; ++entry)
        B(entry.col(), l) = entry.value();
    return B;
  }
  static KrylovOptions options(double tolerance) {
    KrylovOptions with;
    with.tolerance = tolerance;
    with.lanes = sides();
    return with;
  }
};
INSTANTIATE_TEST_SUITE_P(Mesh4, KernelsOnARack,
                         Combine(Values("Mesh4"), Values("DTIC4", "FLIC3", "SKY")),
                         KernelsOnARack::name_of);
INSTANTIATE_TEST_SUITE_P(SmallRack, KernelsOnARack,
                         Combine(Values("SmallRack"), ValuesIn(preconditioner_names())),
                         KernelsOnARack::name_of);

TEST_P(KernelsOnARack, ConjugateGradientsHaveTheDirectAnswer) {
  const Preconditioner S_star = preconditioner_named(preconditioner())(system().S, {});
  const Eigen::MatrixXd B = loads();
  Eigen::MatrixXd X = B, Y = B;
  solve_in_place(factor_ldlt(analyse_skyline(system().S), system().S), Y);
  const KrylovSummary summary =
      solve_by_conjugate_gradients(system().S, S_star, columns_of(X), options(1e-10));
  EXPECT_TRUE(summary.converged);
  const auto S = system().S.selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd difference = X - Y;
  for (int l = 0; l < sides(); ++l)  // in the energy norm
    EXPECT_LT(difference.col(l).dot(S * difference.col(l)), 1e-14 * Y.col(l).dot(S * Y.col(l)))
        << l;
  RecordProperty("iterations", std::to_string(summary.iterations));
}

TEST_P(KernelsOnARack, SymmlqHasTheDirectAnswer) {
  const Preconditioner S_star = preconditioner_named(preconditioner())(system().S, {});
  const Preconditioner M = saddle_preconditioner(system(), S_star, 1);
  const int n = system().n(), n_f = system().n_f(), n_c = system().n_c();
  Eigen::MatrixXd X = Eigen::MatrixXd::Zero(n + n_f + n_c, sides()), D(n_c, sides());
  for (int l = 0; l < sides(); ++l) {
    X(n + n_f + l * n_c / sides(), l) = 1;
    D.col(l) = exact_D().col(l * n_c / sides());
  }
  // SSOR and NONE leave an error of about 1e-6 at a relative residual of 1e-10.
  const KrylovSummary summary =
      solve_by_symmlq(saddle_operator(system()), M, columns_of(X), options(1e-12));
  EXPECT_TRUE(summary.converged);
  EXPECT_LT((X.bottomRows(n_c) + D).norm(), 1e-7 * D.norm());
  RecordProperty("iterations", std::to_string(summary.iterations));
}

}  // namespace
}  // namespace airybench::product_test
