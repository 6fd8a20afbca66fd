#include "bench/fields.hpp"

#include <fmt/format.h>

#include "assembly/atomic_file.hpp"
#include "assembly/edge_forces.hpp"
#include "bench/record_files.hpp"
#include "bench/verifier.hpp"

namespace airybench {
namespace {

std::string stress_csv(const Problem& problem, const StressField& stress) {
  std::string text = "triangle,third,corner,x_mm,y_mm,sxx_MPa,syy_MPa,sxy_MPa\n";
  for (int t = 0; t < static_cast<int>(stress.size()); ++t) {
    const TriangleVertices v = problem.vertices_of(t);
    const Eigen::Vector2d centroid = v.rowwise().mean();
    for (int c = 0; c < 9; ++c) {
      const int third = c / 3, corner = c % 3;
      const Eigen::Vector2d x =
          corner == 2 ? centroid : Eigen::Vector2d(v.col((third + corner) % 3));
      const auto s = stress[t].col(c);
      text += fmt::format("{},{},{},{},{},{},{},{}\n", t + 1, third + 1, corner + 1, x.x(), x.y(),
                          s(0), s(1), s(2));
    }
  }
  return text;
}

std::string contact_csv(const DualSystem& system, const Solution& solution) {
  constexpr std::array<const char*, 3> names = {"open", "stick", "slip"};
  const Mesh& mesh = system.problem->mesh;
  const ContactPoints& contact = system.contact;
  const std::vector<ContactState> states = contact_states(contact, solution.F_C);
  std::string text = "x_mm,y_mm,normal_x,normal_y,edge_length_mm,F_n_N,F_t_N,state\n";
  for (int p = 0; p < contact.count; ++p) {
    const auto [a, b] = mesh.boundary[contact.boundary[p]].vertices;
    const EdgeFrame frame = edge_frame(mesh.vertices[a], mesh.vertices[b]);
    const Eigen::Vector2d x = mesh.vertices[p % 2 == 0 ? a : b];
    const int m = contact.components;
    text +=
        fmt::format("{},{},{},{},{},{},{},{}\n", x.x(), x.y(), frame.normal.x(), frame.normal.y(),
                    frame.length_mm, solution.F_C(m * p), m == 2 ? solution.F_C(m * p + 1) : 0.0,
                    names[static_cast<std::size_t>(states[p])]);
  }
  return text;
}

std::string boundary_csv(const Mesh& mesh) {
  std::string text = "x0_mm,y0_mm,x1_mm,y1_mm,role\n";
  for (const BoundaryEdge& edge : mesh.boundary) {
    const auto &a = mesh.vertices[edge.vertices[0]], &b = mesh.vertices[edge.vertices[1]];
    text += fmt::format("{},{},{},{},{}\n", a.x(), a.y(), b.x(), b.y(),
                        boundary_role_names[static_cast<std::size_t>(edge.role)]);
  }
  return text;
}

}  // namespace

void write_fields(const std::filesystem::path& folder, const std::string& name,
                  const DualSystem& system, const Solution& solution) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw OutputError(
        fmt::format("{}: cannot be made a folder: {}", folder.string(), error.message()));
  write_file_atomically(folder / (name + ".stress.csv"),
                        stress_csv(*system.problem, solution.stress));
  write_file_atomically(folder / (name + ".contact.csv"), contact_csv(system, solution));
  write_file_atomically(folder / (name + ".boundary.csv"), boundary_csv(system.problem->mesh));
}

}  // namespace airybench
