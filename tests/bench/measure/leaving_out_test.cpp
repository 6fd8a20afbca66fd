// A stage that is left out costs neither time nor memory: it has no entry in the stage times, and
// the blocks that it would have needed are not on the heap.
#include <gtest/gtest.h>

#include "assembly/scene.hpp"
#include "bench/measure/workbench.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::leaving_out_test {
namespace {

Record measured(const Scene& scene, Mesh mesh, const char* method) {
  static Options options;
  options.repetitions = 1;
  Workbench bench(testing::posed(scene, std::move(mesh)), options);
  const Method chosen = select_methods(method).front();
  auto [record, choice] = bench.examine(chosen, {});
  bench.measure_memory(chosen, choice, record);
  add_run(bench.measure_time(chosen, choice), record);
  EXPECT_TRUE(has_answer(record.status)) << record.status_reason;
  return record;
}

Mesh without(BoundaryRole role) {
  Mesh mesh = testing::small_tooth(14, 10);
  for (BoundaryEdge& edge : mesh.boundary)
    if (edge.role == role) edge.role = BoundaryRole::displacement;
  return mesh;
}

TEST(LeavingOut, NoContactNoContactStageAndLessMemory) {
  const Record with = measured({}, testing::small_tooth(14, 10), "3STEPD");
  const Record none = measured({}, without(BoundaryRole::contact), "3STEPD");
  EXPECT_TRUE(with.stage_samples[0].contains("contact"));
  EXPECT_FALSE(none.stage_samples[0].contains("contact"));
  EXPECT_FALSE(none.contact_iterations);
  EXPECT_FALSE(none.error_force);
  // X loses its n_c columns, and D and K_FF⁻¹K_FC go.
  const auto columns = with.n_c.value() * (with.n_phi.value() - 3) * 8;
  EXPECT_LE(none.peak_heap_bytes.value(), with.peak_heap_bytes.value() - columns);
}

TEST(LeavingOut, NoForceBoundaryNoMultipliersInMemory) {
  const Record with = measured({}, testing::small_tooth(14, 10), "3STEPD");
  const Record none = measured({}, without(BoundaryRole::force), "3STEPD");
  EXPECT_EQ(none.n_f, 0);
  const auto columns = with.n_f.value() * (with.n_phi.value() - 3) * 8;
  EXPECT_LE(none.peak_heap_bytes.value(), with.peak_heap_bytes.value() - columns);
}

TEST(LeavingOut, NoFrictionHalvesTheContactProblem) {
  Scene scene;
  scene.friction = 0;
  const Record with = measured({}, testing::small_tooth(14, 10), "3STEPD");
  const Record none = measured(scene, testing::small_tooth(14, 10), "3STEPD");
  EXPECT_EQ(2 * none.n_c.value(), with.n_c);
  EXPECT_EQ(none.n_f.value() + none.n_c.value(), with.n_f.value() + with.n_c.value());
}

TEST(LeavingOut, ZeroLoadsHaveNoVectors) {
  Scene scene;
  scene.displacement_mm.setZero();
  scene.crown_radius_mm.reset();
  Scene heavy;
  heavy.body_force_N_per_mm3 = {1, 2};
  const Record with = measured(heavy, testing::small_tooth(14, 10), "3STEPD");
  const Record none = measured(scene, testing::small_tooth(14, 10), "3STEPD");
  const auto q_and_gap = (with.n_phi.value() - 3 + with.n_c.value()) * 8;
  EXPECT_LE(none.blocks_heap_bytes.value(), with.blocks_heap_bytes.value() - q_and_gap);
}

TEST(LeavingOut, AMethodWithoutAirySystemHasNoneInMemory) {
  const Record airy = measured({}, testing::small_tooth(14, 10), "3STEPD");
  const Record hybrid = measured({}, testing::small_tooth(14, 10), "HYBRID");
  EXPECT_LT(50 * hybrid.blocks_heap_bytes.value(), airy.blocks_heap_bytes.value());
}

}  // namespace
}  // namespace airybench::leaving_out_test
