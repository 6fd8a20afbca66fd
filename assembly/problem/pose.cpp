#include "assembly/problem/pose.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <sstream>

#include "assembly/elements/edge_forces.hpp"
#include "assembly/problem/bonded_faces.hpp"
#include "assembly/problem/contact_conditions.hpp"
#include "assembly/problem/held_points.hpp"
#include "assembly/problem/load_scale.hpp"
#include "assembly/problem/materials.hpp"
#include "assembly/problem/scene_errors.hpp"
#include "support/lists.hpp"

namespace airybench {
namespace {

// Relative tolerance of a scene's geometry against the mesh.
constexpr double geometry_tolerance = 1e-6;

void check_length(const Scene& scene, const std::string& key, std::optional<double> given,
                  double of_mesh, const Mesh& mesh) {
  if (!given || std::abs(*given - of_mesh) <= geometry_tolerance * of_mesh) return;
  std::ostringstream why;
  why << "contradicts the mesh " << mesh.name << ", which has " << of_mesh;
  fail(scene, key, *given, why.str());
}

struct Face {
  Eigen::Vector2d middle;  // of the segment between the face's ends
  double half_height;      // half that segment's length
  bool is_closed;          // no ends: around a hole, or the whole boundary
  bool is_bent;            // its vertices leave that segment
  bool has_crown;          // on some edge: no wall
};

bool has_wall(const Scene& scene, const std::string& label) {
  const auto own = scene.boundary.find(label);
  return scene.wall || (own != scene.boundary.end() && own->second.contact.wall);
}

std::vector<Face> faces_at_walls(const Scene& scene, const ReachableContact& contact) {
  const Mesh& mesh = contact.mesh;
  std::vector<Face> faces;
  for (const auto& chain : boundary_chains(mesh, BoundaryRole::contact)) {
    if (contact.matched[chain.front()]) continue;
    const auto& start = mesh.vertices[mesh.boundary[chain.front()].vertices[0]];
    const auto& end = mesh.vertices[mesh.boundary[chain.back()].vertices[1]];
    const double height = (end - start).norm();
    const auto is_off = [&](int row) {
      constexpr double straight = 1e-3;
      const auto& at = mesh.vertices[mesh.boundary[row].vertices[1]];
      return std::abs(cross_area(start, end, at)) > straight * height * height;
    };
    const auto has_none = [&](int row) {
      return !has_wall(scene, boundary_label(mesh, mesh.boundary[row]));
    };
    faces.push_back({.middle = (start + end) / 2,
                     .half_height = height / 2,
                     .is_closed = start == end,
                     .is_bent = std::ranges::any_of(chain, is_off),
                     .has_crown = std::ranges::any_of(chain, has_none)});
  }
  return faces;
}

// Half the height of the first tooth at its root: the force boundary's vertices on x = 0 nearest to
// the tooth's axis are the feet of its flanks. 0 when there are none.
double root_half_height(const Mesh& mesh, const Face& face) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const BoundaryEdge& edge : mesh.boundary) {
    if (edge.role != BoundaryRole::force) continue;
    for (const int v : edge.vertices)
      if (std::abs(mesh.vertices[v].x()) <= geometry_tolerance * face.half_height)
        nearest = std::min(nearest, std::abs(mesh.vertices[v].y() - face.middle.y()));
  }
  return std::isfinite(nearest) ? nearest : 0;
}

void check_geometry(const Scene& scene, const Mesh& mesh, const std::vector<Face>& faces) {
  if (scene.teeth && *scene.teeth != static_cast<int>(faces.size()))
    fail(scene, "teeth", *scene.teeth,
         "contradicts the mesh " + mesh.name + ", which has " + std::to_string(faces.size()) +
             " contact face(s)");
  for (const Face& face : faces) {
    if (!scene.crown_radius_mm || !face.has_crown) continue;
    const auto refuse_crown = [&](const std::string& why) {
      fail(scene, "crown_radius_mm", *scene.crown_radius_mm,
           "on the mesh " + mesh.name + ", where a contact face is " + why);
    };
    if (face.is_closed) refuse_crown("closed and has no middle (allowed: null, for no crown)");
    if (face.is_bent) refuse_crown("bent (allowed: straight faces, walls, or null, for no crown)");
  }
  if (faces.empty()) return;
  const Face& face = faces.front();
  check_length(scene, "tip_half_height_mm", scene.tip_half_height_mm, face.half_height, mesh);
  check_length(scene, "length_mm", scene.length_mm, face.middle.x(), mesh);
  check_length(scene, "root_half_height_mm", scene.root_half_height_mm,
               root_half_height(mesh, face), mesh);
}

// Contact must join all pieces.
void check_pieces(const Scene& scene, const ReachableContact& contact) {
  const Mesh& mesh = contact.mesh;
  const MeshPieces pieces = pieces_of(mesh);
  if (pieces.count == 1) return;
  const auto piece_of = [&](std::size_t row) {
    return pieces.of_vertex[mesh.boundary[row].vertices[0]];
  };
  std::vector<bool> joined(static_cast<std::size_t>(pieces.count), false);
  joined[0] = true;
  for (bool grows = true; grows;) {
    grows = false;
    for (std::size_t row = 0; row < mesh.boundary.size(); ++row) {
      if (!contact.matched[row] || !joined[piece_of(row)]) continue;
      auto other = joined[piece_of(static_cast<std::size_t>(contact.matched[row]->opposite))];
      grows |= !other;
      other = true;
    }
  }
  const auto alone = std::ranges::find(joined, false);
  if (alone == joined.end()) return;
  const int piece = static_cast<int>(alone - joined.begin());
  fail(scene, "mesh " + mesh.name,
       std::to_string(pieces.count) + " separate pieces, " +
           place_of_piece(mesh, pieces.of_vertex, piece),
       "presses on no other (allowed: one piece, or pieces that contacts join; in Gmsh, "
       "Coherence or BooleanFragments joins surfaces that touch)");
}

// prefix: of the load step, here and below.
void check_is_held(const Scene& scene, const std::string& prefix, const Mesh& mesh) {
  if (scene.point_supports.empty() &&
      std::ranges::all_of(
          mesh.boundary, [](const BoundaryEdge& edge) { return edge.role == BoundaryRole::force; }))
    fail(scene, prefix + "mesh " + mesh.name, "no displacement and no contact edge",
         "(allowed: one at least, or point_supports where loads balance)");
}

// Pins need force edges (free_motions.hpp).
void check_pins(const Scene& scene, const std::string& prefix, const Problem& problem) {
  const auto& [motions, pins, piece_of_vertex, amounts] = problem.free;
  const auto piece_of = [&](const Pin& pin) {
    return problem.free.piece_of_vertex[problem.mesh.boundary[pin.row].vertices[0]];
  };
  for (const FreeMotion& motion : motions)
    if (std::ranges::count(pins, motion.piece, piece_of) == 0)
      fail(scene, prefix + "mesh " + problem.mesh.name,
           name_of_piece(problem.mesh, piece_of_vertex, motion.piece),
           "needs two force edges, as contact alone holds its motion (allowed: these, or "
           "displacement edges that hold it)");
}

// Displacement methods have one direction at a node: along the roller, and of the contact law.
void check_rollers_at_pairs(const Scene& scene, const std::string& prefix, const Problem& problem) {
  const Mesh& mesh = problem.mesh;
  if (problem.opposite.empty() || problem.loads.rollers.empty()) return;
  constexpr double right_angle = 1e-4;  // cosine, of faces with rounded coordinates
  std::map<int, Eigen::Vector2d> roller;
  for (std::size_t row = 0; row < mesh.boundary.size(); ++row)
    if (problem.loads.rollers[row]) {
      const auto [a, b] = mesh.boundary[row].vertices;
      roller[a] = roller[b] = edge_frame(mesh.vertices[a], mesh.vertices[b]).normal;
    }
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row)
    if (problem.opposite_of(row) != Problem::no_row)
      for (const int end : {0, 1}) {
        const int v = mesh.boundary[row].vertices[end];
        const auto found = roller.find(v);
        if (found != roller.end() &&
            std::abs(found->second.dot(problem.frame_at(row, end, 1).normal)) > right_angle)
          fail(scene, prefix + "contacts", "at the vertex " + shown(mesh.vertices[v]),
               "a roller meets the face obliquely (allowed: at a right angle)");
      }
}

void check_supports(const Scene& scene, const std::string& prefix, const Problem& problem) {
  check_is_held(scene, prefix, problem.mesh);
  check_rollers_at_pairs(scene, prefix, problem);
  check_pins(scene, prefix, problem);
  check_point_supports(scene, prefix, problem);
}

// Squares of forces and energies must be numbers that a double can be.
void check_scale(const Scene& scene, const Problem& problem) {
  const LoadScale scale = load_scale(problem);
  for (const double size : {scale.energy_norm, scale.force_N})
    if (size != 0 && !(size >= 1e-100 && size <= 1e100)) {
      std::ostringstream forces;
      forces << "forces of about " << scale.force_N << " N";
      fail(scene, "loads", forces.str(), "(allowed: none, or 1e-100 to 1e100 N)");
    }
}

void check_every_step(const Scene& scene, Problem& problem) {
  check_supports(scene, "", problem);
  check_scale(scene, problem);
  for (std::size_t k = 0; k < problem.later_steps.size(); ++k) {
    Loads& step = problem.later_steps[k];
    if (same_supports(problem, problem.loads, step)) {
      std::swap(problem.loads, step);
      check_scale(scene, problem);
      std::swap(problem.loads, step);
    } else {
      const Problem of_step = with_loads(problem, step);
      check_supports(scene, key_of_step(k), of_step);
      check_scale(scene, of_step);
    }
  }
}

void change(Scene& scene, const LoadStep& step) {
  if (step.displacement_mm) scene.displacement_mm = *step.displacement_mm;
  if (step.body_force_N_per_mm3) scene.body_force_N_per_mm3 = *step.body_force_N_per_mm3;
  if (step.clearance_mm) scene.clearance_mm = *step.clearance_mm;
  for (const auto& [body, temperature] : step.temperature_K)
    scene.temperature_K[body] = temperature;
  for (const auto& [label, values] : step.boundary) {
    BoundaryValues& own = scene.boundary[label];
    if (values.traction_MPa || values.pressure_MPa || values.displacement_mm) {
      own.traction_MPa = values.traction_MPa;
      own.pressure_MPa = values.pressure_MPa;
      own.displacement_mm = values.displacement_mm;
    }
    if (values.support) own.support = values.support;
    if (values.contact.clearance_mm) own.contact.clearance_mm = values.contact.clearance_mm;
  }
  for (const ContactPair& pair : step.contacts)
    std::ranges::find(scene.contacts, pair.between, &ContactPair::between)->clearance_mm =
        pair.clearance_mm;
}

bool changes_gap(const LoadStep& step) {
  return step.clearance_mm || !step.contacts.empty() ||
         std::ranges::any_of(step.boundary, [](const auto& group) {
           return group.second.contact.clearance_mm.has_value();
         });
}

template <typename Value>
void scale(std::optional<LinearValue<Value>>& value, double part) {
  if (value)
    for (Value& at : value->values) at *= part;
}

Scene part_of(Scene scene, double part) {
  scene.displacement_mm *= part;
  scene.body_force_N_per_mm3 *= part;
  for (PointSupport& point : scene.point_supports)
    for (std::optional<double>& displacement : point.displacement_mm)
      if (displacement) *displacement *= part;
  for (auto& [body, temperature] : scene.temperature_K)
    for (double& at : temperature.values) at *= part;
  for (auto& [label, values] : scene.boundary) {
    scale(values.traction_MPa, part);
    scale(values.pressure_MPa, part);
    scale(values.displacement_mm, part);
  }
  return scene;
}

Loads loads_of(const Scene& scene, const std::string& prefix, const Mesh& mesh,
               const ContactGap& gap) {
  Loads loads;
  loads.points = scene.point_supports;
  of_scene(scene, prefix + "boundary",
           [&] { apply(scene.boundary, scene.displacement_mm, mesh, loads); });
  loads.body_force_N_per_mm3 = scene.body_force_N_per_mm3;
  loads.thermal = thermal_strains(scene, prefix, mesh);
  loads.gap_mm = gap.gap_mm;
  loads.wall_detail = gap.detail;
  return loads;
}

std::vector<Loads> loads_of_steps(const Scene& scene, const ReachableContact& contact) {
  std::vector<Loads> steps;
  const Mesh& mesh = contact.mesh;
  ContactGap gap = contact_gap(contact, scene);
  for (int k = 1; k < scene.equal_steps; ++k)
    steps.push_back(
        loads_of(part_of(scene, static_cast<double>(k) / scene.equal_steps), "", mesh, gap));
  steps.push_back(loads_of(scene, "", mesh, gap));
  Scene at = scene;
  for (std::size_t k = 0; k < scene.later_steps.size(); ++k) {
    change(at, scene.later_steps[k]);
    if (changes_gap(scene.later_steps[k])) gap = contact_gap(contact, at);
    steps.push_back(loads_of(at, key_of_step(k), mesh, gap));
  }
  return steps;
}

// Before contact edges that meet nothing leave their groups.
void check_groups(const Scene& scene, const Mesh& mesh) {
  of_scene(scene, "boundary", [&] { check_labels(scene.boundary, mesh); });
  for (std::size_t k = 0; k < scene.later_steps.size(); ++k)
    of_scene(scene, key_of_step(k) + "boundary",
             [&] { check_labels(scene.later_steps[k].boundary, mesh); });
}

// After the groups of contacts: a group that is misspelt there has no partner.
void check_faces(const Scene& scene) {
  for (const auto& [label, values] : scene.boundary)
    if (values.contact.face && !values.contact.wall && !scene.wall && !is_paired(scene, label))
      fail(scene, "boundary: " + label, "face", "without a wall (allowed: with one)");
}

// Where every contact group presses on another, there is no wall that these keys could place.
void check_keys_of_walls(const Scene& scene, const Mesh& mesh) {
  const auto is_at_wall = [&](const BoundaryEdge& edge) {
    return edge.role == BoundaryRole::contact && !is_paired(scene, boundary_label(mesh, edge));
  };
  if (scene.contacts.empty() || std::ranges::any_of(mesh.boundary, is_at_wall)) return;
  constexpr const char* why = "where all contact groups are in contacts (allowed: in these)";
  if (scene.clearance_mm != 0) fail(scene, "clearance_mm", scene.clearance_mm, why);
  if (scene.wall) fail(scene, "wall", "given", why);
  if (scene.face) fail(scene, "face", "given", why);
  for (std::size_t k = 0; k < scene.later_steps.size(); ++k)
    if (const auto& clearance_mm = scene.later_steps[k].clearance_mm)
      fail(scene, key_of_step(k) + "clearance_mm", *clearance_mm, why);
}

ReachableContact contact_of(const Scene& scene, Mesh mesh) {
  mesh = of_scene(scene, "mesh", [&] { return transformed(std::move(mesh), scene.mesh); });
  mesh = of_scene(scene, "layers", [&] { return layered(std::move(mesh), scene.layers); });
  check_groups(scene, mesh);
  check_keys_of_walls(scene, mesh);
  MatchedFaces faces = of_scene(scene, "", [&] {
    return with_matched_faces(with_bonded_faces(std::move(mesh), scene), scene);
  });
  check_faces(scene);
  return of_scene(scene, "boundary",
                  [&] { return with_reachable_contact(std::move(faces), scene); });
}

}  // namespace

Problem pose(const Scene& scene, Mesh given_mesh) {
  check_values(scene);
  ReachableContact contact = contact_of(scene, std::move(given_mesh));
  Mesh& mesh = contact.mesh;
  check_geometry(scene, mesh, faces_at_walls(scene, contact));
  check_pieces(scene, contact);
  check_is_held(scene, "", mesh);
  check_point_supports(scene, mesh);

  std::vector<Loads> steps = loads_of_steps(scene, contact);
  std::vector<Eigen::Matrix3d> by_body;
  std::vector<double> poisson_zz;
  for (const Material& material : materials(scene, mesh)) {
    by_body.push_back(compliance(material, scene.plane));
    poisson_zz.push_back(scene.plane == Plane::strain ? material.poisson : 0);
  }
  const std::vector<double> friction = contact_friction(contact, scene);
  std::vector<ContactNormals> normals = contact_normals(contact, scene),
                              on_curves = curve_normals(contact, scene);
  std::vector<int> opposite = opposite_edges(contact);
  Problem problem =
      make_problem(std::move(mesh), std::move(by_body), std::move(steps.front()), friction);
  problem.poisson_zz = std::move(poisson_zz);
  problem.contact_normals = std::move(normals);
  problem.curve_normals = std::move(on_curves);
  problem.opposite = std::move(opposite);
  problem.matching = contact.changes;
  find_round_sides(problem);
  problem.later_steps.assign(std::make_move_iterator(steps.begin() + 1),
                             std::make_move_iterator(steps.end()));
  check_every_step(scene, problem);
  return problem;
}

}  // namespace airybench
