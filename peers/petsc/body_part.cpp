#include "peers/petsc/body_part.hpp"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "assembly/rough_compliance.hpp"
#include "support/errors.hpp"

namespace airybench {
namespace {

using namespace parallel;

// The boundary's arrays, a row per edge of it.
struct BoundaryArrays {
  Eigen::MatrixXi edges, roles, rollers;
  Eigen::MatrixXd u0_mm, traction_MPa, gap_mm, normals, moment_normals, friction;
  explicit BoundaryArrays(NpzSlices& file)
      : edges(file.integers("boundary")),
        roles(file.integers("boundary_roles")),
        rollers(file.integers("rollers")),
        u0_mm(file.numbers("u0_mm")),
        traction_MPa(file.numbers("traction_MPa")),
        gap_mm(file.numbers("gap_mm")),
        normals(file.numbers("contact_normals")),
        moment_normals(file.numbers("contact_moment_normals")),
        friction(file.numbers("friction")) {}
};

// Of a point on an edge: 0 at its start, 1 at its end.
struct AlongEdge {
  Eigen::Vector2d start, edge;
  double operator()(const Eigen::Vector2d& x) const {
    return (x - start).dot(edge) / edge.squaredNorm();
  }
};

// The quadratic with these values at 0, 1/2 and 1; at these three places they themselves.
template <typename Value>
Value quadratic(double s, const Value& start, const Value& middle, const Value& end) {
  return Value(start * ((1 - s) * (1 - 2 * s)) + middle * (4 * s * (1 - s)) +
               end * (s * (2 * s - 1)));
}

// Loads on the rows of a boundary; arrays and places are shared by all functions.
struct GivenData {
  std::shared_ptr<const BoundaryArrays> arrays;
  std::vector<int> row;  // of the boundary at hand → row of the arrays
  std::vector<AlongEdge> along;

  double place(const Eigen::Vector2d& x, int of) const {
    return std::round(2 * along[of](x)) / 2;  // asked for at the nodes only
  }
};

Loads loads_of(const std::shared_ptr<const GivenData>& given, const Eigen::Vector2d& body_force) {
  Loads loads;
  loads.body_force_N_per_mm3 = body_force;
  const BoundaryArrays& arrays = *given->arrays;
  if (!arrays.u0_mm.isZero(0))
    loads.displacement_mm = [given](const Eigen::Vector2d& x, int of) {
      const Eigen::RowVectorXd u = given->arrays->u0_mm.row(given->row[of]);
      return Eigen::Vector2d(quadratic<Eigen::RowVector2d>(given->place(x, of), u.segment<2>(0),
                                                           u.segment<2>(2), u.segment<2>(4)));
    };
  if (!arrays.traction_MPa.isZero(0))
    loads.traction_MPa = [given](const Eigen::Vector2d& x, const Eigen::Vector2d&, int of) {
      const Eigen::RowVectorXd f = given->arrays->traction_MPa.row(given->row[of]);
      return Eigen::Vector2d(given->place(x, of) < 0.5 ? f.segment<2>(0) : f.segment<2>(2));
    };
  if (!arrays.gap_mm.isZero(0))
    loads.gap_mm = [given](const Eigen::Vector2d& x, int of) {
      const Eigen::RowVectorXd gap = given->arrays->gap_mm.row(given->row[of]);
      return quadratic<double>(given->place(x, of), gap(0), gap(1), gap(2));
    };
  for (const int row : given->row) loads.rollers.push_back(arrays.rollers(row) != 0);
  return loads;
}

// What the boundary says, for these of its rows, on a mesh that has their vertices.
Problem with_boundary(Mesh mesh, std::vector<Eigen::Matrix3d> compliance,
                      const std::shared_ptr<const BoundaryArrays>& arrays, std::vector<int> rows,
                      const Eigen::Vector2d& body_force) {
  Problem problem;
  auto given = std::make_shared<GivenData>();
  given->arrays = arrays;
  const bool friction = !arrays->friction.isZero(0);
  for (std::size_t of = 0; of < rows.size(); ++of) {
    const int row = rows[of];
    const auto [a, b] = mesh.boundary[of].vertices;
    given->along.push_back({mesh.vertices[a], mesh.vertices[b] - mesh.vertices[a]});
    if (friction) problem.friction.push_back(arrays->friction(row));
    ContactNormals normals;
    for (int k = 0; k < 3; ++k) normals.at_node[k] = arrays->normals.row(row).segment<2>(2 * k);
    for (int k = 0; k < 2; ++k)
      normals.at_moment[k] = arrays->moment_normals.row(row).segment<2>(2 * k);
    problem.contact_normals.push_back(normals);
  }
  // Whether there is friction at all is asked of the whole boundary.
  if (friction && problem.friction.empty()) problem.friction.push_back(0);
  given->row = std::move(rows);
  problem.loads = loads_of(given, body_force);
  problem.mesh = std::move(mesh);
  problem.compliance = std::move(compliance);
  return problem;
}

BoundaryRole role_at(const BoundaryArrays& arrays, Eigen::Index row) {
  const int role = arrays.roles(row);
  if (role < 0 || role > 2)
    throw FileError("problem.npz: boundary_roles: " + std::to_string(role) + " (allowed: 0, 1, 2)");
  return static_cast<BoundaryRole>(role);
}

using Ends = std::array<int, 2>;  // low and high vertex of the file

// Row of the boundary that every edge of the part is, if any.
std::map<Ends, int> rows_by_ends(const BoundaryArrays& arrays) {
  std::map<Ends, int> rows;
  for (int row = 0; row < static_cast<int>(arrays.edges.rows()); ++row) {
    const auto [low, high] = std::minmax(arrays.edges(row, 0), arrays.edges(row, 1));
    rows[{low, high}] = row;
  }
  return rows;
}

void number_local_edges(const MeshPart& mesh, MeshEdges& edges) {
  edges.of_triangle = mesh.edges_of_triangle;
  edges.vertices.resize(mesh.edges.input.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
      edges.vertices[mesh.edges_of_triangle[t][k]] = {low, high};
    }
}

// The boundary's vertices, from whoever has them.
std::vector<Eigen::Vector2d> places_of(const std::vector<int>& vertices, const MeshPart& mesh) {
  Eigen::VectorXd places = Eigen::VectorXd::Zero(2 * static_cast<Eigen::Index>(vertices.size()));
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const auto at = std::ranges::lower_bound(mesh.vertices.input, vertices[k]);
    if (at == mesh.vertices.input.end() || *at != vertices[k]) continue;
    const auto local = static_cast<int>(at - mesh.vertices.input.begin());
    if (mesh.vertices.is_owned(local))
      places.segment<2>(2 * static_cast<Eigen::Index>(k)) = mesh.vertices_mm[local];
  }
  places = sum(places);
  std::vector<Eigen::Vector2d> result(vertices.size());
  for (std::size_t k = 0; k < vertices.size(); ++k)
    result[k] = places.segment<2>(2 * static_cast<Eigen::Index>(k));
  return result;
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

// From the part that has the point's edge.
Eigen::VectorXd compliance_of(const BodyPart& part) {
  const Eigen::VectorXd own = compliance_at_boundary(part.problem);
  Eigen::VectorXd of_row =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(part.boundary.mesh.boundary.size()));
  for (std::size_t row = 0; row < part.row_of_part.size(); ++row)
    of_row(part.row_of_part[row]) = own(static_cast<Eigen::Index>(row));
  return rough_compliance(sum(of_row), part.contact);
}

}  // namespace

BodyPart make_body_part(MeshPart mesh, NpzSlices& file) {
  BodyPart part;
  std::shared_ptr<const BoundaryArrays> arrays;
  std::vector<Eigen::Matrix3d> compliance;
  Eigen::Vector2d body_force;
  Mesh whole, local;
  std::vector<int> all_rows, vertices;
  each_by_itself([&] {
    arrays = std::make_shared<BoundaryArrays>(file);
    const Eigen::MatrixXd C = file.numbers("compliance_per_MPa");
    for (Eigen::Index body = 0; body < C.rows(); ++body) {
      compliance.emplace_back(C.row(body).reshaped(3, 3));
      whole.body_names.push_back(std::to_string(body));
    }
    body_force = file.numbers("body_force_N_per_mm3");
    vertices.assign(arrays->edges.data(), arrays->edges.data() + arrays->edges.size());
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (Eigen::Index row = 0; row < arrays->edges.rows(); ++row) {
      Ends ends;
      for (int k = 0; k < 2; ++k)
        ends[k] = static_cast<int>(std::ranges::lower_bound(vertices, arrays->edges(row, k)) -
                                   vertices.begin());
      whole.boundary.push_back({ends, role_at(*arrays, row)});
      all_rows.push_back(static_cast<int>(row));
    }
    local.body_names = whole.body_names;
    local.triangle_body = mesh.body;
    local.triangles = mesh.triangles;
    local.vertices = mesh.vertices_mm;
    MeshEdges& edges = part.problem.edges;
    number_local_edges(mesh, edges);
    const std::map<Ends, int> row_of = rows_by_ends(*arrays);
    for (int edge = 0; edge < edges.count(); ++edge) {
      const auto [a, b] = edges.vertices[edge];
      const auto found = row_of.find({mesh.vertices.input[a], mesh.vertices.input[b]});
      if (found == row_of.end()) continue;
      const int row = found->second;
      const bool low_first = arrays->edges(row, 0) < arrays->edges(row, 1);
      local.boundary.push_back({low_first ? Ends{a, b} : Ends{b, a}, role_at(*arrays, row)});
      edges.of_boundary.push_back(edge);
      part.row_of_part.push_back(row);
    }
    part.boundary_vertex.assign(mesh.vertices.input.size(), -1);
    for (std::size_t v = 0; v < mesh.vertices.input.size(); ++v)
      if (const auto at = std::ranges::lower_bound(vertices, mesh.vertices.input[v]);
          at != vertices.end() && *at == mesh.vertices.input[v])
        part.boundary_vertex[v] = static_cast<int>(at - vertices.begin());
  });
  whole.vertices = places_of(vertices, mesh);
  MeshEdges edges = std::move(part.problem.edges);
  part.problem = with_boundary(std::move(local), compliance, arrays, part.row_of_part, body_force);
  part.problem.edges = std::move(edges);
  part.boundary =
      with_boundary(std::move(whole), std::move(compliance), arrays, all_rows, body_force);
  take_out_rigid_motion(part.boundary, part.problem);
  part.mesh = std::move(mesh);
  part.contact = contact_points(part.boundary);
  part.compliance = compliance_of(part);
  return part;
}

}  // namespace airybench
