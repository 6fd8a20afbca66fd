// Contact problems of other programs (tests/data/fclib), through bench: read, solved by every
// contact solver that says so, and judged. The law is checked here once more, point by point.
#include <gtest/gtest.h>

#include <algorithm>

#include "bench/problems/problem_files.hpp"
#include "solvers/contact/compliance.hpp"
#include "solvers/methods.hpp"
#include "tests/support/bench_command.hpp"

namespace airybench::foreign_problems_test {
namespace {

std::filesystem::path file_of(const std::string& name) {
  return testing::test_data("fclib") / ("siconos_" + name + ".hdf5");
}

// The largest violation of the law by r = −F and u = W r + q, relative to the largest force.
double violation(const contact::Problem& problem, const Eigen::VectorXd& F) {
  const Eigen::VectorXd r = -F, u = D_times(problem, r) + problem.G;
  const double force = r.cwiseAbs().maxCoeff(), velocity = force * D_diagonal(problem).maxCoeff();
  double worst = 0;
  const auto at_least_zero = [&](double value, double scale) {
    worst = std::max(worst, -value / scale);
  };
  for (int p = 0; p < problem.points.count; ++p) {
    const int n = 2 * p, t = n + 1;
    const double room = problem.points.friction_at(p) * r(n) - std::abs(r(t));
    at_least_zero(r(n), force);
    at_least_zero(u(n), velocity);
    at_least_zero(room, force);
    at_least_zero(-std::min(r(n) / force, u(n) / velocity), 1);            // open or closed
    at_least_zero(-std::min(room / force, std::abs(u(t)) / velocity), 1);  // stick or slip
    at_least_zero(-r(t) * u(t), force * velocity);                         // against the motion
  }
  return worst;
}

class ForeignProblems : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::ranges::count(problem_formats(), "fclib") == 0)
      GTEST_SKIP() << "this build is without HDF5";
  }
};

TEST_F(ForeignProblems, NewtonSolvesThem) {
  const std::map<std::string, int> contacts = {
      {"slider_crank", 2}, {"00071", 89}, {"granular_flow_00667", 667}};
  for (const auto& [name, count] : contacts) {
    SCOPED_TRACE(name);
    const contact::Problem problem = read_contact_problem(file_of(name));
    ASSERT_EQ(problem.points.count, count);
    const Solution solution = run(condensed_contact().solve_contact, problem, {});
    EXPECT_EQ(solution.status, Status::ok) << solution.message;
    EXPECT_LT(violation(problem, solution.F_C), 1e-10);
    EXPECT_GT(violation(problem, 1.001 * solution.F_C), 1e-5);
  }
}

TEST_F(ForeignProblems, EveryContactSolverIsRunAndJudged) {
  const testing::BenchCommand bench;
  const auto result =
      bench.run("--problem=" + file_of("00071").string() + " --repetitions=1 --out=o");
  EXPECT_EQ(result.code, 0) << result.err;
  const std::vector<Json> records = bench.records();
  ASSERT_EQ(records.size(), all_contact_solvers.size());
  for (const Json& record : records) {
    SCOPED_TRACE(record["contact_solver"]);
    EXPECT_EQ(record["status"], "ok");
    EXPECT_LT(record["natural_map_residual"].get<double>(), 1e-11);
    EXPECT_LT(record["siconos_error"].get<double>(), 1e-11);
    EXPECT_EQ(
        record["n_open"].get<int>() + record["n_stick"].get<int>() + record["n_slip"].get<int>(),
        89);
    for (const char* of_bodies : {"equilibrium_residual", "n_phi", "error_stress"})
      EXPECT_TRUE(record.value(of_bodies, Json()).is_null()) << of_bodies;
  }
}

}  // namespace
}  // namespace airybench::foreign_problems_test
