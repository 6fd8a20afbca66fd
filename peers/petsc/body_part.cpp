#include "peers/petsc/body_part.hpp"

#include <algorithm>
#include <map>

#include "assembly/rough_compliance.hpp"
#include "support/errors.hpp"

namespace airybench {
namespace {

using namespace parallel;

struct BoundaryArrays {
  Eigen::MatrixXi edges, roles, rollers;
  Eigen::MatrixXd u0_mm, traction_MPa, gap_mm, normals, moment_normals, friction;
  explicit BoundaryArrays(const NpzSlices& file)
      : edges(file.read<int>("boundary")),
        roles(file.read<int>("boundary_roles")),
        rollers(file.read<int>("rollers")),
        u0_mm(file.read<double>("u0_mm")),
        traction_MPa(file.read<double>("traction_MPa")),
        gap_mm(file.read<double>("gap_mm")),
        normals(file.read<double>("contact_normals")),
        moment_normals(file.read<double>("contact_moment_normals")),
        friction(file.read<double>("friction")) {
    for (const int role : roles.reshaped())
      if (role < 0 || role > 2)
        throw FileError("problem.npz: boundary_roles: " + std::to_string(role) +
                        " (allowed: 0, 1, 2)");
  }
};

// Data at nodes of boundary edges (0 start, 1 middle, 2 end); loads are evaluated only there.
struct GivenData {
  std::shared_ptr<const BoundaryArrays> arrays;
  std::vector<int> row;                                            // → row of the arrays
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> along;  // start, edge vector

  int node(const Eigen::Vector2d& x, int of) const {
    const auto& [start, edge] = along[of];
    return static_cast<int>(std::lround(2 * (x - start).dot(edge) / edge.squaredNorm()));
  }
  Eigen::Vector2d pair(const Eigen::MatrixXd& array, int of, int k) const {
    return array.row(row[of]).segment<2>(2 * k);
  }
};

Loads loads_of(const std::shared_ptr<const GivenData>& given, const Eigen::Vector2d& body_force) {
  Loads loads;
  loads.body_force_N_per_mm3 = body_force;
  const BoundaryArrays& arrays = *given->arrays;
  if (!arrays.u0_mm.isZero(0))
    loads.displacement_mm = [given](const Eigen::Vector2d& x, int of) {
      return given->pair(given->arrays->u0_mm, of, given->node(x, of));
    };
  if (!arrays.traction_MPa.isZero(0))
    loads.traction_MPa = [given](const Eigen::Vector2d& x, const Eigen::Vector2d&, int of) {
      return given->pair(given->arrays->traction_MPa, of, given->node(x, of) / 2);
    };
  if (!arrays.gap_mm.isZero(0))
    loads.gap_mm = [given](const Eigen::Vector2d& x, int of) {
      return given->arrays->gap_mm(given->row[of], given->node(x, of));
    };
  for (const int row : given->row) loads.rollers.push_back(arrays.rollers(row) != 0);
  return loads;
}

Problem with_boundary(Mesh mesh, MeshEdges edges, std::vector<Eigen::Matrix3d> compliance,
                      const std::shared_ptr<const BoundaryArrays>& arrays, std::vector<int> rows,
                      const Eigen::Vector2d& body_force) {
  Problem problem;
  auto given = std::make_shared<GivenData>();
  given->arrays = arrays;
  given->row = std::move(rows);
  const bool friction = !arrays->friction.isZero(0);
  for (int of = 0; of < static_cast<int>(given->row.size()); ++of) {
    const auto [a, b] = mesh.boundary[of].vertices;
    given->along.emplace_back(mesh.vertices[a], mesh.vertices[b] - mesh.vertices[a]);
    if (friction) problem.friction.push_back(arrays->friction(given->row[of]));
    ContactNormals& normals = problem.contact_normals.emplace_back();
    for (int k = 0; k < 3; ++k) normals.at(k, 2) = given->pair(arrays->normals, of, k);
    for (const int end : {0, 1}) normals.at(end, 1) = normals.at(2 * end, 2);
    for (int k = 0; k < 2; ++k) normals.at(k + 1, 3) = given->pair(arrays->moment_normals, of, k);
  }
  // Friction anywhere on the boundary makes has_friction() true on every rank.
  if (friction && problem.friction.empty()) problem.friction.push_back(0);
  problem.loads = loads_of(given, body_force);
  problem.mesh = std::move(mesh);
  problem.edges = std::move(edges);
  problem.compliance = std::move(compliance);
  return problem;
}

using Ends = std::array<int, 2>;  // low and high vertex

Ends low_first(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

// Local numbers of vertices of the file; −1: not in the part.
std::vector<int> local_vertices(const std::vector<int>& vertices, const Numbering& numbers) {
  std::vector<int> local;
  for (const int vertex : vertices) {
    const auto at = std::ranges::lower_bound(numbers.input, vertex);
    const bool is_there = at != numbers.input.end() && *at == vertex;
    local.push_back(is_there ? static_cast<int>(at - numbers.input.begin()) : -1);
  }
  return local;
}

void take_out_rigid_motion(Problem& boundary, Problem& part) {
  const SplitDisplacement split = split_rigid_motion(boundary);
  boundary.motion = part.motion = split.motion;
  boundary.loads.displacement_mm = split.rest_mm;
  if (!split.rest_mm) {
    part.loads.displacement_mm = {};
  } else {
    part.loads.displacement_mm = [all = part.loads.displacement_mm, motion = split.motion](
                                     const Eigen::Vector2d& at, int row) {
      return Eigen::Vector2d(all(at, row) - motion.at(at));
    };
  }
}

std::vector<ContactEdge> contact_edges(const BodyPart& part) {
  std::map<int, int> first_point;
  for (int p = 0; p < part.contact.count; p += 2) first_point[part.contact.boundary[p]] = p;
  std::vector<ContactEdge> edges;
  for (std::size_t row = 0; row < part.row_of_part.size(); ++row)
    if (const auto at = first_point.find(part.row_of_part[row]); at != first_point.end())
      edges.push_back({part.problem.edges.of_boundary[row], at->second});
  return edges;
}

HybridizedSystem system_of_slots(const Problem& problem) {
  HybridizedSystem system;
  number_unknowns(problem, {}, system.unknown);
  int slot = 0;
  for (int& unknown : system.unknown.entries()) {
    if (unknown != prescribed_unknown) unknown = slot;
    ++slot;
  }
  system.displacement = prescribed_displacements(problem, 1);
  system.b = Eigen::VectorXd::Zero(slot);
  return system;
}

}  // namespace

Eigen::MatrixXd of_whole_boundary(const BodyPart& part, const Eigen::MatrixXd& of_part) {
  Eigen::MatrixXd of_rows = Eigen::MatrixXd::Zero(
      of_part.rows(), static_cast<Eigen::Index>(part.boundary.mesh.boundary.size()));
  for (std::size_t row = 0; row < part.row_of_part.size(); ++row)
    of_rows.col(part.row_of_part[row]) = of_part.col(static_cast<Eigen::Index>(row));
  return sum(of_rows.reshaped()).reshaped(of_rows.rows(), of_rows.cols());
}

BodyPart make_body_part(MeshPart own, const NpzSlices& file) {
  BodyPart part;
  std::shared_ptr<const BoundaryArrays> arrays;
  std::vector<Eigen::Matrix3d> compliance;
  Eigen::Vector2d body_force;
  Mesh whole;
  MeshEdges whole_edges;
  std::vector<int> all_rows, vertices;  // of the boundary
  each_by_itself([&] {
    arrays = std::make_shared<BoundaryArrays>(file);
    body_force = file.read<double>("body_force_N_per_mm3");
    const Eigen::MatrixXd materials = file.read<double>("compliance_per_MPa");
    for (Eigen::Index body = 0; body < materials.rows(); ++body) {
      compliance.emplace_back(materials.row(body).reshaped(3, 3));
      whole.body_names.push_back(std::to_string(body));
    }
    vertices.assign(arrays->edges.data(), arrays->edges.data() + arrays->edges.size());
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    const std::vector<int> local_of_vertex = local_vertices(vertices, own.vertex_numbers);
    part.boundary_vertex.assign(own.mesh.vertices.size(), -1);
    for (std::size_t v = 0; v < vertices.size(); ++v)
      if (local_of_vertex[v] >= 0) part.boundary_vertex[local_of_vertex[v]] = static_cast<int>(v);

    std::map<Ends, int> edge_of;  // edges between vertices of the boundary
    for (int edge = 0; edge < own.edges.count(); ++edge)
      if (const auto [a, b] = own.edges.vertices[edge];
          part.boundary_vertex[a] >= 0 && part.boundary_vertex[b] >= 0)
        edge_of[{a, b}] = edge;
    for (int row = 0; row < static_cast<int>(arrays->edges.rows()); ++row) {
      const auto role = static_cast<BoundaryRole>(arrays->roles(row));
      Ends ends, local;
      for (int k = 0; k < 2; ++k) {
        ends[k] = static_cast<int>(std::ranges::lower_bound(vertices, arrays->edges(row, k)) -
                                   vertices.begin());
        local[k] = local_of_vertex[ends[k]];
      }
      whole.boundary.push_back({ends, role});
      whole_edges.vertices.push_back(low_first(ends[0], ends[1]));
      whole_edges.of_boundary.push_back(row);
      all_rows.push_back(row);
      const auto found = edge_of.find(low_first(local[0], local[1]));
      if (found == edge_of.end()) continue;
      own.mesh.boundary.push_back({local, role});
      own.edges.of_boundary.push_back(found->second);
      part.row_of_part.push_back(row);
    }
    own.mesh.body_names = whole.body_names;
  });
  whole.vertices = places_of({vertices.begin(), vertices.end()}, own.vertex_slice_mm);
  part.problem = with_boundary(std::move(own.mesh), std::move(own.edges), compliance, arrays,
                               part.row_of_part, body_force);
  part.boundary = with_boundary(std::move(whole), std::move(whole_edges), std::move(compliance),
                                arrays, std::move(all_rows), body_force);
  take_out_rigid_motion(part.boundary, part.problem);
  part.vertices = std::move(own.vertex_numbers);
  part.edges = std::move(own.edge_numbers);
  part.contact = contact_points(part.boundary);
  part.contact_edges = contact_edges(part);
  part.compliance = rough_compliance(
      of_whole_boundary(part, compliance_at_boundary(part.problem).transpose()).transpose(),
      part.contact);
  part.system = system_of_slots(part.problem);
  return part;
}

}  // namespace airybench
