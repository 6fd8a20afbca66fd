// Scene files: JSON with the keys of the struct Scene; missing keys take its defaults. The keys are
// in scene_keys.cpp, their meaning in docs/meshes-and-scenes.md.
#pragma once

#include <filesystem>

#include "assembly/scene.hpp"

namespace airybench {

// definition: its JSON on one line, with what it has from other files in it.
struct SceneFile {
  Scene scene;
  std::string definition = "{}";
};
// Throws SceneError, one line: file, key, value, what is allowed. Scene::name is the file's stem.
SceneFile read_scene_file(const std::filesystem::path& file);
Scene read_scene(const std::filesystem::path& file);
// The crown is the catalogue's: on another body a scene that says nothing of it has a flat wall.
SceneFile on_other_bodies(SceneFile file);
// The same of a scene file's text; place is what messages name.
Scene scene_of(const std::string& text, const std::string& place);

}  // namespace airybench
