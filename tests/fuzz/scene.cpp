#include <cstdlib>

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
  const SceneFile file = scene_file_of(text, "fuzz.json");
  const std::string definition = file.definition();
  if (scene_file_of(definition, "written.json").definition() != definition) std::abort();
  if (is_cheap(file.scene.mesh)) pose(file.scene, block);
}

}  // namespace airybench::fuzz
