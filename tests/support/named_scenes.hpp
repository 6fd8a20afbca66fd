// Scenes for a test to go through, each told by what it changes of the default one.
#pragma once

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "assembly/scene.hpp"

namespace airybench::testing {

using NamedScenes = std::vector<std::pair<std::string, Scene>>;

inline NamedScenes named_scenes(
    std::initializer_list<std::pair<const char*, void (*)(Scene&)>> changes) {
  NamedScenes scenes;
  for (const auto& [name, change] : changes) change(scenes.emplace_back(name, Scene{}).second);
  return scenes;
}

}  // namespace airybench::testing
