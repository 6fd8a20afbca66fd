// `--fields=mean`: what is written.
#include <gtest/gtest.h>

#include <array>

#include "assembly/stress_field.hpp"
#include "tests/bench/measure/csv_columns.hpp"
#include "tests/support/bench_command.hpp"

namespace airybench::mean_field_test {
namespace {

// A row per triangle, third and corner.
StressField read_stress(const std::string& csv) {
  const testing::Columns columns = testing::csv_columns(csv);
  std::array<std::vector<double>, 3> components;
  for (const auto& [k, name] : {std::pair(0, "sxx_MPa"), {1, "syy_MPa"}, {2, "sxy_MPa"}})
    components.at(k) = testing::numbers(columns, name);
  StressField field(components[0].size() / 9, 1);
  for (Eigen::Index row = 0; row < field.values().cols(); ++row)
    for (int k = 0; k < 3; ++k)
      field.values()(k, row) = components[k][static_cast<std::size_t>(row)];
  return field;
}

// Its error: MeanStress.IsNearerToTheSolutionThanItsBoundAndThanEitherStress.
TEST(MeanField, OfDisplacementsIsHalfTheReferencesStressAndHalfTheirs) {
  const testing::BenchCommand bench;
  testing::write_text(bench.path("smooth.json"), R"({"friction": 0})");
  bench.expect_ok(
      "--mesh=Mesh0 --scene=smooth.json --method=HYBRID,P2,HYBRID:k=2,P3,HYBRID:k=3,P4 "
      "--repetitions=1 --fields=mean --out=o");
  const auto field = [&](const std::string& method, const std::string& kind) {
    return read_stress(bench.content("o/fields/Mesh0--smooth--" + method + "." + kind + ".csv"));
  };
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

}  // namespace
}  // namespace airybench::mean_field_test
