// Scene files: JSON with the keys of struct Scene; a missing key keeps its default. scene_keys.cpp
// has the keys, docs/scenes.md their meaning.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "assembly/problem/pose.hpp"

namespace airybench {

struct SceneFile {
  Scene scene;
  // How a mesh is made of a model: roles of its curves ("3", "contact:sole"), unit of its lengths.
  std::vector<std::pair<std::string, std::string>> roles = {};
  std::string length_unit = "mm";
  std::set<std::string> keys = {};  // that the file has; the others have their defaults

  std::vector<std::string> model_settings() const;  // options of `meshgen --convert`
  std::string definition() const;                   // the file on one line; records have it
  std::string text() const;                         // for a person, a key a line
};
// Scene::name is the file's stem; a polyline's file is read. Throws InputError, one line: file,
// key, value, allowed values.
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
