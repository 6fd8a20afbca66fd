// What a scene does not need is left out, and the plan says so before anything is computed.
#include "bench/plan/stages.hpp"

#include <gtest/gtest.h>

#include <map>

#include "assembly/problem/scene.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::stages_test {
namespace {

std::map<std::string, std::string> left_out(const Scene& scene, const char* method,
                                            Mesh mesh = testing::small_tooth(4, 4)) {
  const auto problem = testing::posed(scene, std::move(mesh));
  std::map<std::string, std::string> result;
  for (const StageDecision& d :
       decide_stages(problem, select_methods(method).front(), /*fields_asked=*/true))
    if (!d.run) result[d.stage] = d.reason;
  return result;
}

using Expected = std::map<std::string, std::string>;

TEST(Stages, DefaultSceneLeavesOutOnlyWhatItHasNot) {
  const std::string rigid = "no displacement that strains the body, no body force";
  EXPECT_EQ(left_out({}, "3STEPD"), (Expected{{"assemble q", rigid},
                                              {"assemble F", "no traction, no body force"},
                                              {"assemble F0", "no body force"}}));
}

TEST(Stages, WithoutFrictionTheTangentialLawGoes) {
  EXPECT_EQ(left_out({.friction = 0}, "3STEPD").at("contact: tangential law"),
            "no friction: tangential forces are prescribed to zero");
}

// Of a tooth that is held where edges have this role.
std::map<std::string, std::string> left_out_without(BoundaryRole role) {
  return left_out({}, "3STEPD",
                  testing::with_role(testing::small_tooth(4, 4), role, BoundaryRole::displacement));
}

TEST(Stages, WithoutContactCondensationAndContactLoopGo) {
  const auto gone = left_out_without(BoundaryRole::contact);
  for (const char* stage : {"assemble C_C", "assemble gap", "contact", "condense: D and G"})
    EXPECT_EQ(gone.at(stage), "no contact boundary") << stage;
}

TEST(Stages, WithoutForceBoundaryStepTwoGoes) {
  const auto gone = left_out_without(BoundaryRole::force);
  for (const char* stage : {"condense: eliminate force multipliers", "assemble C_F"})
    EXPECT_EQ(gone.at(stage), "no force boundary") << stage;
}

TEST(Stages, ZeroLoadsAreNotAssembled) {
  const auto gone = left_out({.crown_radius_mm = {}, .displacement_mm = {0, 0}}, "3STEPD");
  EXPECT_EQ(gone.at("assemble q"), "no displacement that strains the body, no body force");
  EXPECT_EQ(gone.at("assemble gap"), "the gap is zero");
}

TEST(Stages, AMethodWithoutAiryFunctionGetsNoAirySystem) {
  EXPECT_EQ(left_out({}, "HYBRID").at("assemble S"),
            "the method does not work with the Airy function");
}

TEST(Stages, ABodyThatContactAloneHoldsIsForMethodsThatCondense) {
  Scene scene;
  scene.boundary["displacement"].support = BoundaryValues::Support::normal;  // it may slide along
  for (const Method& method : methods()) {
    auto gone = left_out(scene, method.name.c_str());
    const bool skipped = method.name.starts_with("ALM") || method.name == "HYBRID:CG";
    EXPECT_EQ(gone.contains("all stages"), skipped) << method.name;
    if (!skipped) continue;
    EXPECT_EQ(
        gone["all stages"],
        "a body that contact or points alone hold: its motion is found by methods of ours that "
        "condense on the contact points");
  }
}

TEST(Stages, OnABodyWithAHoleTheAiryMethodsAreSkipped) {
  const std::string why =
      "a body with 1 hole needs a multi-valued Airy function (methods without one: HYBRID, "
      "HYBRID:CHOLMOD, HYBRID:MUMPS, HYBRID:CG, P2, P3, P4)";
  for (const Method& method : methods()) {
    const auto gone = left_out({}, method.name.c_str(), testing::small_plate(1));
    if (method.blocks == Blocks::airy)
      EXPECT_EQ(gone, (Expected{{"all stages", why}})) << method.name;
    else
      EXPECT_FALSE(gone.contains("all stages")) << method.name;
  }
}

}  // namespace
}  // namespace airybench::stages_test
