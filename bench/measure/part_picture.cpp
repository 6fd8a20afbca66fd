#include "bench/measure/part_picture.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "bench/measure/part_answer.hpp"
#include "bench/measure/stress_samples.hpp"
#include "mesh/boundary_sides.hpp"
#include "verify/along_contact.hpp"

namespace airybench {
namespace {

constexpr int parts_of_edge = 8;

// As many as are seen: about 6e4 points in all.
int parts_of_third(std::size_t triangles) {
  constexpr double points = 6e4;
  return static_cast<int>(
      std::clamp(std::sqrt(2 * points / (3 * static_cast<double>(triangles))), 2., 8.));
}

std::string role_of(const Problem& problem, int row) {
  const BoundaryRole role = problem.mesh.boundary[row].role;
  return role == BoundaryRole::displacement && problem.is_roller(row)
             ? "rollers"
             : std::string(boundary_role_names[static_cast<std::size_t>(role)]);
}

}  // namespace

std::string von_mises_csv(const SolvedFields& fields) {
  const Problem& problem = *fields.system.problem;
  const StressField& stress = fields.solution.stress;
  const StressSamples samples(problem, stress, parts_of_third(stress.size()));
  std::string text = "third,x_mm,y_mm,von_mises_MPa\n";
  for (int t = 0; t < static_cast<int>(stress.size()); ++t) {
    for (int k = 0; k < 3; ++k) {
      const StressSamples::Third third = samples.third(t, k);
      for (Eigen::Index i = 0; i < third.at_mm.cols(); ++i)
        fmt::format_to(std::back_inserter(text), "{},{:.8g},{:.8g},{:.6g}\n", 3 * t + k + 1,
                       third.at_mm(0, i), third.at_mm(1, i),
                       von_mises(problem, t, third.at_mm.col(i), third.stress.col(i)));
    }
  }
  return text;
}

std::string outline_csv(const Problem& problem, int degree,
                        const std::optional<DisplacementField>& u) {
  const Mesh& mesh = problem.mesh;
  const MeshPieces pieces = pieces_of(mesh);
  const std::vector<TriangleSide> sides = boundary_sides(problem.edges);
  std::string text = "edge,piece,x_mm,y_mm,ux_mm,uy_mm,tx_MPa,ty_MPa,role\n";
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row) {
    const BoundaryEdge& edge = mesh.boundary[row];
    const int t = sides[static_cast<std::size_t>(row)].triangle;
    Eigen::Matrix3d corners;
    corners << problem.vertices_of(t), Eigen::RowVector3d::Ones();
    const Eigen::Matrix3d inverse = corners.inverse();
    for (int i = 0; i <= parts_of_edge; ++i) {
      const double s = static_cast<double>(i) / parts_of_edge;
      const Eigen::Vector2d x = point_on_edge(problem, row, degree, s);
      std::string moved = ",";
      if (u) {
        const Eigen::Vector2d of_x =
            displacement_at(problem, *u, t, inverse * Eigen::Vector3d(x.x(), x.y(), 1));
        moved = fmt::format("{:.8g},{:.8g}", of_x.x(), of_x.y());
      }
      Eigen::Vector2d traction(0, 0);
      if (edge.role == BoundaryRole::force && problem.loads.traction_MPa)
        traction = problem.loads.traction_MPa(x, normal_on_edge(problem, row, degree, s), row);
      text += fmt::format("{},{},{:.8g},{:.8g},{},{:.6g},{:.6g},{}\n", row + 1,
                          pieces.of_vertex[edge.vertices[0]] + 1, x.x(), x.y(), moved, traction.x(),
                          traction.y(), role_of(problem, row));
    }
  }
  return text;
}

}  // namespace airybench
