// A stage that is left out costs neither time nor memory: it has no entry in the stage times, and
// the blocks that it would have needed are not on the heap.
#include <gtest/gtest.h>

#include "tests/bench/measure/examined.hpp"

namespace airybench::leaving_out_test {
namespace {

Record measured(const Scene& scene, const char* method = "3STEPD",
                std::optional<BoundaryRole> without = {}) {
  Mesh mesh = testing::small_tooth(14, 10);
  if (without) mesh = testing::with_role(std::move(mesh), *without, BoundaryRole::displacement);
  Record record =
      testing::measured(testing::posed(scene, std::move(mesh)), select_methods(method).front());
  EXPECT_TRUE(has_answer(record.status)) << record.status_reason;
  return record;
}

// By how many bytes: LeanScenes.SaveAtLeastTheBlocksThatAreNotBuilt.
TEST(LeavingOut, WithoutABoundaryNothingOfItIsMeasured) {
  const Record with = measured({}), no_contact = measured({}, "3STEPD", BoundaryRole::contact),
               no_force = measured({}, "3STEPD", BoundaryRole::force);
  EXPECT_TRUE(with.stage_samples[0].contains("contact"));
  EXPECT_FALSE(no_contact.stage_samples[0].contains("contact"));
  EXPECT_FALSE(no_contact.contact_iterations);
  EXPECT_FALSE(no_contact.error_force);
  EXPECT_EQ(no_force.n_f, 0);
  for (const Record* none : {&no_contact, &no_force})
    EXPECT_LT(none->peak_heap_bytes.value(), with.peak_heap_bytes.value());
}

TEST(LeavingOut, NoFrictionHalvesTheContactProblem) {
  const Record with = measured({}), none = measured({.friction = 0});
  EXPECT_EQ(2 * none.n_c.value(), with.n_c);
  EXPECT_EQ(none.n_f.value() + none.n_c.value(), with.n_f.value() + with.n_c.value());
}

TEST(LeavingOut, ZeroLoadsHaveNoVectors) {
  Scene heavy, scene;
  heavy.body_force_N_per_mm3 = {1, 2};
  scene.displacement_mm.setZero();
  scene.crown_radius_mm.reset();
  const Record with = measured(heavy), none = measured(scene);
  const auto q_and_gap = (with.n_phi.value() - 3 + with.n_c.value()) * 8;
  EXPECT_LE(none.blocks_heap_bytes.value(), with.blocks_heap_bytes.value() - q_and_gap);
}

TEST(LeavingOut, AMethodWithoutAirySystemHasNoneInMemory) {
  EXPECT_LT(50 * measured({}, "HYBRID").blocks_heap_bytes.value(),
            measured({}).blocks_heap_bytes.value());
}

}  // namespace
}  // namespace airybench::leaving_out_test
