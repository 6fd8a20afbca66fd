// How a scene's complaints read: "FILE: KEY: VALUE why".
#pragma once

#include <sstream>
#include <string>

#include "assembly/problem/scene.hpp"
#include "mesh/transform_error.hpp"

namespace airybench {

[[noreturn]] void fail(const Scene& scene, const std::string& key, const auto& value,
                       const std::string& why) {
  std::ostringstream line;
  line << scene.source << ": " << key << ": " << value << " " << why;
  throw SceneError(line.str());
}

// Names file and key of what a part of the scene complains about.
auto of_scene(const Scene& scene, const std::string& key, auto change) {
  try {
    return change();
  } catch (const TransformError& error) {
    throw SceneError(scene.source + ": " + (key.empty() ? "" : key + ": ") + error.what());
  }
}

// Of what later_steps[k] gives.
inline std::string key_of_step(std::size_t k) {
  return "load_steps: " + std::to_string(k + 1) + ": ";
}

}  // namespace airybench
