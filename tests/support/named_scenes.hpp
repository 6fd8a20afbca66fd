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

// What a method must cope with: plane, friction, load, gap.
inline NamedScenes scene_variants() {
  return named_scenes({
      {"default", [](Scene&) {}},
      {"frictionless", [](Scene& s) { s.friction = 0; }},
      {"plane stress", [](Scene& s) { s.plane = Plane::stress; }},
      {"body force",
       [](Scene& s) {
         s.body_force_N_per_mm3 = {3, -1};
       }},
      {"frictionless, body force",
       [](Scene& s) {
         s.friction = 0;
         s.body_force_N_per_mm3 = {3, -1};
       }},
      {"flat face", [](Scene& s) { s.crown_radius_mm.reset(); }},
      {"clearance", [](Scene& s) { s.clearance_mm = 0.005; }},
      {"high friction", [](Scene& s) { s.friction = 5; }},
      {"no load", [](Scene& s) { s.displacement_mm.setZero(); }},
      {"nothing touches", [](Scene& s) { s.clearance_mm = 1; }},
      {"pulled away", [](Scene& s) { s.displacement_mm.x() = -0.02; }},
  });
}

// Four layers, every other one so many times as stiff as the steel between.
inline Scene layered_scene(const Eigen::Vector2d& normal, double stiffness) {
  Scene scene;
  scene.layers.normal = normal;
  scene.layers.count = 4;
  scene.layer_materials.resize(2, scene.material);
  scene.layer_materials[1].young_MPa *= stiffness;
  return scene;
}

}  // namespace airybench::testing
