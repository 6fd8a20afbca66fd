// Every method with every preconditioner, on a tooth and on a rack. Not built with the sanitizers,
// under which it would take many minutes; methods_test.cpp has one of each kind for them.
#include <gtest/gtest.h>

#include <filesystem>
#include <ostream>

#include "assembly/msh_format.hpp"
#include "assembly/scene.hpp"
#include "solvers/condensation/symmlq_condensation.hpp"
#include "solvers/condensation/three_step.hpp"
#include "solvers/direct/skyline.hpp"
#include "solvers/krylov/conjugate_gradients.hpp"
#include "solvers/methods.hpp"
#include "tests/support/places.hpp"

namespace airybench::product_test {

void PrintTo(const Method& method, std::ostream* out) { *out << method.name; }

namespace {

std::string readable(std::string name) {
  for (char& letter : name)
    if (!std::isalnum(static_cast<unsigned char>(letter))) letter = '_';
  return name;
}

DualSystem system_of(const char* mesh, Blocks blocks = Blocks::airy) {
  return assemble(std::make_shared<const Problem>(pose(Scene{}, testing::catalogue_mesh(mesh))),
                  blocks);
}

const Solution& reference(const char* mesh) {
  static std::map<std::string, Solution> solutions;
  Solution& solution = solutions[mesh];
  if (solution.status != Status::ok)
    solution = run(select_methods("HYBRID").front(), system_of(mesh, Blocks::contact_points), {});
  return solution;
}

void expect_reference(const Method& method, const char* mesh, double tolerance) {
  const DualSystem system = system_of(mesh, method.blocks);
  RunControl control;
  control.tolerance = tolerance;
  const Solution solution = run(method, system, control);
  ASSERT_EQ(solution.status, Status::ok) << solution.message;
  const Solution& other = reference(mesh);
  EXPECT_LE((solution.F_C - other.F_C).norm(), 1e-6 * other.F_C.norm());
  EXPECT_LE(stress_distance(*system.problem, solution.stress, other.stress),
            1e-6 * std::sqrt(stress_norm_squared(*system.problem, other.stress)));
  EXPECT_EQ(solution.linear_iterations.has_value(),
            method.identity().starts_with("SYMMLQ") || method.identity().starts_with("3STEPCG"));
  EXPECT_EQ(solution.uzawa_iterations.has_value(), method.name.starts_with("ALM"));
}

std::vector<Method> all_methods() {
  std::vector<Method> all = select_methods("*");
  std::erase_if(all, [](const Method& method) { return method.in_displacements; });
  for (const std::string& preconditioner : preconditioner_names())
    all.push_back(select_methods("SYMMLQ:" + preconditioner + ",schur=sparse").front());
  return all;
}

class OnATooth : public ::testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Mesh0, OnATooth, ::testing::ValuesIn(all_methods()),
                         [](const auto& test) { return readable(test.param.name); });

TEST_P(OnATooth, HasTheReferencesForcesAndStresses) {
  expect_reference(GetParam(), "Mesh0", 1e-10);
}

class OnARack : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Mesh4, OnARack,
                         ::testing::Values("3STEPCG:DTIC4", "3STEPCG:DTIC5", "3STEPCG:DTIC6",
                                           "3STEPCG:SKY", "SYMMLQ:DTIC4", "SYMMLQ:DTIC5",
                                           "SYMMLQ:DTIC6", "SYMMLQ:SKY", "ALM:r=20,rho=20",
                                           "3STEPD", "3STEPD:FILE", "3STEPD:LEAN", "3STEPD:CHOLMOD",
                                           "BLIND", "BLIND:SCHUR", "BLIND:SKY", "HYBRID"),
                         [](const auto& test) { return readable(test.param); });

TEST_P(OnARack, HasTheReferencesForcesAndStresses) {
  expect_reference(select_methods(GetParam()).front(), "Mesh4", 1e-10);
}

class KernelsOnARack : public ::testing::TestWithParam<std::string> {
 protected:
  static const DualSystem& system() {
    static const DualSystem rack = system_of("Mesh4");
    return rack;
  }
  static const SkylineFactor& factor() {
    static const SkylineFactor exact = factor_ldlt(analyse_skyline(system().S), system().S);
    return exact;
  }
  // How many right-hand sides: one for the preconditioners that need thousands of iterations.
  static int sides() {
    return GetParam().starts_with("SSOR") || GetParam() == "NONE" ? 1 : most_lanes;
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
INSTANTIATE_TEST_SUITE_P(Mesh4, KernelsOnARack, ::testing::ValuesIn(preconditioner_names()),
                         [](const auto& test) { return readable(test.param); });

TEST_P(KernelsOnARack, ConjugateGradientsHaveTheDirectAnswer) {
  const Preconditioner preconditioner = preconditioner_named(GetParam())(system().S, {});
  const Eigen::MatrixXd B = loads();
  Eigen::MatrixXd X = B, exact = B;
  solve_in_place(factor(), exact);
  const KrylovSummary summary =
      solve_by_conjugate_gradients(system().S, preconditioner, columns_of(X), options(1e-10));
  EXPECT_TRUE(summary.converged);
  const auto S = system().S.selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd difference = X - exact;
  for (int l = 0; l < sides(); ++l)  // in the energy norm
    EXPECT_LT(difference.col(l).dot(S * difference.col(l)),
              1e-14 * exact.col(l).dot(S * exact.col(l)))
        << l;
  RecordProperty("iterations", std::to_string(summary.iterations));
}

TEST_P(KernelsOnARack, SymmlqHasTheDirectAnswer) {
  const Preconditioner S_star = preconditioner_named(GetParam())(system().S, {});
  const Preconditioner preconditioner =
      saddle_preconditioner(system(), S_star, SchurBlock::dense, most_lanes, 1);
  const int n = system().n(), n_f = system().n_f(), n_c = system().n_c();
  const CondensedSystem condensed =
      condense_in_three_steps(system(), [&](Eigen::Ref<Eigen::MatrixXd> X) {
        solve_in_place(factor(), X);
      }).condensed;
  Eigen::MatrixXd X = Eigen::MatrixXd::Zero(n + n_f + n_c, sides()), D(n_c, sides());
  for (int l = 0; l < sides(); ++l) {
    X(n + n_f + l * n_c / sides(), l) = 1;
    D.col(l) = condensed.D.col(l * n_c / sides());
  }
  // SSOR and NONE leave an error of about 1e-6 at a relative residual of 1e-10.
  const KrylovSummary summary =
      solve_by_symmlq(saddle_operator(system()), preconditioner, columns_of(X), options(1e-12));
  EXPECT_TRUE(summary.converged);
  EXPECT_LT((X.bottomRows(n_c) + D).norm(), 1e-7 * D.norm());
  RecordProperty("iterations", std::to_string(summary.iterations));
}

}  // namespace
}  // namespace airybench::product_test
