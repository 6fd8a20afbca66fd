// Scenes for a test to go through, each told by what it changes of the default one.
#pragma once

#include <initializer_list>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "assembly/problem/scene.hpp"

namespace airybench::testing {

using NamedScenes = std::vector<std::pair<std::string, Scene>>;

inline NamedScenes named_scenes(
    std::initializer_list<std::pair<const char*, void (*)(Scene&)>> changes) {
  NamedScenes scenes;
  for (const auto& [name, change] : changes) change(scenes.emplace_back(name, Scene{}).second);
  return scenes;
}

inline NamedScenes scenes_named(const std::vector<std::string>& names) {
  static const std::map<std::string, void (*)(Scene&)> changes = {
      {"default", [](Scene&) {}},
      {"frictionless", [](Scene& s) { s.friction = 0; }},
      {"friction 1", [](Scene& s) { s.friction = 1; }},
      {"friction 2", [](Scene& s) { s.friction = 2; }},
      {"friction 5", [](Scene& s) { s.friction = 5; }},
      {"friction 1, sheared",
       [](Scene& s) {
         s.friction = 1;
         s.displacement_mm = {0.015, 0.02};
         s.crown_radius_mm = 200;
       }},
      {"friction 3, sheared",
       [](Scene& s) {
         s.friction = 3;
         s.displacement_mm = {0.01, 0.03};
         s.crown_radius_mm = 200;
       }},
      {"plane stress", [](Scene& s) { s.plane = Plane::stress; }},
      {"nearly incompressible", [](Scene& s) { s.material.poisson = 0.4999; }},
      {"layers",
       [](Scene& s) {
         s.layers.count = 3;
         s.layer_materials = {{210000, 0.3}, {2100, 0.45}};
       }},
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
      {"no load", [](Scene& s) { s.displacement_mm.setZero(); }},
      {"nothing touches", [](Scene& s) { s.clearance_mm = 1; }},
      {"pulled away", [](Scene& s) { s.displacement_mm.x() = -0.02; }},
  };
  NamedScenes scenes;
  for (const std::string& name : names) changes.at(name)(scenes.emplace_back(name, Scene{}).second);
  return scenes;
}

// What a method must cope with: plane, friction, load, gap.
inline NamedScenes scene_variants() {
  return scenes_named({"default", "frictionless", "plane stress", "body force",
                       "frictionless, body force", "flat face", "clearance", "friction 5",
                       "no load", "nothing touches", "pulled away"});
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
