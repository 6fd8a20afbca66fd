// The promise: no method is wrong and says ok, and none has a true error of more than ten times its
// own estimate. Here on scenes with two to four extremes at random (random_scenes.hpp); no scene is
// expected to be solved, but every answer to know how good it is.
//
// AIRYBENCH_RANDOM_SCENES=FIRST,COUNT[,MESH] in the environment tries others, and more.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <iostream>

#include "bench/records/summary.hpp"
#include "tests/bench/measure/examined.hpp"
#include "tests/support/places.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/random_scenes.hpp"
#include "tests/support/sanitized.hpp"

namespace airybench::random_scenes_test {
namespace {

constexpr unsigned seed = 1;
constexpr double max_times_the_estimate = 10;
// Below, an error is the rounding of the stresses, of which no estimate speaks.
constexpr double rounding = 1e-12;

constexpr int scenes = testing::sanitized ? 4 : 40;

// Every kind of method on every scene would take long: the direct ones, and one of higher degree
// and an iterative one in turn.
std::vector<Method> methods(int number) {
  static const std::vector<Method> direct = select_methods(
      "3STEPD,3STEPD:CHOLMOD,BLIND:SCHUR,BLIND:SKY,HYBRID,HYBRID:CHOLMOD,HYBRID:MUMPS,HYBRID:CG,"
      "HYBRID:PDAS,P2");
  static const std::vector<Method> iterative = select_methods(
      "SSKY,ALM:r=20,rho=20,3STEPCG:DTIC6,SYMMLQ:DTIC6,3STEPCG:DTIC3,SDTIC3,3STEPCG:FLIC2,"
      "SYMMLQ:FLIC5,3STEPD:REFINED,ALM:AUTO");
  std::vector<Method> all = direct;
  all.push_back(select_methods(hybrid_of_degree(2 + number % (highest_stress_degree - 1))).front());
  all.push_back(iterative[static_cast<std::size_t>(number) % iterative.size()]);
  return all;
}

struct Tally {
  int tried = 0, compared = 0, not_posed = 0;  // compared: error with estimate
  std::map<std::string, int> outcomes;
  double worst_ratio = 0;
  std::string worst;
};

// What the verifier found, largest; of a displacement method what it can. Beyond 1 there is no
// digit to be wrong about.
double true_error(const Record& r) {
  double worst = 0;
  for (const auto& error :
       {r.error_stress, r.error_force, r.equilibrium_residual, r.natural_map_residual})
    worst = std::max(worst, error.value_or(0));
  return std::min(worst, 1.0);
}

void hold(const std::string& name, const Record& record, Tally& tally) {
  ++tally.tried;
  ++tally.outcomes[outcome_of(record)];
  EXPECT_NE(outcome_of(record), "wrong_success") << name << ": " << record.status_reason;
  if (!record.error_estimate || !is_verified(record) ||
      (!record.error_stress && !record.in_displacements))
    return;
  ++tally.compared;
  const double error = true_error(record), noise = 10 * record.reference_error.value_or(0);
  const double ratio = error / std::max({*record.error_estimate, noise, rounding});
  if (ratio > tally.worst_ratio) {
    tally.worst_ratio = ratio;
    tally.worst = name;
  }
  EXPECT_LE(ratio, max_times_the_estimate)
      << name << ": " << outcome_of(record) << ", error " << error << ", its own estimate "
      << *record.error_estimate << ", of the reference " << record.reference_error.value_or(0)
      << "; stress, force, equilibrium, law " << record.error_stress.value_or(0) << " "
      << record.error_force.value_or(0) << " " << record.equilibrium_residual.value_or(0) << " "
      << record.natural_map_residual.value_or(0);
}

TEST(RandomScenes, NoMethodIsWrongAndSaysOk) {
  const testing::Campaign wanted = testing::campaign(scenes);
  Tally tally;
  for (int k = wanted.first; k < wanted.first + wanted.count; ++k) {
    const Scene scene = testing::random_scene(seed, k);
    std::shared_ptr<const Problem> problem;
    try {
      problem = testing::posed(scene, testing::catalogue_mesh(wanted.mesh));
    } catch (const SceneError&) {
      ++tally.not_posed;
      continue;
    }
    Options options;
    options.run.study = *study_named("stability");
    options.limits.repetitions = 1;
    options.limits.timeout_s =
        wanted.is_asked_for ? 20 : 1;  // a timeout is no claim, and no failure
    testing::CaseBench bench(problem, options);
    for (const Method& method : methods(k))
      hold(fmt::format("{} ({}), {}", k, scene.about, method.name), bench.examine(method, ""),
           tally);
  }
  std::cout << fmt::format("tried {}, scenes that cannot be posed {}", tally.tried,
                           tally.not_posed);
  for (const auto& [outcome, count] : tally.outcomes)
    std::cout << fmt::format(", {} {}", outcome, count);
  std::cout << fmt::format("; worst error / estimate {:.1f}: {}\n", tally.worst_ratio, tally.worst);
  if (wanted.is_asked_for) return;
  EXPECT_GT(tally.outcomes["ok"], tally.tried / 3);
  EXPECT_GT(tally.compared, tally.tried / 2);
}

}  // namespace
}  // namespace airybench::random_scenes_test
