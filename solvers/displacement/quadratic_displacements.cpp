#include "solvers/displacement/quadratic_displacements.hpp"

#include "assembly/sparse_bytes.hpp"

namespace airybench {
namespace {

// Numbers the unknowns, those of the control points last; returns how many there are.
int number_unknowns(QuadraticDisplacements& system) {
  constexpr int not_yet = -2;
  const ContactPoints& law = system.control.law;
  system.unknown.assign(system.given.at.size(), {not_yet, not_yet});
  for (std::size_t node = 0; node < system.unknown.size(); ++node)
    if (system.given.at[node]) system.unknown[node].fill(QuadraticDisplacements::prescribed);
  std::vector<bool> is_contact_normal(system.unknown.size(), false);
  for (const int node : system.control.node) is_contact_normal[node] = true;

  int count = 0;
  for (std::size_t node = 0; node < system.unknown.size(); ++node)
    for (int k = 0; k < 2; ++k) {
      const bool is_contact = is_contact_normal[node] && k < law.components;
      if (system.unknown[node][k] == not_yet && !is_contact) system.unknown[node][k] = count++;
    }
  for (const int node : system.control.node)
    for (int k = 0; k < law.components; ++k) system.unknown[node][k] = count++;
  return count;
}

// Per node: its control point, or none.
constexpr int none = -1;
std::vector<int> points_of_nodes(const QuadraticDisplacements& system) {
  std::vector<int> point(system.unknown.size(), none);
  for (int p = 0; p < system.control.law.count; ++p) point[system.control.node[p]] = p;
  return point;
}

// Adds forces at the nodes to a vector of the unknowns.
void add_nodal(const Eigen::Matrix2Xd& forces, const std::vector<int>& point,
               const QuadraticDisplacements& system, Eigen::VectorXd& b) {
  for (Eigen::Index node = 0; node < forces.cols(); ++node) {
    if (system.given.at[node]) continue;
    Eigen::Vector2d force = forces.col(node);
    if (point[node] != none) force = system.control.frame(point[node]).transpose() * force;
    for (int k = 0; k < 2; ++k) b(system.unknown[node][k]) += force(k);
  }
}

}  // namespace

std::size_t QuadraticDisplacements::bytes() const {
  return bytes_of(K) + static_cast<std::size_t>(b.size() + given.u.size()) * sizeof(double) +
         unknown.size() * sizeof(unknown[0]);
}

QuadraticDisplacements assemble_quadratic_displacements(const Problem& problem) {
  QuadraticDisplacements system;
  system.control = control_points(problem);
  system.given = prescribed_displacement(problem);
  const int n = number_unknowns(system);
  const std::vector<int> point = points_of_nodes(system);
  system.b = Eigen::VectorXd::Zero(n);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(78 * problem.mesh.triangles.size());

  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t) {
    QuadraticStrain strain = quadratic_strain(problem.vertices_of(t));
    const std::array<int, 6> nodes = triangle_nodes(problem, t);
    std::array<int, 12> unknown;
    Eigen::Matrix<double, 12, 1> given;
    for (int m = 0; m < 6; ++m) {
      auto columns = strain.middleCols<2>(2 * m);
      if (point[nodes[m]] != none)
        columns = (columns * system.control.frame(point[nodes[m]])).eval();
      given.segment<2>(2 * m) = system.given.u.col(nodes[m]);
      for (int k = 0; k < 2; ++k) unknown[2 * m + k] = system.unknown[nodes[m]][k];
    }
    const QuadraticStiffness K =
        quadratic_stiffness(strain, problem.area_mm2(t), elasticity_of(problem, t));
    const Eigen::Matrix<double, 12, 1> force = K * given;
    for (int j = 0; j < 12; ++j) {
      const int column = unknown[j];
      if (column == QuadraticDisplacements::prescribed) continue;
      system.b(column) -= force(j);
      for (int i = 0; i < 12; ++i)
        if (unknown[i] >= column)  // the lower triangle, and nothing prescribed
          entries.emplace_back(unknown[i], column, K(i, j));
    }
  }
  if (problem.loads.has_body_force() || problem.loads.traction_MPa)
    add_nodal(nodal_loads(problem), point, system, system.b);
  system.K.resize(n, n);
  system.K.setFromTriplets(entries.begin(), entries.end());
  return system;
}

DisplacementField displacement_field(const QuadraticDisplacements& system,
                                     const Eigen::VectorXd& unknowns) {
  const std::vector<int> point = points_of_nodes(system);
  DisplacementField u = system.given.u;
  for (Eigen::Index node = 0; node < u.cols(); ++node) {
    if (system.given.at[node]) continue;
    for (int k = 0; k < 2; ++k) u(k, node) = unknowns(system.unknown[node][k]);
    if (point[node] != none) u.col(node) = system.control.frame(point[node]) * u.col(node).eval();
  }
  return u;
}

Eigen::VectorXd unbalanced_forces(const Problem& problem, const QuadraticDisplacements& system,
                                  const NodalForces& of_stresses, const Eigen::VectorXd& F_C) {
  Eigen::VectorXd r = Eigen::VectorXd::Zero(system.b.size());
  add_nodal(nodal_loads(problem) - of_stresses.sum, points_of_nodes(system), system, r);
  r.tail(system.n_c()) += F_C;
  return r;
}

}  // namespace airybench
