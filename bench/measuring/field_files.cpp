#include "bench/measuring/field_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "assembly/control_points.hpp"
#include "assembly/edge_forces.hpp"
#include "bench/judging/verifier.hpp"
#include "support/atomic_file.hpp"

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

// Per contact point.
struct ContactPicture {
  std::vector<Eigen::Vector2d> force;  // normal, tangential, N
  std::vector<ContactState> state;
};

ContactPicture contact_picture(const ContactPoints& contact, const Solution& solution) {
  ContactPicture picture;
  picture.state = contact_states(contact, solution.F_C);
  const int m = contact.components;
  for (int p = 0; p < contact.count; ++p)
    picture.force.emplace_back(solution.F_C(m * p), m == 2 ? solution.F_C(m * p + 1) : 0.0);
  return picture;
}

// The control point of an edge's end; where that is prescribed, of the edge.
ContactPicture contact_picture_of_displacements(const DualSystem& system,
                                                const Solution& solution) {
  const Problem& problem = *system.problem;
  const ControlPoints control = control_points(problem);
  const std::vector<ContactState> states = contact_states(control.law, solution.F_C);
  std::map<int, ContactState> state_of_node;
  for (int p = 0; p < control.law.count; ++p) state_of_node[control.node[p]] = states[p];
  std::map<int, std::pair<int, int>> side_of_edge;  // triangle, which of its sides
  for (int t = 0; t < static_cast<int>(solution.stress.size()); ++t)
    for (int k = 0; k < 3; ++k) side_of_edge[problem.edges.of_triangle[t][k]] = {t, k};

  ContactPicture picture;
  for (int p = 0; p < system.contact.count; ++p) {
    const int row = system.contact.boundary[p], end = p % 2;
    const std::array<int, 3> nodes = boundary_nodes(problem, row);
    const auto found = state_of_node.find(nodes[2 * end]);
    picture.state.push_back(found != state_of_node.end() ? found->second
                                                         : state_of_node.at(nodes[1]));
    const auto [t, k] = side_of_edge.at(problem.edges.of_boundary[row]);
    const Eigen::Vector2d force =
        element_edge_forces(problem.vertices_of(t), solution.stress[t], k).col(end);
    const EdgeFrame frame = problem.frame_of_moment(row, end);
    picture.force.emplace_back(frame.normal.dot(force), frame.tangent.dot(force));
  }
  return picture;
}

std::string contact_csv(const DualSystem& system, const Solution& solution) {
  const Mesh& mesh = system.problem->mesh;
  const ContactPoints& contact = system.contact;
  const ContactPicture picture = solution.displacement.cols() > 0
                                     ? contact_picture_of_displacements(system, solution)
                                     : contact_picture(contact, solution);
  std::string text = "x_mm,y_mm,normal_x,normal_y,edge_length_mm,F_n_N,F_t_N,state\n";
  for (int p = 0; p < contact.count; ++p) {
    const auto [a, b] = mesh.boundary[contact.boundary[p]].vertices;
    const EdgeFrame frame = system.problem->frame_of_moment(contact.boundary[p], p % 2);
    const Eigen::Vector2d x = mesh.vertices[p % 2 == 0 ? a : b];
    text += fmt::format("{},{},{},{},{},{},{},{}\n", x.x(), x.y(), frame.normal.x(),
                        frame.normal.y(), frame.length_mm, picture.force[p](0), picture.force[p](1),
                        name_of(picture.state[p]));
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

std::string error_csv(const ConstitutiveError& error) {
  double sum = 0;
  for (const double part : error.of_triangle_Nmm) sum += std::max(0.0, part);
  std::string text = "triangle,error_share\n";
  for (std::size_t t = 0; t < error.of_triangle_Nmm.size(); ++t)
    text += fmt::format("{},{}\n", t + 1,
                        sum > 0 ? std::max(0.0, error.of_triangle_Nmm[t]) / sum : 0.0);
  return text;
}

}  // namespace

void write_fields(const std::filesystem::path& folder, const std::string& name,
                  const DualSystem& system, const Solution& solution) {
  make_folder(folder);
  write_file_atomically(folder / (name + ".stress.csv"),
                        stress_csv(*system.problem, solution.stress));
  write_file_atomically(folder / (name + ".contact.csv"), contact_csv(system, solution));
  write_file_atomically(folder / (name + ".boundary.csv"), boundary_csv(system.problem->mesh));
}

void write_mean_field(const std::filesystem::path& folder, const std::string& name,
                      const Problem& problem, const StressField& mean) {
  make_folder(folder);
  write_file_atomically(folder / (name + ".mean.csv"), stress_csv(problem, mean));
}

void write_error_field(const std::filesystem::path& folder, const std::string& name,
                       const ConstitutiveError& error) {
  make_folder(folder);
  write_file_atomically(folder / (name + ".error.csv"), error_csv(error));
}

}  // namespace airybench
