// `--fields=mean`: what is written has the error that is printed.
#include <gtest/gtest.h>

#include <array>
#include <sstream>

#include "mesh/refinement.hpp"
#include "tests/bench/verify/distance_to_finer.hpp"
#include "tests/support/bench_command.hpp"

namespace airybench::mean_field_test {
namespace {

// The last three columns: a row per triangle, third and corner.
StressField read_stress(const std::string& csv) {
  std::vector<Eigen::Vector3d> rows;
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::array<double, 8> cells{};
    std::istringstream text(line);
    std::string cell;
    for (double& value : cells) {
      std::getline(text, cell, ',');
      value = std::stod(cell);
    }
    rows.emplace_back(cells[5], cells[6], cells[7]);
  }
  StressField field(rows.size() / 9, 1);
  for (std::size_t row = 0; row < rows.size(); ++row)
    field[static_cast<int>(row / 9)].col(static_cast<Eigen::Index>(row % 9)) = rows[row];
  return field;
}

class MeanField : public ::testing::Test {
 protected:
  MeanField() {
    testing::write_text(bench_.path("smooth.json"), R"({"friction": 0})");
    const testing::CommandResult run = bench_.run(
        "--mesh=Mesh0 --scene=smooth.json --method=HYBRID,P2,HYBRID:k=2,P3,HYBRID:k=3,P4 "
        "--repetitions=1 --fields=mean --out=o");
    EXPECT_EQ(run.code, 0) << run.err;
  }
  StressField field(const std::string& method, const std::string& kind) const {
    return read_stress(bench_.content("o/fields/Mesh0--smooth--" + method + "." + kind + ".csv"));
  }
  double error_mean(const std::string& method) const {
    for (const Json& record : bench_.records())
      if (record["method"] == method) return record["error_mean"].get<double>();
    return 0;
  }
  testing::BenchCommand bench_;
};

TEST_F(MeanField, OfDisplacementsIsHalfTheReferencesStressAndHalfTheirs) {
  for (const auto& [displacements, stresses] :
       {std::pair{"P2", "HYBRID"}, {"P3", "HYBRID+k=2"}, {"P4", "HYBRID+k=3"}}) {
    const StressField mean = field(displacements, "mean"), own = field(displacements, "stress"),
                      equilibrated = field(stresses, "stress");
    const double size = equilibrated.values().norm();
    EXPECT_LT((mean.values() - (own.values() + equilibrated.values()) / 2).norm(), 1e-5 * size)
        << displacements;
    EXPECT_GT((mean.values() - own.values()).norm(), 1e-3 * size) << displacements;
  }
}

TEST_F(MeanField, HasThePrintedError) {
  const Scene scene = {.friction = 0};
  const Mesh mesh = testing::catalogue_mesh("Mesh0");
  Mesh finer = mesh;
  for (int k = 0; k < 3; ++k) finer = uniformly_refined(finer);
  const testing::Solved coarse(scene, mesh), fine(scene, finer);
  const Problem& problem = *coarse.system.problem;
  const double norm = std::sqrt(stress_norm_squared(problem, coarse.hybrid.stress)),
               of_fine = fine.error().relative * norm;  // the fine one is off by at most
  for (const char* method : {"P2", "HYBRID"}) {
    const double off = testing::distance_to_finer(problem, field(method, "mean"), fine);
    EXPECT_LE(off, error_mean(method) * norm + of_fine) << method;
    EXPECT_LT(off, 0.9 * testing::distance_to_finer(problem, field(method, "stress"), fine))
        << method;
  }
}

}  // namespace
}  // namespace airybench::mean_field_test
