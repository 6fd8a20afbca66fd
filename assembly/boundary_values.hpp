// What a scene prescribes on groups of boundary edges, by their labels (boundary_label).
#pragma once

#include <map>
#include <optional>
#include <string>

#include "assembly/problem.hpp"
#include "assembly/wall.hpp"

namespace airybench {

// Constant, or linear between two points and beyond, and constant across:
//   v(x) = v_0 + s (v_1 − v_0),   s = (x − p_0)·(p_1 − p_0) / |p_1 − p_0|²
template <typename Value>
struct LinearValue {
  std::array<Value, 2> values;
  std::array<Eigen::Vector2d, 2> at_mm = {Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 0)};

  Value at(const Eigen::Vector2d& x) const {
    const Eigen::Vector2d along = at_mm[1] - at_mm[0];
    const double s = (x - at_mm[0]).dot(along) / along.squaredNorm();
    return values[0] + s * (values[1] - values[0]);
  }
};

// Of a group of contact edges; what is missing is the scene's (contact_conditions.hpp).
struct ContactValues {
  std::optional<double> friction, clearance_mm;
  std::optional<Wall> wall, face;
};

struct BoundaryValues {
  // On a force boundary at most one of these; a pressure p is the traction −p n.
  std::optional<LinearValue<Eigen::Vector2d>> traction_MPa;
  std::optional<LinearValue<double>> pressure_MPa;
  // On a displacement boundary; without a displacement, that of the scene.
  std::optional<LinearValue<Eigen::Vector2d>> displacement_mm;
  enum class Support { full, normal };  // normal: a roller, u_n = n·displacement, σ_t = 0
  std::optional<Support> support;
  ContactValues contact;  // on a contact boundary
};
using BoundaryConditions = std::map<std::string, BoundaryValues>;

// Both throw TransformError, "label: key: value (allowed: …)".

// Refuses what is impossible on any mesh: numbers that are not finite, two points that are one, a
// key that the label's role does not have, traction and pressure at once.
void check_values(const BoundaryConditions& conditions);

// u0, f and rollers of `loads`. displacement_mm: of displacement edges without one of their own.
// Refuses a group that the mesh does not have, and supports that leave a rigid motion free (contact
// does not count: it may open).
void apply(const BoundaryConditions& conditions, const Eigen::Vector2d& displacement_mm,
           const Mesh& mesh, Loads& loads);

}  // namespace airybench
