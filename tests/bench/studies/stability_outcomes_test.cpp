// The stability atlas on Mesh0 with one method of each kind, held against the committed outcomes:
// none may get worse, and no method may be wrong without saying so.
#include <cctype>
#include <chrono>
#include <cmath>
#include <iostream>

#include "assembly/msh_format.hpp"
#include "bench/cases/scene_file.hpp"
#include "bench/cases/study.hpp"
#include "bench/measuring/workbench.hpp"
#include "tests/bench/studies/expected_table.hpp"
#include "tests/support/places.hpp"

namespace airybench::stability_outcomes_test {
namespace {

using testing::ExpectedTable;

constexpr const char* update =
    "to accept what is found: AIRYBENCH_UPDATE=1 <build>/tests/bench/stability_outcomes_test";
// Its reference and most methods take long on four times as many triangles twice over.
constexpr const char* left_out_scene = "refine_2";
constexpr double longest_s = 3;  // of a case that is in the table

// Environments are deleted by GoogleTest.
ExpectedTable& table() {
  static auto* const environment =
      new ExpectedTable(testing::test_data("stability_outcomes.csv"), 2);
  return *environment;
}
[[maybe_unused]] const auto* const registered = ::testing::AddGlobalTestEnvironment(&table());

std::vector<Method> one_of_each_kind() {
  return select_methods(
      "3STEPD,3STEPD:REFINED,BLIND:SCHUR,BLIND:SCHUR:REFINED,BLIND:SKY,HYBRID,P2,"
      "ALM:r=20,rho=20,3STEPCG:DTIC6,SYMMLQ:DTIC6,SSKY");
}

std::vector<std::string> scene_names() {
#ifdef AIRYBENCH_SANITIZED
  return {"default", "boundary_no_contact", "friction_0", "load_none", "slivers_1e3"};
#else
  std::vector<std::string> names;
  for (const auto& file : stability_scenes())
    if (file.stem() != left_out_scene) names.push_back(file.stem());
  return names;
#endif
}

// The higher the better.
int rank(const std::string& outcome) {
  static const std::map<std::string, int> ranks = {
      {"ok", 5},        {"inaccurate", 4}, {"not_converged", 3},
      {"breakdown", 3}, {"unverified", 2}, {"wrong_success", 1}};
  const auto found = ranks.find(outcome);
  return found == ranks.end() ? 0 : found->second;
}

// Digits of the worst of the verifier's relative measures; empty without an answer.
std::string digits_of(const Record& record) {
  if (!record.verification) return "";
  const double worst = worst_measure(*record.verification).value;
  if (!std::isfinite(worst)) return "";
  return std::to_string(static_cast<int>(std::floor(-std::log10(std::max(worst, 1e-16)))));
}

void compare(const std::string& method, const ExpectedTable::Row& expected,
             const ExpectedTable::Row& found, const std::string& reason) {
  const std::string what = method + ": " + found[0] + " (" + reason + "), was " + expected[0];
  const int was = rank(expected[0]), is = rank(found[0]);
  EXPECT_GE(is, was) << what << "; " << update;
  if (is > was) std::cout << "better: " << what << "; " << update << "\n";
  if (expected[0] != "ok" || found[0] != "ok" || expected[1].empty()) return;
  ASSERT_FALSE(found[1].empty()) << what;
  EXPECT_GE(std::stoi(found[1]), std::stoi(expected[1]) - 2) << method << ": digits; " << update;
}

class StabilityOutcomes : public ::testing::TestWithParam<std::string> {};

TEST_P(StabilityOutcomes, AreNoWorseThanCommitted) {
  const std::string scene_name = GetParam();
  const Scene scene = read_scene(stability_scenes().front().parent_path() / (scene_name + ".json"));
  const auto problem =
      std::make_shared<const Problem>(pose(scene, testing::catalogue_mesh("Mesh0")));
  Options options;
  options.study = Study::stability;
  options.repetitions = 1;
  // No outcome shall depend on time: while testing only a hang meets the limit.
  options.timeout_s = testing::updating() ? 2 * longest_s : 300;
  Workbench bench(problem, options);
  if (testing::updating()) table().forget(scene_name);
  for (const Method& method : one_of_each_kind()) {
    const ExpectedTable::Row* expected = table().find({scene_name, method.name});
    if (!testing::updating()) {
      ASSERT_NE(expected, nullptr)
          << scene_name << ", " << method.name << " is not in stability_outcomes.csv; " << update;
      if (expected->front() == "left out") continue;
    }
    const auto start = std::chrono::steady_clock::now();
    const Record record = bench.examine(method, {}).record;
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    const ExpectedTable::Row found = {outcome_of(record), digits_of(record)};
    EXPECT_NE(found[0], "wrong_success") << method.name << ": " << record.status_reason;
    if (!testing::updating())
      compare(method.name, *expected, found, record.status_reason);
    else if (found[0] == "timeout" || spent.count() > longest_s)
      table().note({scene_name, method.name}, {"left out", ""});
    else
      table().note({scene_name, method.name}, found);
  }
}

INSTANTIATE_TEST_SUITE_P(Atlas, StabilityOutcomes, ::testing::ValuesIn(scene_names()),
                         [](const auto& scene) {
                           std::string name = scene.param;
                           for (char& c : name)
                             if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                           return std::to_string(scene.index) + "_" + name;
                         });

TEST(StabilityOutcomesTable, HasOnlyScenesThatExist) {
  for (const auto& [key, values] : table().rows())
    EXPECT_TRUE(
        std::filesystem::exists(stability_scenes().front().parent_path() / (key.front() + ".json")))
        << key.front();
}

}  // namespace
}  // namespace airybench::stability_outcomes_test
