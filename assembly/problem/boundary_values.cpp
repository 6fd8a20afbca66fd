#include "assembly/problem/boundary_values.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "assembly/elements/edge_forces.hpp"
#include "mesh/transform_error.hpp"
#include "support/lists.hpp"

namespace airybench {
namespace {

bool is_zero(double value) { return value == 0; }
bool is_zero(const Eigen::Vector2d& value) { return value.isZero(0); }

template <typename Value>
bool acts(const std::optional<LinearValue<Value>>& given) {
  return given && !(is_zero(given->values[0]) && is_zero(given->values[1]));
}

bool is_loaded(const BoundaryValues& given) { return given.traction_MPa || given.pressure_MPa; }

// In a load step held and loaded edges may change places.
void check_role(const std::string& label, BoundaryRole role, const BoundaryValues& given,
                bool in_step) {
  if (in_step && role != BoundaryRole::contact) {
    if (given.displacement_mm && is_loaded(given))
      throw TransformError(label + ": displacement_mm and " +
                           (given.traction_MPa ? "traction_MPa" : "pressure_MPa") +
                           " (allowed: either, to hold the group or to load it)");
    if (given.support && !given.displacement_mm)
      throw TransformError(label + ": support (allowed: with displacement_mm)");
    if (given.displacement_mm) role = BoundaryRole::displacement;
    if (is_loaded(given)) role = BoundaryRole::force;
  }
  const auto only = [&](BoundaryRole of, const char* key, bool is_given) {
    if (!is_given || role == of) return;
    const std::string_view name = boundary_role_names[static_cast<std::size_t>(of)];
    throw TransformError(label + ": " + key + " (allowed: on a " + std::string(name) +
                         " boundary)");
  };
  only(BoundaryRole::force, "traction_MPa", given.traction_MPa.has_value());
  only(BoundaryRole::force, "pressure_MPa", given.pressure_MPa.has_value());
  only(BoundaryRole::displacement, "displacement_mm", given.displacement_mm.has_value());
  only(BoundaryRole::displacement, "support", given.support.has_value());
  only(BoundaryRole::contact, "friction", given.contact.friction.has_value());
  only(BoundaryRole::contact, "clearance_mm", given.contact.clearance_mm.has_value());
  only(BoundaryRole::contact, "wall", given.contact.wall.has_value());
  only(BoundaryRole::contact, "face", given.contact.face.has_value());
  if (given.traction_MPa && given.pressure_MPa)
    throw TransformError(label + ": traction_MPa and pressure_MPa (allowed: one of them)");
}

void check(const std::string& label, const ContactValues& given) {
  if (given.friction && !(*given.friction >= 0 && *given.friction <= max_friction))
    refuse(label + ": friction", *given.friction, "(allowed: 0 to 1e6)");
  if (given.clearance_mm &&
      !(*given.clearance_mm >= 0 && length_magnitude.has(*given.clearance_mm)))
    refuse(label + ": clearance_mm", *given.clearance_mm, "(allowed: 0 to 1e15 mm)");
  check_curve(label + ": wall", given.wall);
  check_curve(label + ": face", given.face);
}

// Refuses rollers of a piece that are all parallel, as an edge holds the rotation and one
// translation only, where no contact edge may hold it. pose() refuses pieces without any support.
void check_held(const PieceSupport& support) {
  if (!support.is_free || support.in_contact || support.has_points || !support.along) return;
  Eigen::Vector2d along = *support.along;
  if (along.x() < -straight_roller || (along.x() < straight_roller && along.y() < 0)) along *= -1;
  const auto tidy = [](double x) { return std::abs(x) < straight_roller ? 0 : x; };
  throw TransformError("support: normal leaves the body free to move along " +
                       shown(Eigen::Vector2d(along.unaryExpr(tidy))) +
                       " (allowed: supports that hold it, or contact edges)");
}

// u0 may not jump where displacement edges meet: no field has such a jump and finite energy.
// Rollers prescribe u_n alone, and rollers that are not parallel, of curves at the vertex, agree
// with any values.
void check_agreement(const Mesh& mesh, const std::vector<std::string>& labels,
                     const std::vector<BoundaryValues>& of_row) {
  constexpr double rounding = 1e-9;
  std::map<int, std::size_t> row_at;  // vertex -> the first displacement edge there
  for (std::size_t row = 0; row < mesh.boundary.size(); ++row) {
    if (mesh.boundary[row].role != BoundaryRole::displacement) continue;
    for (const int vertex : mesh.boundary[row].vertices) {
      const auto [first, is_first] = row_at.emplace(vertex, row);
      if (is_first) continue;
      const std::array rows = {first->second, row};
      std::array<Eigen::Vector2d, 2> u, rolls_along;  // zero: held in both directions
      for (const std::size_t k : {0U, 1U}) {
        const BoundaryValues& own = of_row[rows[k]];
        const auto [a, b] = mesh.boundary[rows[k]].vertices;
        u[k] = own.displacement_mm->at(mesh.vertices[vertex]);
        const EdgeCurve& curve = mesh.boundary[rows[k]].curve;
        rolls_along[k] = own.support != BoundaryValues::Support::normal ? Eigen::Vector2d(0, 0)
                         : curve.is_straight() || mesh.is_polygon
                             ? edge_frame(mesh.vertices[a], mesh.vertices[b]).tangent
                             : Eigen::Vector2d(curve.derivative(vertex == a ? 0 : 1).normalized());
      }
      Eigen::Vector2d jump = u[1] - u[0];
      const bool both_roll = !rolls_along[0].isZero(0) && !rolls_along[1].isZero(0);
      if (both_roll && std::abs(cross(rolls_along[0], rolls_along[1])) >= straight_roller) continue;
      const Eigen::Vector2d& free = rolls_along[0].isZero(0) ? rolls_along[1] : rolls_along[0];
      jump -= jump.dot(free) * free;
      if (jump.norm() <= rounding * std::max(u[0].norm(), u[1].norm())) continue;
      throw TransformError(labels[rows[0]] + " and " + labels[rows[1]] +
                           ": displacement_mm: " + shown(u[0]) + " and " + shown(u[1]) +
                           " at their common vertex " + shown(mesh.vertices[vertex]) +
                           " (allowed: equal, of rollers along their normal)");
    }
  }
}

}  // namespace

template <typename Value>
void check(const std::string& key, const std::optional<LinearValue<Value>>& given,
           const Magnitude& magnitude) {
  if (!given) return;
  for (const Value& value : given->values)
    if (!magnitude.has(value)) refuse(key, shown(value), magnitude.allowed);
  for (const Eigen::Vector2d& point : given->at_mm)
    if (!length_magnitude.has(point))
      refuse(key + ": at_mm", shown(point), length_magnitude.allowed);
  if ((given->at_mm[1] - given->at_mm[0]).squaredNorm() == 0)
    refuse(key + ": at_mm", shown(given->at_mm[0]), "twice (allowed: two different points)");
}

template void check(const std::string&, const std::optional<LinearValue<double>>&,
                    const Magnitude&);

static void check_values(const BoundaryConditions& conditions, bool in_step) {
  for (const auto& [label, given] : conditions) {
    check(label + ": traction_MPa", given.traction_MPa, stress_magnitude);
    check(label + ": pressure_MPa", given.pressure_MPa, stress_magnitude);
    check(label + ": displacement_mm", given.displacement_mm, length_magnitude);
    check(label, given.contact);
    // check_labels() refuses other labels: they name no group of a mesh.
    if (const auto known = parse_boundary_label(label))
      check_role(label, known->role, given, in_step);
  }
}

void check_values(const BoundaryConditions& conditions) { check_values(conditions, false); }
void check_values_of_step(const BoundaryConditions& conditions) { check_values(conditions, true); }

BoundaryRole role_under(BoundaryRole of_mesh, const BoundaryValues& given) {
  if (of_mesh == BoundaryRole::displacement && is_loaded(given)) return BoundaryRole::force;
  if (of_mesh == BoundaryRole::force && given.displacement_mm) return BoundaryRole::displacement;
  return of_mesh;
}

std::vector<BoundaryRole> roles_under(const BoundaryConditions& conditions, const Mesh& mesh) {
  std::vector<BoundaryRole> roles;
  bool differ = false;
  for (const BoundaryEdge& edge : mesh.boundary) {
    const auto given = conditions.find(boundary_label(mesh, edge));
    roles.push_back(given == conditions.end() ? edge.role : role_under(edge.role, given->second));
    differ |= roles.back() != edge.role;
  }
  if (!differ) roles.clear();
  return roles;
}

void check_labels(const BoundaryConditions& conditions, const Mesh& mesh) {
  std::set<std::string> labels;
  for (const BoundaryEdge& edge : mesh.boundary) labels.insert(boundary_label(mesh, edge));
  for (const auto& [label, values] : conditions)
    if (!labels.contains(label))
      throw TransformError(label + ": no such group in the mesh " + mesh.name +
                           perhaps(label, {labels.begin(), labels.end()}) +
                           " (its groups: " + joined(labels) + ")");
}

void apply(const BoundaryConditions& conditions, const Eigen::Vector2d& displacement_mm,
           const Mesh& given_mesh, Loads& loads) {
  std::vector<std::string> labels;
  for (const BoundaryEdge& edge : given_mesh.boundary)
    labels.push_back(boundary_label(given_mesh, edge));
  loads.roles = roles_under(conditions, given_mesh);
  const Mesh changed = loads.roles.empty() ? Mesh() : with_roles(given_mesh, loads.roles);
  const Mesh& mesh = loads.roles.empty() ? given_mesh : changed;
  auto of_row = std::make_shared<std::vector<BoundaryValues>>(mesh.boundary.size());
  const LinearValue<Eigen::Vector2d> everywhere{{displacement_mm, displacement_mm}};
  bool moved = false, pulled = false, rolling = false;
  std::vector<bool> rollers(mesh.boundary.size(), false);
  for (std::size_t row = 0; row < mesh.boundary.size(); ++row) {
    BoundaryValues& own = (*of_row)[row];
    const auto given = conditions.find(labels[row]);
    if (given != conditions.end()) {  // without its walls, which may be long
      const BoundaryValues& of_group = given->second;
      own.support = of_group.support;
      own.displacement_mm = of_group.displacement_mm;
      own.traction_MPa = of_group.traction_MPa;
      own.pressure_MPa = of_group.pressure_MPa;
    }
    const bool is_held = mesh.boundary[row].role == BoundaryRole::displacement;
    if (is_held && !own.displacement_mm) own.displacement_mm = everywhere;
    moved |= acts(own.displacement_mm);
    pulled |= acts(own.traction_MPa) || acts(own.pressure_MPa);
    rollers[row] = is_held && own.support == BoundaryValues::Support::normal;
    rolling |= rollers[row];
  }
  check_agreement(mesh, labels, *of_row);
  if (moved)
    loads.displacement_mm = [of_row](const Eigen::Vector2d& x, int row) {
      return (*of_row)[static_cast<std::size_t>(row)].displacement_mm->at(x);
    };
  if (pulled)
    loads.traction_MPa = [of_row](const Eigen::Vector2d& x, const Eigen::Vector2d& normal,
                                  int row) -> Eigen::Vector2d {
      const BoundaryValues& own = (*of_row)[static_cast<std::size_t>(row)];
      if (own.traction_MPa) return own.traction_MPa->at(x);
      if (own.pressure_MPa) return -own.pressure_MPa->at(x) * normal;
      return Eigen::Vector2d::Zero();
    };
  if (!rolling) return;
  for (const PieceSupport& support : supports_of(mesh, rollers, loads.points, pieces_of(mesh)))
    check_held(support);
  loads.rollers = std::move(rollers);
}

}  // namespace airybench
