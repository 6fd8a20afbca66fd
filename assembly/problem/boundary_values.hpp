// Values that a scene prescribes on groups of boundary edges, by their labels (boundary_label).
#pragma once

#include <map>
#include <optional>
#include <string>

#include "assembly/problem/magnitudes.hpp"
#include "assembly/problem/problem.hpp"
#include "assembly/problem/wall.hpp"

namespace airybench {

inline constexpr double max_friction = 1e6;  // more is no other law, and loses digits of μ F_n

// Constant, or linear along p_0 p_1 and beyond, constant across:
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

// On a group of contact edges; the scene has the missing values (contact_conditions.hpp).
struct ContactValues {
  std::optional<double> friction, clearance_mm;
  std::optional<Wall> wall, face;
};

struct BoundaryValues {
  // On a force boundary, at most one of these. A pressure p is the traction −p n.
  std::optional<LinearValue<Eigen::Vector2d>> traction_MPa;
  std::optional<LinearValue<double>> pressure_MPa;
  // On a displacement boundary; without a displacement, the scene's holds.
  std::optional<LinearValue<Eigen::Vector2d>> displacement_mm;
  enum class Support { full, normal };  // normal: a roller, u_n = n·displacement, σ_t = 0
  std::optional<Support> support;
  ContactValues contact;  // on a contact boundary
};
using BoundaryConditions = std::map<std::string, BoundaryValues>;

// All throw TransformError, "label: key: value (allowed: …)".

// Refuses what is impossible on any mesh: non-finite numbers, two equal points, a key that the
// label's role does not have, traction and pressure together.
void check_values(const BoundaryConditions& conditions);
// The same of a load step, which may load a group that was held, and hold one that was loaded.
void check_values_of_step(const BoundaryConditions& conditions);

// Of a group that the mesh has in this role: force where the values load it, displacement where
// they hold it.
BoundaryRole role_under(BoundaryRole of_mesh, const BoundaryValues& given);
// Per row of Mesh::boundary; empty: as the mesh has them.
std::vector<BoundaryRole> roles_under(const BoundaryConditions& conditions, const Mesh& mesh);

// Refuses what is impossible of one value, by its key.
template <typename Value>
void check(const std::string& key, const std::optional<LinearValue<Value>>& given,
           const Magnitude& magnitude);

// Refuses groups that the mesh lacks.
void check_labels(const BoundaryConditions& conditions, const Mesh& mesh);

// Sets roles, u0, f and rollers of `loads`, which has its point supports. displacement_mm: for
// displacement edges without a value. Refuses supports of a piece without contact edges that leave
// a rigid motion free, and displacements that jump where two displacement edges meet.
void apply(const BoundaryConditions& conditions, const Eigen::Vector2d& displacement_mm,
           const Mesh& mesh, Loads& loads);

}  // namespace airybench
