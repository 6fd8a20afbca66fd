#include "bench/measure/contact_picture.hpp"

#include <map>

#include "assembly/control_points.hpp"
#include "assembly/edge_forces.hpp"
#include "solvers/contact/coulomb_law.hpp"

namespace airybench {
namespace {

void take_forces(const ContactPoints& contact, const Solution& solution, ContactPicture& picture) {
  picture.state = contact_states(contact, solution.F_C);
  const int m = contact.components;
  for (int p = 0; p < contact.count; ++p)
    picture.force.emplace_back(solution.F_C(m * p), m == 2 ? solution.F_C(m * p + 1) : 0.0);
}

// The control point of an edge's end; where that is prescribed, of the edge.
void take_forces_of_displacements(const DualSystem& system, const Solution& solution,
                                  ContactPicture& picture) {
  const Problem& problem = *system.problem;
  const ControlPoints control = control_points(problem);
  const std::vector<ContactState> states = contact_states(control.law, solution.F_C);
  std::map<int, ContactState> state_of_node;
  for (int p = 0; p < control.law.count; ++p) state_of_node[control.node[p]] = states[p];
  std::map<int, std::pair<int, int>> side_of_edge;  // triangle, which of its sides
  for (int t = 0; t < static_cast<int>(solution.stress.size()); ++t)
    for (int k = 0; k < 3; ++k) side_of_edge[problem.edges.of_triangle[t][k]] = {t, k};

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
}

// r = (w_n − (g0 − ρ_n), w_t − (s0 − ρ_t)) in moments, per contact point.
std::vector<Eigen::Vector2d> moments_of(const DualSystem& system, const DisplacementField& w) {
  const Problem& problem = *system.problem;
  std::vector<Eigen::Vector2d> moments;
  for (int p = 0; p < system.contact.count; ++p) {
    const int row = system.contact.boundary[p], end = p % 2;
    const std::array<int, 3> nodes = boundary_nodes(problem, row);
    const Eigen::Vector2d &a = problem.mesh.vertices[nodes[0]],
                          &b = problem.mesh.vertices[nodes[2]];
    const EdgeFrame frame = problem.frame_of_moment(row, end);
    const auto r = [&](const Eigen::Vector2d& x, const Eigen::Vector2d& u) -> Eigen::Vector2d {
      return Eigen::Vector2d(frame.normal.dot(u), frame.tangent.dot(u)) -
             problem.offset_at(x, row).along(frame.normal);
    };
    const Eigen::Vector2d at_a = w.col(nodes[0]), at_b = w.col(nodes[2]),
                          middle = (at_a + 2 * w.col(nodes[1]) + at_b) / 4;
    const auto [first, second] = edge_moments(r(a, at_a), r((a + b) / 2, middle), r(b, at_b));
    moments.push_back(end == 0 ? first : second);
  }
  return moments;
}

}  // namespace

ContactPicture contact_picture(const DualSystem& system, const Solution& solution,
                               const std::optional<DisplacementField>& w) {
  const ContactPoints& contact = system.contact;
  const bool has_own_points = solution.displacement.cols() == 0;
  ContactPicture picture;
  if (has_own_points)
    take_forces(contact, solution, picture);
  else
    take_forces_of_displacements(system, solution, picture);
  if (w)
    for (const Eigen::Vector2d& r : moments_of(system, *w)) {
      picture.gap_mm.push_back(-r.x());
      picture.slip_mm.push_back(r.y());
    }
  if (!has_own_points || contact.count == 0) return picture;
  const Eigen::VectorXd r = relative_to_gap(contact, solution.contact_displacement);
  const int m = contact.components;
  picture.gap_mm.clear();
  if (m == 2) picture.slip_mm.clear();
  for (int p = 0; p < contact.count; ++p) {
    picture.gap_mm.push_back(-r(m * p));
    if (m == 2) picture.slip_mm.push_back(r(m * p + 1));
  }
  return picture;
}

}  // namespace airybench
