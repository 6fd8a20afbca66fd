// A scene: what is done to a mesh. Its defaults are the steel tooth of the documentation, pressed
// by 0.02 mm against a crowned rigid wall and sheared by 0.006 mm, with open, sticking and slipping
// contact points at once.
#pragma once

#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "assembly/boundary_values.hpp"
#include "mesh/layers.hpp"
#include "mesh/transform.hpp"

namespace airybench {

// What a load step changes of the one before; the rest stays.
struct LoadStep {
  std::optional<Eigen::Vector2d> displacement_mm, body_force_N_per_mm3;
  std::optional<double> clearance_mm;
  BoundaryConditions boundary;  // of these groups; supports stay
};

struct Scene {
  std::string name = "default";
  std::string source = "default scene";  // where it comes from; for messages
  std::string group = {}, about = {};    // of an atlas of scenes; they change nothing

  // What is done to the mesh before anything else; layers then are its bodies.
  MeshTransform mesh = {};
  Layers layers = {};

  // Geometry belongs to the transformed mesh. What is given here is compared with it, and a
  // contradiction is refused.
  std::optional<int> teeth = {};  // separate contact faces
  std::optional<double> root_half_height_mm = {}, length_mm = {}, tip_half_height_mm = {};

  Material material = {};                      // every body …
  std::vector<Material> layer_materials = {};  // … but layers: "layer k+1" has the k-th, cycled …
  std::map<std::string, Material> materials = {};  // … and bodies named here
  Plane plane = Plane::strain;

  // On Γ_C, but for groups with values of their own (contact_conditions.hpp).
  double friction = 0.2;                            // μ ≥ 0
  std::optional<double> crown_radius_mm = 400;      // of a wall at the faces; none: flat
  std::optional<Wall> wall = {}, face = {};         // instead of a crown
  double clearance_mm = 0;                          // added to the gap, ≥ 0
  Eigen::Vector2d displacement_mm = {0.02, 0.006};  // of Γ_D …
  BoundaryConditions boundary = {};                 // … but groups with a value of their own
  Eigen::Vector2d body_force_N_per_mm3 = {0, 0};

  // A path: displacements, tractions and body force in so many equal parts (the gap stays), or from
  // the loads above through further steps. Not both.
  int equal_steps = 1;
  std::vector<LoadStep> later_steps = {};
};
inline constexpr int most_load_steps = 1000;

// A scene that cannot be posed on a mesh. what(): one line with scene, key, value, what is allowed.
struct SceneError : InputError {
  using InputError::InputError;
};

// Throws SceneError when a value is impossible in itself: ν ≥ 0.5, μ < 0, E ≤ 0, …
void check_values(const Scene& scene);

// Transforms the mesh and poses the scene on it; of contact edges those that can reach their wall.
// A crown needs faces with ends. Throws SceneError. Load steps after the first are
// Problem::later_steps.
Problem pose(const Scene& scene, Mesh mesh);

}  // namespace airybench
