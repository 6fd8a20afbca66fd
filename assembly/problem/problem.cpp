#include "assembly/problem/problem.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>

#include "assembly/elements/edge_forces.hpp"

namespace airybench {
namespace {

void take_out_rigid_motion(Problem& problem) {
  SplitDisplacement split = split_rigid_motion(problem);
  problem.motion = split.motion;
  problem.loads.displacement_mm = std::move(split.rest_mm);
}

std::vector<int> central_vertices(const Problem& problem, const MeshPieces& pieces) {
  const auto count = static_cast<std::size_t>(pieces.count);
  std::vector<Eigen::Vector2d> moment(count, Eigen::Vector2d::Zero());
  std::vector<double> area(count, 0), nearest(count, std::numeric_limits<double>::infinity());
  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t) {
    const int piece = pieces.of_vertex[problem.mesh.triangles[t][0]];
    area[piece] += problem.area_mm2(t);
    moment[piece] += problem.area_mm2(t) * problem.vertices_of(t).rowwise().mean();
  }
  std::vector<int> central(count, 0);
  for (int v = 0; v < static_cast<int>(problem.mesh.vertices.size()); ++v) {
    const int piece = pieces.of_vertex[v];
    const double distance = (problem.mesh.vertices[v] - moment[piece] / area[piece]).squaredNorm();
    if (distance < nearest[piece]) {
      nearest[piece] = distance;
      central[piece] = v;
    }
  }
  return central;
}

bool has_law_normals(const Problem& problem, int row) {
  return !problem.curve_normals.empty() && problem.curve_normals[row].is_given();
}

bool may_follow_curve(const Problem& problem, int row) {
  const BoundaryEdge& edge = problem.mesh.boundary[row];
  if (edge.curve.is_straight()) return false;
  const bool has_frame = edge.role == BoundaryRole::contact || problem.is_roller(row);
  return !has_frame || has_law_normals(problem, row);
}

// Per piece: whether its displacement edges hold it where rollers are as round as their curves. On
// one circle it could turn about the centre, against which only the corners of chords hold it.
std::vector<bool> held_by_curves(const Problem& problem, const MeshPieces& pieces) {
  constexpr double least = 1e-6;  // eigenvalue of Σ rᵀr, r: along a support of (1, 0), (0, 1), Jx
  const Mesh& mesh = problem.mesh;
  const Eigen::Vector2d centre = mesh.vertices.front();
  double size = 0;
  for (const Eigen::Vector2d& x : mesh.vertices) size = std::max(size, (x - centre).norm());
  std::vector<Eigen::Matrix3d> sum(static_cast<std::size_t>(pieces.count), Eigen::Matrix3d::Zero());
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row) {
    const BoundaryEdge& edge = mesh.boundary[row];
    if (edge.role != BoundaryRole::displacement) continue;
    const EdgeFrame chord =
        edge_frame(mesh.vertices[edge.vertices[0]], mesh.vertices[edge.vertices[1]]);
    Eigen::Matrix3d& of_piece = sum[pieces.of_vertex[edge.vertices[0]]];
    for (const double s : {0., 0.5, 1.}) {
      const Eigen::Vector2d d = (point_on(mesh, edge, s) - centre) / size,
                            n = edge.curve.is_straight() ? chord.normal : edge.curve.normal(s);
      const auto hold = [&](const Eigen::Vector2d& along) {
        const Eigen::Vector3d r(along.x(), along.y(), d.x() * along.y() - d.y() * along.x());
        of_piece += r * r.transpose();
      };
      hold(n);
      if (!problem.is_roller(row)) hold({-n.y(), n.x()});
    }
  }
  std::vector<bool> held;
  for (const Eigen::Matrix3d& of_piece : sum) {
    const Eigen::Vector3d values =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(of_piece, Eigen::EigenvaluesOnly)
            .eigenvalues();
    held.push_back(values(0) > least * values(2));
  }
  return held;
}

void add_roller_normals(Problem& problem) {
  const std::vector<BoundaryEdge>& boundary = problem.mesh.boundary;
  const auto is_round = [&](int row) {
    return problem.is_roller(row) && !boundary[row].curve.is_straight();
  };
  std::vector<int> rows(boundary.size());
  std::iota(rows.begin(), rows.end(), 0);
  if (std::ranges::none_of(rows, is_round)) return;
  const MeshPieces pieces = pieces_of(problem.mesh);
  const std::vector<bool> held = held_by_curves(problem, pieces);
  problem.curve_normals.resize(boundary.size());
  for (const int row : rows)
    if (is_round(row) && held[pieces.of_vertex[boundary[row].vertices[0]]])
      problem.curve_normals[row] =
          ContactNormals::along([&](double xi) { return boundary[row].curve.normal(xi); });
}

// Empty without friction.
std::vector<double> friction_on_contact(const Mesh& mesh, std::vector<double> friction) {
  for (std::size_t row = 0; row < friction.size(); ++row)
    if (mesh.boundary[row].role != BoundaryRole::contact) friction[row] = 0;
  if (std::ranges::all_of(friction, [](double mu) { return mu == 0; })) friction.clear();
  return friction;
}

}  // namespace

TriangleVertices Problem::vertices_of(int triangle) const {
  const auto& [a, b, c] = mesh.triangles[triangle];
  TriangleVertices v;
  v << mesh.vertices[a], mesh.vertices[b], mesh.vertices[c];
  return v;
}

EdgeSigns Problem::edge_signs(int triangle) const {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return {a < b ? 1. : -1., b < c ? 1. : -1., c < a ? 1. : -1.};
}

ContactOffset Problem::offset_at(const Eigen::Vector2d& x, int boundary_row) const {
  ContactOffset offset{.motion_mm = motion_at(x, mesh.boundary[boundary_row].vertices[0])};
  if (loads.gap_mm) offset.gap_mm = loads.gap_mm(x, boundary_row);
  return offset;
}

std::optional<CurvedSides> Problem::curves_of(int triangle, int degree) const {
  if (degree < 2) return {};
  const auto found = std::ranges::lower_bound(round, triangle, {}, &RoundTriangle::triangle);
  if (found == round.end() || found->triangle != triangle) return {};
  CurvedSides curves;
  for (std::size_t side = 0; side < 3; ++side)
    if (const int row = found->rows[side]; row != no_row) curves[side] = curve_of(row, degree);
  return curves;
}

static_assert(SideCurve::max_parts >= std::max(EdgeCurve::max_degree, ContactNormals::max_parts));
SideCurve Problem::curve_of(int boundary_row, int degree) const {
  const BoundaryEdge& edge = mesh.boundary[boundary_row];
  SideCurve curve{edge.curve.points_mm, {}, {}};
  if (has_law_normals(*this, boundary_row)) {
    const ContactNormals& normals = curve_normals[boundary_row];
    curve.law_normals = normals.all(ContactNormals::max_parts);
    if (degree <= highest_stress_degree)  // displacements of one more have no moments
      curve.moment_normals =
          normals.all(degree + 2).subspan(1, static_cast<std::size_t>(degree) + 1);
  }
  return curve;
}

bool Problem::follows_curve(int boundary_row, int degree) const {
  return degree >= 2 && std::ranges::binary_search(round_rows, boundary_row);
}

bool Problem::contact_turns() const {
  for (std::size_t row = 0; row < contact_normals.size(); ++row)
    if (mesh.boundary[row].role == BoundaryRole::contact &&
        contact_normals[row].at(0, 2) != contact_normals[row].at(2, 2))
      return true;
  return false;
}

EdgeCondition Problem::condition(int boundary_row) const {
  using enum Known;
  switch (mesh.boundary[boundary_row].role) {
    case BoundaryRole::displacement:
      return is_roller(boundary_row) ? EdgeCondition{true, {displacement, force}}
                                     : EdgeCondition{false, {displacement, displacement}};
    case BoundaryRole::contact:
      return {true, {contact_law, has_friction() ? contact_law : force}};
    case BoundaryRole::force:
      break;
  }
  return {false, {force, force}};
}

EdgeMoments Problem::prescribed_moments(int boundary_row, int degree) const {
  if (!loads.displacement_mm) return EdgeMoments::Zero(2, degree + 1);
  const auto [start, end] = mesh.boundary[boundary_row].vertices;
  const SideCurve curve =
      follows_curve(boundary_row, degree) ? curve_of(boundary_row, degree) : SideCurve();
  EdgeMoments moments = moments_along(
      mesh.vertices[start], mesh.vertices[end], curve, degree,
      [&](const Eigen::Vector2d& x) { return loads.displacement_mm(x, boundary_row); });
  if (is_roller(boundary_row))
    for (int j = 0; j <= degree; ++j) {
      const Eigen::Vector2d n = frame_of_moment(boundary_row, degree, j).normal;
      moments.col(j) = (n * n.dot(moments.col(j))).eval();
    }
  return moments;
}

void find_round_sides(Problem& problem) {
  const Mesh& mesh = problem.mesh;
  for (std::size_t row = 0; row < problem.curve_normals.size(); ++row)  // of rollers before
    if (mesh.boundary[row].role != BoundaryRole::contact) problem.curve_normals[row] = {};
  problem.round.clear();
  problem.round_rows.clear();
  if (std::ranges::all_of(mesh.boundary,
                          [](const BoundaryEdge& edge) { return edge.curve.is_straight(); }))
    return;
  add_roller_normals(problem);
  std::vector<int> row_of_edge(static_cast<std::size_t>(problem.edges.count()), Problem::no_row);
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row)
    if (may_follow_curve(problem, row)) row_of_edge[problem.edges.of_boundary[row]] = row;
  std::vector<bool> fit(mesh.boundary.size(), false);
  const auto for_sides = [&](const auto& visit) {
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
      for (int side = 0; side < 3; ++side)
        if (const int row = row_of_edge[problem.edges.of_triangle[t][side]]; row != Problem::no_row)
          visit(t, side, row);
  };
  for_sides([&](int t, int side, int row) {
    const TriangleVertices v = problem.vertices_of(t);
    fit[row] = fits(mesh.boundary[row].curve, v.col((side + 2) % 3));
  });
  for_sides([&](int t, int side, int row) {
    const int other = problem.opposite_of(row);
    if (!fit[row] || (other != Problem::no_row && !fit[other])) return;
    if (problem.round.empty() || problem.round.back().triangle != t)
      problem.round.push_back({t, {Problem::no_row, Problem::no_row, Problem::no_row}});
    problem.round.back().rows[side] = row;
    problem.round_rows.push_back(row);
  });
  std::ranges::sort(problem.round_rows);
}

bool same_body(const Problem& a, const Problem& b) {
  const auto alike = [](const BoundaryEdge& x, const BoundaryEdge& y) {
    return x.vertices == y.vertices && x.role == y.role && x.curve.points_mm == y.curve.points_mm;
  };
  if (a.mesh.vertices != b.mesh.vertices || a.mesh.triangles != b.mesh.triangles ||
      a.mesh.triangle_body != b.mesh.triangle_body || a.compliance != b.compliance ||
      !std::ranges::equal(a.mesh.boundary, b.mesh.boundary, alike) ||
      a.contact_normals != b.contact_normals || a.curve_normals != b.curve_normals ||
      a.opposite != b.opposite)
    return false;
  for (int row = 0; row < static_cast<int>(a.mesh.boundary.size()); ++row)
    if (const EdgeCondition x = a.condition(row), y = b.condition(row);
        x.in_frame != y.in_frame || x.component != y.component)
      return false;
  return true;
}

Problem make_problem(Mesh mesh, std::vector<Eigen::Matrix3d> compliance, Loads loads,
                     double friction) {
  const std::vector<double> everywhere(mesh.boundary.size(), friction);
  return make_problem(std::move(mesh), std::move(compliance), std::move(loads), everywhere);
}

Problem make_problem(Mesh mesh, std::vector<Eigen::Matrix3d> compliance, Loads loads,
                     const std::vector<double>& friction) {
  assert(compliance.size() == mesh.body_names.size());
  assert(loads.rollers.empty() || loads.rollers.size() == mesh.boundary.size());
  assert(friction.size() == mesh.boundary.size());
  std::vector<double> on_contact = friction_on_contact(mesh, friction);
  Problem problem{.mesh = std::move(mesh),
                  .compliance = std::move(compliance),
                  .loads = std::move(loads),
                  .friction = std::move(on_contact)};
  problem.edges = number_edges(problem.mesh);
  take_out_rigid_motion(problem);

  const MeshPieces pieces = pieces_of(problem.mesh);
  problem.free = free_motions(problem.mesh, problem.loads.rollers, problem.loads.points, pieces);
  problem.central_vertices = central_vertices(problem, pieces);
  find_round_sides(problem);
  return problem;
}

Problem with_chords(Problem problem) {
  problem.round.clear();
  problem.round_rows.clear();
  return problem;
}

SplitDisplacement split_rigid_motion(const Problem& problem) {
  std::vector<PrescribedEdge> edges;
  const auto& x = problem.mesh.vertices;
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row)
    if (const BoundaryEdge& edge = problem.mesh.boundary[row];
        edge.role == BoundaryRole::displacement)
      edges.push_back({x[edge.vertices[0]], x[edge.vertices[1]], row, problem.is_roller(row)});
  return split_rigid_motion(problem.loads.displacement_mm, edges);
}

Problem with_loads(const Problem& problem, Loads loads) {
  Problem result{.mesh = problem.mesh,
                 .edges = problem.edges,
                 .compliance = problem.compliance,
                 .poisson_zz = problem.poisson_zz,
                 .loads = std::move(loads),
                 .free = problem.free,
                 .friction = problem.friction,
                 .contact_normals = problem.contact_normals,
                 .curve_normals = problem.curve_normals,
                 .opposite = problem.opposite,
                 .matching = problem.matching,
                 .round = problem.round,
                 .round_rows = problem.round_rows,
                 .central_vertices = problem.central_vertices};
  if (!result.loads.roles.empty())
    result.mesh = with_roles(std::move(result.mesh), result.loads.roles);
  result.free.amounts_mm.resize(0);
  take_out_rigid_motion(result);
  if (same_supports(problem, problem.loads, result.loads)) return result;
  result.free =
      free_motions(result.mesh, result.loads.rollers, result.loads.points, pieces_of(result.mesh));
  if (!problem.round.empty()) find_round_sides(result);  // else chords
  return result;
}

bool same_supports(const Problem& first, const Loads& a, const Loads& b) {
  for (std::size_t row = 0; row < first.mesh.boundary.size(); ++row) {
    const auto support = [&](const Loads& loads) {
      return std::pair(loads.roles.empty() ? first.mesh.boundary[row].role : loads.roles[row],
                       !loads.rollers.empty() && loads.rollers[row]);
    };
    if (support(a) != support(b)) return false;
  }
  return true;
}

Problem problem_of_step(const Problem& first, int step) {
  return step == 0 ? first
                   : with_loads(first, first.later_steps[static_cast<std::size_t>(step) - 1]);
}

bool has_free_motions(const Problem& first) {
  return !first.free.motions.empty() ||
         std::ranges::any_of(first.later_steps, [&](const Loads& loads) {
           return !same_supports(first, first.loads, loads) &&
                  !with_loads(first, loads).free.motions.empty();
         });
}

Problem with_free_motion(Problem problem, Eigen::VectorXd amounts_mm) {
  problem.free.amounts_mm = std::move(amounts_mm);
  return problem;
}

}  // namespace airybench
