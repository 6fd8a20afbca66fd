#include "verify/verifier.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <set>

#include "assembly/problem/scene.hpp"
#include "mesh/msh_format.hpp"
#include "solvers/methods.hpp"
#include "tests/support/places.hpp"
#include "tests/support/posed.hpp"

namespace airybench::answer_hash_test {
namespace {

Verification some_answer() {
  Verification v;
  v.strain_energy_Nmm = 27.1814;
  v.normal_resultant_N = -2908.1467;
  v.tangential_resultant_N = -194.8479;
  v.complementary_energy_Nmm = -27.2357;
  return v;
}

TEST(AnswerHash, IsTheSameForMethodsAndDiffersBetweenProblems) {
  std::set<std::string> hashes;
  for (const char* name : {"Mesh0", "Mesh1"})
    for (const double friction : {0.2, 0.1}) {
      const AirySystem system =
          airy_system(testing::posed({.friction = friction}, testing::catalogue_mesh(name)));
      std::set<std::string> of_methods;
      for (const Method& method : select_methods("3STEPD,BLIND,HYBRID")) {
        const Solution solution = run(method, system, {});
        ASSERT_EQ(solution.status, Status::ok) << method.name << ": " << solution.message;
        of_methods.insert(answer_hash(verify(system, solution, nullptr)));
      }
      EXPECT_EQ(of_methods.size(), 1u) << name << ", friction " << friction;
      EXPECT_EQ(of_methods.begin()->size(), 16u);
      hashes.merge(of_methods);
    }
  EXPECT_EQ(hashes.size(), 4u);
}

TEST(AnswerHash, EverySumCounts) {
  const std::string hash = answer_hash(some_answer());
  const auto changed = [](auto change) {
    Verification v = some_answer();
    change(v);
    return answer_hash(v);
  };
  EXPECT_EQ(changed([](Verification& v) { v.strain_energy_Nmm *= 1 + 1e-9; }), hash);
  EXPECT_NE(changed([](Verification& v) { v.strain_energy_Nmm *= 1.0002; }), hash);
  EXPECT_NE(changed([](Verification& v) { *v.normal_resultant_N *= 1.0002; }), hash);
  EXPECT_NE(changed([](Verification& v) { *v.tangential_resultant_N *= 1.001; }), hash);
  EXPECT_NE(changed([](Verification& v) { *v.complementary_energy_Nmm *= 1.0002; }), hash);
}

TEST(AnswerHash, RoundingAboutZeroDoesNotShow) {
  Verification v = some_answer();
  v.tangential_resultant_N = 0;
  const std::string hash = answer_hash(v);
  for (const double rounding : {1e-10, -1e-10}) {
    v.tangential_resultant_N = rounding;
    EXPECT_EQ(answer_hash(v), hash);
  }
  Verification no_contact;
  no_contact.strain_energy_Nmm = 1;
  EXPECT_EQ(answer_hash(no_contact).size(), 16u);
}

TEST(AnswerHash, ThereIsNoneWhereAllDigitsAreRounding) {
  Verification v = some_answer();
  v.unstressed = true;
  EXPECT_EQ(answer_hash(v), "");
  v = some_answer();
  v.strain_energy_Nmm = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(answer_hash(v), "");
}

}  // namespace
}  // namespace airybench::answer_hash_test
