#include "solvers/displacement/quadratic_displacements.hpp"

#include <algorithm>

namespace airybench {
namespace {

// Numbers the unknowns, those of the control points last; returns how many there are.
int number_unknowns(QuadraticDisplacements& system) {
  constexpr int not_yet = -2, later = -3;
  const ContactPoints& law = system.control.law;
  system.unknown.assign(system.given.at.size(), {not_yet, not_yet});
  for (std::size_t node = 0; node < system.unknown.size(); ++node)
    if (system.given.at[node]) system.unknown[node].fill(QuadraticDisplacements::prescribed);
  for (const auto& [node, normal] : system.given.normal)
    system.unknown[node][0] = QuadraticDisplacements::prescribed;
  for (int p = 0; p < law.count; ++p) {
    auto& unknown = system.unknown[system.control.node[p]];
    unknown[0] = later;
    unknown[1] = system.control.on_roller[p] ? QuadraticDisplacements::prescribed
                 : law.components == 2       ? later
                                             : not_yet;
  }
  int count = 0;
  for (auto& node : system.unknown)
    for (int& number : node)
      if (number == not_yet) number = count++;
  for (int p = 0; p < law.count; ++p) {
    const int node = system.control.node[p];
    for (int k = 0; k < law.components; ++k, ++count) {
      if (system.unknown[node][k] == later)
        system.unknown[node][k] = count;
      else
        system.held_tangent[node] = count;
    }
  }
  return count;
}

// The directions of the unknowns of nodes where they are not x and y.
std::map<int, Eigen::Matrix2d> frames(const QuadraticDisplacements& system) {
  std::map<int, Eigen::Matrix2d> frame;
  for (int p = 0; p < system.control.law.count; ++p)
    frame[system.control.node[p]] = system.control.frame(p);
  for (const auto& [node, n] : system.given.normal) frame.try_emplace(node, normal_frame(n));
  return frame;
}

// Adds forces at the nodes to a vector of the unknowns.
void add_nodal(Eigen::Matrix2Xd forces, const std::map<int, Eigen::Matrix2d>& frame,
               const QuadraticDisplacements& system, Eigen::VectorXd& b) {
  for (const auto& [node, axes] : frame)
    forces.col(node) = axes.transpose() * forces.col(node).eval();
  for (Eigen::Index node = 0; node < forces.cols(); ++node)
    for (int k = 0; k < 2; ++k)
      if (const int number = system.unknown[node][k]; number != QuadraticDisplacements::prescribed)
        b(number) += forces(k, node);
}

// A triangle in the unknowns' directions.
struct Element {
  std::array<int, 6> nodes;
  std::array<int, 12> unknown;
  Eigen::Matrix<double, 12, 1> given;  // the prescribed coefficients, else 0
  QuadraticStiffness K;
};

Element element(const Problem& problem, const QuadraticDisplacements& system,
                const std::map<int, Eigen::Matrix2d>& frame, int t) {
  Element result;
  QuadraticStrain strain = quadratic_strain(problem.vertices_of(t));
  result.nodes = triangle_nodes(problem, t);
  for (int m = 0; m < 6; ++m) {
    const int node = result.nodes[m];
    result.given.segment<2>(2 * m) = system.given.u.col(node);
    if (const auto own = frame.find(node); own != frame.end()) {
      auto columns = strain.middleCols<2>(2 * m);
      columns = (columns * own->second).eval();
      result.given.segment<2>(2 * m) = own->second.transpose() * system.given.u.col(node);
    }
    for (int k = 0; k < 2; ++k) result.unknown[2 * m + k] = system.unknown[node][k];
  }
  result.K =
      quadratic_stiffness(strain, problem.area_mm2(t), elasticity_of(problem.compliance_of(t)));
  return result;
}

// b −= K_e u0 of a triangle.
void subtract_known_forces(const Element& element, QuadraticDisplacements& system) {
  const Eigen::Matrix<double, 12, 1> force = element.K * element.given;
  for (int j = 0; j < 12; ++j)
    if (element.unknown[j] != QuadraticDisplacements::prescribed)
      system.b(element.unknown[j]) -= force(j);
}

void add_loads(const Problem& problem, const std::map<int, Eigen::Matrix2d>& frame,
               QuadraticDisplacements& system) {
  if (problem.loads.has_body_force() || problem.loads.traction_MPa)
    add_nodal(nodal_loads(problem), frame, system, system.b);
}

}  // namespace

std::size_t QuadraticDisplacements::bytes() const {
  return K.bytes() + static_cast<std::size_t>(b.size() + given.u.size()) * sizeof(double) +
         unknown.size() * sizeof(unknown[0]);
}

QuadraticDisplacements assemble_quadratic_displacements(const Problem& problem) {
  QuadraticDisplacements system;
  system.control = control_points(problem);
  system.given = prescribed_displacement(problem);
  const int n = number_unknowns(system);
  const std::map<int, Eigen::Matrix2d> frame = frames(system);
  system.b = Eigen::VectorXd::Zero(n);
  system.K.order = n;
  system.K.reserve(problem.mesh.triangles.size());

  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t) {
    const Element own = element(problem, system, frame, t);
    const auto centre = centre_of(problem.vertices_of(t));
    system.K.add(own.unknown, centre, own.K);
    subtract_known_forces(own, system);
    for (int j = 1; j < 12; j += 2)
      if (const auto row = system.held_tangent.find(own.nodes[j / 2]);
          row != system.held_tangent.end() && own.unknown[j] == QuadraticDisplacements::prescribed)
        system.K.add_diagonal(row->second, centre, own.K(j, j));
  }
  add_loads(problem, frame, system);
  return system;
}

void set_load_case(const Problem& problem, QuadraticDisplacements& system) {
  system.control = control_points(problem);
  system.given = prescribed_displacement(problem);
  system.b.setZero();
  const std::map<int, Eigen::Matrix2d> frame = frames(system);
  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t)
    if (std::ranges::any_of(triangle_nodes(problem, t),
                            [&](int node) { return !system.given.u.col(node).isZero(0); }))
      subtract_known_forces(element(problem, system, frame, t), system);
  add_loads(problem, frame, system);
}

DisplacementField displacement_field(const QuadraticDisplacements& system,
                                     const Eigen::VectorXd& unknowns) {
  DisplacementField u = system.given.u;
  const auto set = [&](int node, auto&& components) {
    for (int k = 0; k < 2; ++k)
      if (const int number = system.unknown[node][k]; number != QuadraticDisplacements::prescribed)
        components(k) = unknowns(number);
  };
  const std::map<int, Eigen::Matrix2d> frame = frames(system);
  for (int node = 0; node < static_cast<int>(u.cols()); ++node)
    if (!frame.contains(node)) set(node, u.col(node));
  for (const auto& [node, axes] : frame) {
    Eigen::Vector2d local = axes.transpose() * u.col(node);
    set(node, local);
    u.col(node) = axes * local;
  }
  return u;
}

Eigen::VectorXd unbalanced_forces(const Problem& problem, const QuadraticDisplacements& system,
                                  const NodalForces& of_stresses, const Eigen::VectorXd& F_C) {
  Eigen::VectorXd r = Eigen::VectorXd::Zero(system.b.size());
  add_nodal(nodal_loads(problem) - of_stresses.sum, frames(system), system, r);
  r.tail(system.n_c()) += F_C;
  return r;
}

}  // namespace airybench
