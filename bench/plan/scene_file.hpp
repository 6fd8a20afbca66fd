// Scene files: JSON with the keys of struct Scene; a missing key keeps its default. scene_keys.cpp
// has the keys, docs/meshes-and-scenes.md their meaning.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "assembly/problem/pose.hpp"

namespace airybench {

// definition: the scene's JSON on one line, with the points of polyline files inlined.
// model_settings: how a mesh is made of a model, options of `meshgen --convert`.
struct SceneFile {
  Scene scene;
  std::string definition = "{}";
  std::vector<std::string> model_settings = {};
};
// Scene::name is the file's stem. Throws InputError, one line: file, key, value, allowed values.
SceneFile read_scene_file(const std::filesystem::path& file);
Scene read_scene(const std::filesystem::path& file);
// Outside the catalogue of meshes, a wall on the edges replaces the default crown.
SceneFile on_other_bodies(SceneFile file);
// place: for messages
SceneFile scene_file_of(const std::string& text, const std::string& place);
// Throws FileError if it has load steps.
SceneFile in_equal_steps(SceneFile file, int steps);
Scene scene_of(const std::string& text, const std::string& place);

}  // namespace airybench
