// What a scene does not need is left out, and the plan says so before anything is computed.
#include "bench/plan/stages.hpp"

#include <gtest/gtest.h>

#include <map>

#include "assembly/problem/scene.hpp"
#include "tests/support/contains.hpp"
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

// Of every method and many scenes which stages are run: LeanScenes.
TEST(Stages, WhatIsLeftOutHasItsReason) {
  const auto held_at = [](BoundaryRole role) {
    return testing::with_role(testing::small_tooth(4, 4), role, BoundaryRole::displacement);
  };
  const auto expect_reason = [](const std::map<std::string, std::string>& gone,
                                std::initializer_list<const char*> stages, const char* reason) {
    for (const char* stage : stages) EXPECT_EQ(gone.at(stage), reason) << stage;
  };
  EXPECT_EQ(left_out({}, "3STEPD").size(), 3u);
  expect_reason(left_out({}, "3STEPD"), {"assemble q"},
                "no displacement that strains the body, no body force, no thermal strain");
  expect_reason(left_out({}, "3STEPD"), {"assemble F"}, "no traction, no body force");
  expect_reason(left_out({}, "3STEPD"), {"assemble F0"}, "no body force");
  expect_reason(left_out({.friction = 0}, "3STEPD"), {"contact: tangential law"},
                "no friction: tangential forces are prescribed to zero");
  expect_reason(left_out({}, "3STEPD", held_at(BoundaryRole::contact)),
                {"assemble C_C", "assemble gap", "contact", "condense: D and G"},
                "no contact boundary");
  expect_reason(left_out({}, "3STEPD", held_at(BoundaryRole::force)),
                {"condense: eliminate force multipliers", "assemble C_F"}, "no force boundary");
  expect_reason(left_out({.crown_radius_mm = {}, .displacement_mm = {0, 0}}, "3STEPD"),
                {"assemble gap"}, "the gap is zero");
  expect_reason(left_out({}, "HYBRID"), {"assemble S"},
                "the method does not work with the Airy function");
}

TEST(Stages, ABodyThatContactAloneHoldsIsForMethodsThatCondense) {
  Scene scene;
  scene.boundary["displacement"].support = BoundaryValues::Support::normal;  // it may slide along
  for (const Method& method : methods()) {
    const auto gone = left_out(scene, method.name.c_str());
    const bool skipped = method.name.starts_with("ALM") || method.name == "HYBRID:PDAS" ||
                         method.name == "HYBRID:CG";
    EXPECT_EQ(gone.contains("all stages"), skipped) << method.name;
  }
}

TEST(Stages, OnABodyWithAHoleTheAiryMethodsAreSkipped) {
  for (const Method& method : methods()) {
    const auto gone = left_out({}, method.name.c_str(), testing::small_plate(1));
    const bool is_airy = method.unknowns == Unknowns::airy_function;
    ASSERT_EQ(gone.contains("all stages"), is_airy) << method.name;
    if (!is_airy) continue;
    EXPECT_TRUE(testing::contains(gone.at("all stages"), "with 1 hole")) << method.name;
    EXPECT_TRUE(testing::contains(gone.at("all stages"), "HYBRID, ")) << method.name;
  }
}

}  // namespace
}  // namespace airybench::stages_test
