// The error study's points on two small meshes, held against the committed ones: what a digit costs
// may not grow, nor an error.
#include <fmt/format.h>

#include "assembly/problem/scene.hpp"
#include "bench/plan/study.hpp"
#include "bench/records/summary.hpp"
#include "mesh/msh_format.hpp"
#include "tests/bench/measure/examined.hpp"
#include "tests/bench/studies/expected_table.hpp"
#include "tests/support/places.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/sanitized.hpp"

namespace airybench::error_points_test {
namespace {

using testing::ExpectedTable, testing::Update;

constexpr const char* how_to_update = "to accept what is found: tests/update_tables.sh";
constexpr double rounding = 1e-11;  // errors below are compared as this

ExpectedTable& table() {
  static auto* const environment = new ExpectedTable(testing::test_data("error_points.csv"), 4);
  return *environment;
}
[[maybe_unused]] const auto* const registered = ::testing::AddGlobalTestEnvironment(&table());

std::string text(const std::optional<double>& value) {
  return value ? fmt::format("{:.3g}", *value) : "";
}

// error_force, error_stress, error_total, iterations.
ExpectedTable::Row values_of(Record record) {
  summarise(record);
  ExpectedTable::Row row;
  for (const auto& error : {record.error_force, record.error_stress, record.error_total})
    row.push_back(text(error));
  if (record.uzawa_iterations)
    row.push_back(std::to_string(*record.uzawa_iterations));
  else
    row.push_back(record.linear_iterations ? std::to_string(*record.linear_iterations) : "");
  return row;
}

// Value by value the greater.
ExpectedTable::Row worst(const ExpectedTable::Row& a, const ExpectedTable::Row& b) {
  ExpectedTable::Row row = a;
  for (std::size_t i = 0; i < row.size(); ++i)
    if (row[i].empty() || (!b[i].empty() && std::stod(b[i]) > std::stod(row[i]))) row[i] = b[i];
  return row;
}

void compare(const ExpectedTable::Row& expected, const ExpectedTable::Row& found) {
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_EQ(found[i].empty(), expected[i].empty()) << "column " << i;
    if (expected[i].empty()) continue;
    const double was = std::stod(expected[i]), is = std::stod(found[i]);
    const bool iterations = i + 1 == expected.size();
    EXPECT_LE(is, iterations ? 1.1 * was + 1 : 10 * std::max(was, rounding))
        << (iterations ? "iterations; " : "error; ") << how_to_update;
  }
}

class ErrorPoints : public ::testing::TestWithParam<std::string> {};

TEST_P(ErrorPoints, AreNoWorseThanCommitted) {
  const std::string mesh = GetParam();
  Options options;
  options.run.study = *study_named("error");
  options.limits.repetitions = 1;
  testing::CaseBench bench(testing::posed(Scene(), testing::catalogue_mesh(mesh)), options);
  const Update update = testing::update();
  if (update == Update::anew) table().forget(mesh);
  for (const Method& method : select_methods("SDTIC6,3STEPCG6,ALM:r=20,rho=20,3STEPD,HYBRID,P2"))
    for (const StudyPoint& point : error_points(method, common_settings(options.run))) {
      const std::string knob =
          point.settings.stop == Stop::paper ? "paper's stop" : point.knob.name;
      const ExpectedTable::Row key = {mesh, method.name, knob, text(point.knob.value)};
      SCOPED_TRACE(fmt::format("{}, {}, {} {}", mesh, method.name, knob, text(point.knob.value)));
      const ExpectedTable::Row found = values_of(bench.examine(method, point));
      const ExpectedTable::Row* expected = table().find(key);
      if (update != Update::no)
        table().note(
            key, update == Update::widen && expected != nullptr ? worst(*expected, found) : found);
      else if (expected != nullptr)
        compare(*expected, found);
      else
        ADD_FAILURE() << "is not in error_points.csv; " << how_to_update;
    }
}

const std::vector<std::string> meshes = {"Mesh0", "Mesh1"};
INSTANTIATE_TEST_SUITE_P(Mesh, ErrorPoints,
                         ::testing::ValuesIn(meshes.begin(), meshes.end() - testing::sanitized));

}  // namespace
}  // namespace airybench::error_points_test
