// The stability atlas on Mesh0 with one method of each kind, held against the committed outcomes:
// none may get worse, and no method may be wrong without saying so.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>
#include <chrono>
#include <cmath>
#include <iostream>

#include "bench/plan/scene_file.hpp"
#include "bench/plan/study.hpp"
#include "bench/records/summary.hpp"
#include "mesh/msh_format.hpp"
#include "tests/bench/measure/examined.hpp"
#include "tests/bench/studies/expected_table.hpp"
#include "tests/support/places.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/sanitized.hpp"

namespace airybench::stability_outcomes_test {
namespace {

using testing::ExpectedTable, testing::Update;

constexpr const char* how_to_update = "to accept what is found: tests/update_tables.sh";
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
      "3STEPD,3STEPD:REFINED,BLIND:SCHUR,BLIND:SCHUR:REFINED,BLIND:SKY,HYBRID,HYBRID:CHOLMOD,"
      "HYBRID:MUMPS,HYBRID:CG,P2,"
      "ALM:r=20,rho=20,3STEPCG:DTIC6,SYMMLQ:DTIC6,SSKY");
}

std::vector<std::string> scene_names() {
  if (testing::sanitized)
    return {"default", "boundary_no_contact", "friction_0", "load_none", "slivers_10"};
  std::vector<std::string> names;
  for (const auto& file : scenes_of(*study_named("stability")))
    if (file.stem() != left_out_scene) names.push_back(file.stem());
  return names;
}

constexpr double target = 1e-6;
// An outcome is a close call where the range of levels, widened by this factor, holds the target.
constexpr double margin = 3;
constexpr double level_growth = 10;  // beyond the greatest level
constexpr double rounding = 1e-12;   // levels below are compared as this

// The higher the better.
int rank(const std::string& outcome) {
  static const std::map<std::string, int> ranks = {
      {"ok", 5},        {"inaccurate", 4}, {"not_converged", 3},
      {"breakdown", 3}, {"unverified", 2}, {"wrong_success", 1}};
  const auto found = ranks.find(outcome);
  return found == ranks.end() ? 0 : found->second;
}

// What ok and inaccurate are decided by: the larger of the verifier's worst relative measure and
// the method's own estimate. None without an answer.
std::optional<double> error_level(const Record& record) {
  if (!is_verified(record)) return {};
  Verification seen;
  seen.equilibrium_residual = record.equilibrium_residual.value_or(*seen.equilibrium_residual);
  seen.error_stress = record.error_stress;
  seen.error_force = record.error_force;
  seen.natural_map_residual = record.natural_map_residual;
  const double level = std::max(worst_measure(seen).value, record.error_estimate.value_or(0));
  return std::isfinite(level) ? std::optional(level) : std::nullopt;
}

// What a case may give: the worst outcome, and the range of its error level, over the kernels of
// OpenBLAS and numbers of threads that the table was made with.
struct Expected {
  std::string outcome;
  std::optional<double> least, greatest;

  explicit Expected(const Record& record)
      : outcome(outcome_of(record)), least(error_level(record)), greatest(least) {}
  explicit Expected(const ExpectedTable::Row& row) : outcome(row[0]) {
    if (row[1].empty()) return;
    least = std::stod(row[1]);
    greatest = std::stod(row[2]);
  }
  ExpectedTable::Row row() const {
    const auto text = [](const std::optional<double>& level) {
      return level ? fmt::format("{:.1e}", *level) : "";
    };
    return {outcome, text(least), text(greatest)};
  }
  void include(const Expected& other) {
    if (rank(other.outcome) < rank(outcome)) outcome = other.outcome;
    if (!least || (other.least && other.least < least)) least = other.least;
    if (!greatest || (other.greatest && other.greatest > greatest)) greatest = other.greatest;
  }
  // A claim that misses the target by less than the margin is a close call's, not a lie.
  void forgive_near_miss() {
    if (outcome == "wrong_success" && greatest && *greatest < target * margin)
      outcome = "inaccurate";
  }
  // Between ok and inaccurate: a processor that the table was not made with may decide otherwise.
  bool is_close_call() const {
    return least && least.value() < target * margin && greatest.value() > target / margin;
  }
};

void compare(const std::string& name, const Expected& expected, const Record& record) {
  Expected found(record);
  if (expected.is_close_call()) found.forgive_near_miss();
  EXPECT_NE(found.outcome, "wrong_success") << name << ": " << record.status_reason;
  const std::string what =
      fmt::format("{}: {} ({}), was {}; {}", name, fmt::join(found.row(), " "),
                  record.status_reason, fmt::join(expected.row(), " "), how_to_update);
  EXPECT_EQ(found.outcome == "unstressed", expected.outcome == "unstressed") << what;
  const bool close = expected.is_close_call();
  EXPECT_GE(rank(found.outcome), close ? rank("inaccurate") : rank(expected.outcome)) << what;
  if (close)
    std::cout << "close call: " << what << "\n";
  else if (rank(found.outcome) > rank(expected.outcome))
    std::cout << "better: " << what << "\n";
  if (!expected.greatest || rank(found.outcome) < rank("inaccurate")) return;
  ASSERT_TRUE(found.greatest) << what;
  constexpr double no_digit = 1;  // beyond, one answer is as wrong as another
  EXPECT_LE(std::min(*found.greatest, no_digit),
            level_growth * std::max(*expected.greatest, rounding))
      << what;
}

class StabilityOutcomes : public ::testing::TestWithParam<std::string> {};

TEST_P(StabilityOutcomes, AreNoWorseThanCommitted) {
  const std::string scene_name = GetParam();
  const Scene scene = read_scene(testing::stability_scenes_folder() / (scene_name + ".json"));
  const auto problem = testing::posed(scene, testing::catalogue_mesh("Mesh0"));
  Options options;
  options.run.study = *study_named("stability");
  options.limits.repetitions = 1;
  // No outcome shall depend on time: while testing only a hang meets the limit.
  const Update update = testing::update();
  options.limits.timeout_s = update == Update::anew ? 2 * longest_s : 300;
  testing::CaseBench bench(problem, options);
  if (update == Update::anew) table().forget(scene_name);
  for (const Method& method : one_of_each_kind()) {
    const ExpectedTable::Row* expected = table().find({scene_name, method.name});
    if (update == Update::no) {
      ASSERT_NE(expected, nullptr) << scene_name << ", " << method.name
                                   << " is not in stability_outcomes.csv; " << how_to_update;
    }
    if (update != Update::anew && expected && expected->front() == "left out") continue;
    const auto start = std::chrono::steady_clock::now();
    const Record record = bench.examine(method, "");
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    if (update == Update::no) {
      compare(scene_name + "/" + method.name, Expected(*expected), record);
      continue;
    }
    Expected found(record);
    found.forgive_near_miss();
    EXPECT_NE(found.outcome, "wrong_success") << method.name << ": " << record.status_reason;
    if (update == Update::widen && expected) found.include(Expected(*expected));
    const bool is_long = found.outcome == "timeout" || spent.count() > longest_s;
    table().note({scene_name, method.name}, update == Update::anew && is_long
                                                ? ExpectedTable::Row{"left out", "", ""}
                                                : found.row());
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
        std::filesystem::exists(testing::stability_scenes_folder() / (key.front() + ".json")))
        << key.front();
}

}  // namespace
}  // namespace airybench::stability_outcomes_test
