#include "bench/problems/problem_arrays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "assembly/elements/bernstein.hpp"
#include "assembly/row_order.hpp"
#include "solvers/condensation/hybridized.hpp"

namespace airybench {
namespace {

template <int width>
Eigen::MatrixXi index_table(const std::vector<std::array<int, width>>& rows) {
  Eigen::MatrixXi table(static_cast<Eigen::Index>(rows.size()), width);
  for (Eigen::Index i = 0; i < table.rows(); ++i)
    for (int k = 0; k < width; ++k) table(i, k) = rows[i][k];
  return table;
}

Eigen::MatrixXd point_table(const std::vector<Eigen::Vector2d>& points) {
  Eigen::MatrixXd table(static_cast<Eigen::Index>(points.size()), 2);
  for (Eigen::Index i = 0; i < table.rows(); ++i) table.row(i) = points[i];
  return table;
}

SparseRows whole(const SparseColumns& lower_triangle) {
  return SparseColumns(lower_triangle.selfadjointView<Eigen::Lower>());
}

// Per unknown: kind (0 phi, 1 phi,x, 2 phi,y, 3 dphi/dn), then vertex or edge.
Eigen::MatrixXi unknown_table(const DofNumbering& dofs) {
  Eigen::MatrixXi table(dofs.count, 2);
  for (int v = 0; v < static_cast<int>(dofs.of_vertex.size()); ++v)
    if (const int first = dofs.of_vertex[v]; first != DofNumbering::gauge)
      for (int k = 0; k < 3; ++k) table.row(first + k) << k, v;
  for (int e = 0; e < static_cast<int>(dofs.of_edge.size()); ++e)
    table.row(dofs.of_edge[e]) << 3, e;
  return table;
}

void add_rows(std::vector<ProblemArray>& arrays, const std::string& name, const std::string& matrix,
              const std::vector<KnownRow>& rows) {
  std::vector<std::array<int, 2>> places;
  std::vector<Eigen::Vector2d> directions;
  for (const KnownRow& row : rows) {
    places.push_back({row.boundary_row, row.end});
    directions.push_back(row.direction);
  }
  arrays.push_back(
      {name + "_rows", "1",
       fmt::format("per row of {}: row of boundary, end of that edge (0 start, 1 end)", matrix),
       index_table<2>(places)});
  arrays.push_back(
      {name + "_directions", "1",
       fmt::format("per row of {}: unit vector along which the force is measured", matrix),
       point_table(directions)});
}

Eigen::MatrixXd point_places(const Problem& problem, const ContactPoints& contact) {
  std::vector<Eigen::Vector2d> points;
  for (int p = 0; p < contact.count; ++p) {
    const BoundaryEdge& edge = problem.mesh.boundary[contact.boundary[p]];
    points.push_back(problem.mesh.vertices[edge.vertices[p % 2]]);
  }
  return point_table(points);
}

}  // namespace

Eigen::Index ProblemArray::rows() const {
  return std::visit([](const auto& matrix) { return Eigen::Index(matrix.rows()); }, values);
}
Eigen::Index ProblemArray::columns() const {
  return std::visit([](const auto& matrix) { return Eigen::Index(matrix.cols()); }, values);
}

Eigen::MatrixXd written_out(const Eigen::VectorXd& vector, Eigen::Index size) {
  if (vector.size() > 0) return vector;
  return Eigen::VectorXd::Zero(size);
}

std::vector<KnownRow> known_rows(const Problem& problem, Known known) {
  std::vector<KnownRow> rows;
  const auto add_edge = [&](int row) {
    const EdgeCondition condition = problem.condition(row);
    if (known == Known::contact_law && problem.is_second_of_pair(row)) return;
    for (const int end : {0, 1}) {
      const EdgeFrame frame = problem.frame_of_moment(row, 1, end);
      const std::array<Eigen::Vector2d, 2> axes =
          condition.in_frame
              ? std::array{frame.normal, frame.tangent}
              : std::array<Eigen::Vector2d, 2>{Eigen::Vector2d::UnitX(), Eigen::Vector2d::UnitY()};
      for (int i = 0; i < 2; ++i)
        if (condition.component[i] == known) rows.push_back({row, end, axes[i]});
    }
  };
  for_each_boundary_row(problem.mesh, add_edge);
  return rows;
}

std::vector<ProblemArray> mesh_arrays(const Mesh& mesh) {
  std::vector<std::array<int, 2>> boundary;
  std::vector<std::array<int, 1>> roles;
  for (const BoundaryEdge& edge : mesh.boundary) {
    boundary.push_back(edge.vertices);
    roles.push_back({static_cast<int>(edge.role)});
  }
  return {
      {"vertices_mm", "mm", "x, y of every vertex", point_table(mesh.vertices)},
      {"triangles", "1", "three vertices, counter-clockwise", index_table<3>(mesh.triangles)},
      {"edges", "1", "low vertex, high vertex; normal (s_y, -s_x) with s from low to high",
       index_table<2>(number_edges(mesh).vertices)},
      {"boundary", "1", "start and end vertex of every boundary edge, the body on the left",
       index_table<2>(boundary)},
      {"boundary_roles", "1", "per row of boundary: 0 displacement, 1 force, 2 contact",
       index_table<1>(roles)},
  };
}

std::vector<ProblemArray> airy_arrays(const AirySystem& system) {
  std::vector<ProblemArray> arrays = {
      {"S", "1", "flexibility in x = phi/scale, symmetric positive definite, diagonal 1",
       whole(system.S), true},
      {"C_F", "sqrt(N/mm)", "x to the known forces", system.C_F},
      {"q", "sqrt(N mm)", "load", written_out(system.q, system.n())},
      {"F", "N", "known forces, C_F x = F", written_out(system.F, system.n_f())},
      {"scale", "sqrt(N/mm), of derivatives sqrt(N/mm)/mm",
       "Airy function and derivatives: phi = scale * x", written_out(system.scale, system.n())},
      {"unknowns", "1",
       "per x: 0 phi, 1 phi,x, 2 phi,y of a vertex, 3 dphi/dn of an edge; which vertex or edge",
       unknown_table(system.dofs)},
  };
  if (system.n_c() > 0) {
    arrays.push_back({"C_C", "sqrt(N/mm)", "x to the contact forces, without F0", system.C_C});
    arrays.push_back({"F0", "N", "contact forces of the stress that balances the body force",
                      written_out(system.F0, system.n_c())});
  }
  add_rows(arrays, "force", "C_F", known_rows(*system.problem, Known::force));
  return arrays;
}

std::vector<ProblemArray> body_arrays(const Problem& problem) {
  const Mesh& mesh = problem.mesh;
  const auto rows = static_cast<Eigen::Index>(mesh.boundary.size());
  Eigen::MatrixXi body(static_cast<Eigen::Index>(mesh.triangles.size()), 1);
  for (Eigen::Index t = 0; t < body.rows(); ++t) body(t) = mesh.triangle_body[t];
  Eigen::MatrixXd compliance(static_cast<Eigen::Index>(problem.compliance.size()), 9);
  for (Eigen::Index b = 0; b < compliance.rows(); ++b)
    compliance.row(b) = problem.compliance[b].reshaped();  // symmetric
  Eigen::MatrixXi rollers = Eigen::MatrixXi::Zero(rows, 1);
  Eigen::MatrixXd u0 = Eigen::MatrixXd::Zero(rows, 6), traction = Eigen::MatrixXd::Zero(rows, 4),
                  gap = Eigen::MatrixXd::Zero(rows, 3), normals = Eigen::MatrixXd::Zero(rows, 6),
                  moment_normals = Eigen::MatrixXd::Zero(rows, 4),
                  friction = Eigen::MatrixXd::Zero(rows, 1);
  for (int row = 0; row < static_cast<int>(rows); ++row) {
    const auto [start, end] = mesh.boundary[row].vertices;
    const Eigen::Vector2d &a = mesh.vertices[start], &b = mesh.vertices[end];
    const BoundaryRole role = mesh.boundary[row].role;
    rollers(row) = problem.is_roller(row) ? 1 : 0;
    friction(row) = problem.friction_at(row);
    if (role == BoundaryRole::contact)
      for (const int k : {0, 1})
        moment_normals.row(row).segment<2>(2 * k) = problem.frame_of_moment(row, 1, k).normal;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector2d x = k == 0 ? a : k == 2 ? b : Eigen::Vector2d((a + b) / 2);
      const EdgeFrame frame = problem.frame_at(row, k, 2);
      if (role == BoundaryRole::displacement) {
        u0.row(row).segment<2>(2 * k) = problem.motion.at(x);
        if (problem.loads.displacement_mm)
          u0.row(row).segment<2>(2 * k) += problem.loads.displacement_mm(x, row);
      } else if (role == BoundaryRole::contact) {
        gap(row, k) = problem.offset_at(x, row).gap_mm;
        normals.row(row).segment<2>(2 * k) = frame.normal;
      } else if (problem.loads.traction_MPa && k != 1) {
        traction.row(row).segment<2>(k) = problem.loads.traction_MPa(x, frame.normal, row);
      }
    }
  }
  std::vector<ProblemArray> arrays = {
      {"triangle_body", "1", "per triangle: row of compliance_per_MPa", body},
      {"compliance_per_MPa", "1/MPa",
       "per body, row by row: (e_xx, e_yy, 2 e_xy) = C (s_xx, s_yy, s_xy), plane strain or stress "
       "in it",
       compliance},
      {"rollers", "1", "per row of boundary: 1 where only the normal displacement is given",
       rollers},
      {"u0_mm", "mm", "per row of boundary: given displacement x, y at start, middle, end", u0},
      {"traction_MPa", "MPa", "per row of boundary: given traction x, y at start and end",
       traction},
      {"gap_mm", "mm", "per row of boundary: gap to the wall at start, middle, end", gap},
      {"contact_normals", "1",
       "per row of boundary: outward normal of the contact law, x, y at start, middle, end",
       normals},
      {"contact_moment_normals", "1",
       "per row of boundary: the same for the moments of its start and its end", moment_normals},
      {"friction", "1", "per row of boundary", friction},
      {"body_force_N_per_mm3", "N/mm^3", "x, y",
       Eigen::MatrixXd(problem.loads.body_force_N_per_mm3)},
  };
  if (!problem.opposite.empty())
    arrays.push_back(
        {"contact_opposite", "1",
         "per row of boundary: the row of another body that it presses on, walked the "
         "other way; its gap_mm adds to this one's; -1: a wall",
         Eigen::MatrixXi(Eigen::Map<const Eigen::VectorXi>(
             problem.opposite.data(), static_cast<Eigen::Index>(problem.opposite.size())))});
  if (const Eigen::MatrixXd& slid = problem.loads.slid_mm; slid.size() > 0) {
    Eigen::MatrixXd at_points(rows, 3);
    for (int row = 0; row < static_cast<int>(rows); ++row)
      for (int k = 0; k < 3; ++k)
        at_points(row, k) = bernstein_value(Eigen::VectorXd(slid.col(row)), k / 2.);
    arrays.push_back(
        {"slid_mm", "mm",
         "per row of boundary: tangential displacement from which slip is measured, at "
         "start, middle, end; those of a pair add up; without the array 0",
         at_points});
  }
  return arrays;
}

std::vector<ProblemArray> hybrid_arrays(const Problem& problem, int degree) {
  const ContactPoints contact = contact_points(problem, degree);
  const HybridizedSystem system = assemble_hybridized(problem, contact);
  const auto& numbers = system.unknown;
  const Eigen::MatrixXi unknowns =
      Eigen::Map<const Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
          numbers.entries().data(), static_cast<Eigen::Index>(numbers.size()), numbers.length());
  return {
      {"K", "N/mm", "stiffness of the unknown edge displacements, symmetric positive definite",
       whole(lower_triangle(system.K)), true},
      {"b", "N", "loads without the contact forces, K u = b + F_C at the last unknowns",
       Eigen::MatrixXd(system.b)},
      {"unknowns", "1",
       "per row of edges: numbers of its moments' x and y from the low vertex on; on contact edges "
       "and rollers normal and tangential, from the start on; -1: prescribed",
       unknowns},
      {"contact_unknowns", "1", "numbers of the last unknowns, in the order of F_C",
       Eigen::MatrixXi(Eigen::VectorXi::LinSpaced(system.n_c,
                                                  static_cast<int>(system.b.size()) - system.n_c,
                                                  static_cast<int>(system.b.size()) - 1))}};
}

std::vector<ProblemArray> contact_law_arrays(const ContactPoints& points) {
  Eigen::MatrixXd mu(points.count, 1);
  for (int p = 0; p < points.count; ++p) mu(p) = points.friction_at(p);
  return {{"gap", "mm", "r = u_C - gap, per row of F_C", written_out(points.gap, points.size())},
          {"mu", "1", "friction, per contact point", mu}};
}

std::vector<ProblemArray> contact_arrays(const contact::Problem& problem,
                                         const Eigen::VectorXd& answer) {
  const ContactPoints& points = problem.points;
  std::vector<ProblemArray> arrays = {
      {"D", "mm/N",
       problem.is_symmetric ? "compliance, symmetric positive definite: u_C = D F_C - G"
                            : "compliance, not symmetric: u_C = D F_C - G",
       problem.is_dense() ? ProblemArray::Values(problem.D) : problem.rows, problem.is_symmetric},
      {"G", "mm", "-G are the contact displacements without contact forces",
       written_out(problem.G, points.size())}};
  std::ranges::move(contact_law_arrays(points), std::back_inserter(arrays));
  if (answer.size() > 0)
    arrays.push_back({"F_C", "N", "an answer to compare with: the refined solution of HYBRID",
                      Eigen::MatrixXd(answer)});
  return arrays;
}

std::vector<ProblemArray> contact_place_arrays(const Problem& body, const ContactPoints& points) {
  std::vector<ProblemArray> arrays = {{"contact_points_mm", "mm",
                                       "x, y of every contact point: an end of a contact edge",
                                       point_places(body, points)}};
  add_rows(arrays, "contact", "F_C", known_rows(body, Known::contact_law));
  return arrays;
}

}  // namespace airybench
