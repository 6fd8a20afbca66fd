// A scene: bodies, loads and contact of a mesh. Its defaults are the documentation's steel tooth,
// pressed by 0.02 mm against a crowned rigid wall and sheared by 0.006 mm, with open, sticking and
// slipping contact points at once.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "assembly/problem/boundary_values.hpp"
#include "mesh/layers.hpp"
#include "mesh/transform.hpp"

namespace airybench {

// Two faces that press on each other (matched_faces.hpp), or are one (bonded_faces.hpp).
struct ContactPair {
  enum class Law : std::uint8_t { contact, bonded };
  std::array<std::vector<std::string>, 2> between;  // labels of each face's groups
  std::optional<double> friction = {};              // none: the scene's
  std::optional<double> clearance_mm = {};          // added to the gap, none: 0; < 0: interference
  std::optional<Law> law = {};                      // none: contact; bonded: without these two

  bool has_first(const std::string& label) const {
    return std::ranges::count(between[0], label) > 0;
  }
  bool has(const std::string& label) const {
    return has_first(label) || std::ranges::count(between[1], label) > 0;
  }
  bool is_bonded() const { return law == Law::bonded; }
};
// "contact:a and contact:b", with commas in faces of several groups.
std::string names_of(const ContactPair& pair);

// Per body, above that of the state without stress; of others zero.
using Temperatures = std::map<std::string, LinearValue<double>>;

// Changes from the previous load step; the rest stays.
struct LoadStep {
  std::optional<Eigen::Vector2d> displacement_mm, body_force_N_per_mm3;
  std::optional<double> clearance_mm;
  Temperatures temperature_K = {};         // of these bodies
  BoundaryConditions boundary;             // of these groups, which may be held or loaded now
  std::vector<ContactPair> contacts = {};  // pairs of the scene with another clearance
};

struct Scene {
  std::string name = "default";
  std::string source = "default scene";  // origin, for messages
  std::string group = {}, about = {};    // in an atlas of scenes; without effect

  // Applied to the mesh first; layers then are its bodies.
  MeshTransform mesh = {};
  Layers layers = {};

  // Compared with the transformed mesh; a contradiction is refused.
  std::optional<int> teeth = {};  // separate contact faces
  std::optional<double> root_half_height_mm = {}, length_mm = {}, tip_half_height_mm = {};

  Material material = {};                          // of every other body
  std::vector<Material> layer_materials = {};      // of layers: "layer k+1" has the k-th, cycled
  std::map<std::string, Material> materials = {};  // of bodies named here
  Plane plane = Plane::strain;

  // On Γ_C, except groups with their own values (contact_conditions.hpp).
  double friction = 0.2;                            // μ ≥ 0
  std::optional<double> crown_radius_mm = 400;      // of a wall at the faces; none: on the edges
  std::optional<Wall> wall = {}, face = {};         // instead of a crown
  double clearance_mm = 0;                          // added to the gap, ≥ 0
  Eigen::Vector2d displacement_mm = {0.02, 0.006};  // of Γ_D
  BoundaryConditions boundary = {};                 // groups with their own values
  std::vector<PointSupport> point_supports = {};    // take out rigid motions that are left free
  std::vector<ContactPair> contacts = {};           // their groups meet no wall
  Eigen::Vector2d body_force_N_per_mm3 = {0, 0};
  Temperatures temperature_K = {};

  // A path: displacements, tractions, body force and temperatures in this many equal parts (the gap
  // stays), or further steps after the loads above. Not both.
  int equal_steps = 1;
  std::vector<LoadStep> later_steps = {};
};
inline constexpr int max_load_steps = 1000;

// A scene does not fit a mesh. what(): one line with scene, key, value, what is allowed.
struct SceneError : InputError {
  using InputError::InputError;
};

// Whether a group of contact edges presses on another body.
bool is_paired(const Scene& scene, const std::string& label);

// Throws SceneError if a value is impossible on any mesh: ν ≥ 0.5, μ < 0, E ≤ 0, …
void check_values(const Scene& scene);

}  // namespace airybench
