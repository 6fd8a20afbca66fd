#include "assembly/problem/pose.hpp"
#include "bench/plan/scene_file.hpp"
#include "tests/fuzz/readers.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::fuzz {
namespace {

// Transformations may ask for a million triangles, which is no fault of theirs, but slow.
bool is_cheap(const MeshTransform& mesh) {
  return mesh.refine <= 1 && (!mesh.grade || mesh.grade->ratio <= 100);
}

}  // namespace

void scene(const std::string& text) {
  static const Mesh block = testing::small_block(2, 2, 0);
  const Scene scene = scene_of(text, "fuzz.json");
  if (is_cheap(scene.mesh)) pose(scene, block);
}

}  // namespace airybench::fuzz
