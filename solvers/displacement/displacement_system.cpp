#include "solvers/displacement/displacement_system.hpp"

#include <algorithm>

#include "assembly/curved_traces.hpp"

namespace airybench {
namespace {

// Numbers the unknowns, those of the control points last; returns how many there are.
int number_unknowns(const Problem& problem, DisplacementSystem& system) {
  constexpr int not_yet = -2, later = -3;
  const ContactPoints& law = system.control.law;
  system.unknown.assign(system.given.at.size(), {not_yet, not_yet});
  for (std::size_t node = 0; node < system.unknown.size(); ++node)
    if (system.given.at[node]) system.unknown[node].fill(DisplacementSystem::prescribed);
  for (const auto& [node, normal] : system.given.normal)
    system.unknown[node][0] = DisplacementSystem::prescribed;
  for (const Pin& pin : problem.free.pins)
    with_degree(system.degree - 1, [&](auto k) {
      system.unknown[boundary_nodes<k + 1>(problem, pin.row)[1]][pin.component] =
          DisplacementSystem::prescribed;
    });
  for (int p = 0; p < law.count; ++p) {
    auto& unknown = system.unknown[system.control.node[p]];
    unknown[0] = later;
    unknown[1] = system.control.on_roller[p] ? DisplacementSystem::prescribed
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
std::map<int, Eigen::Matrix2d> frames(const DisplacementSystem& system) {
  std::map<int, Eigen::Matrix2d> frame;
  for (int p = 0; p < system.control.law.count; ++p)
    frame[system.control.node[p]] = system.control.frame(p);
  for (const auto& [node, n] : system.given.normal) frame.try_emplace(node, normal_frame(n));
  return frame;
}

// Adds forces at the nodes to a vector of the unknowns.
void add_nodal(Eigen::Matrix2Xd forces, const std::map<int, Eigen::Matrix2d>& frame,
               const DisplacementSystem& system, Eigen::VectorXd& b) {
  for (const auto& [node, axes] : frame)
    forces.col(node) = axes.transpose() * forces.col(node).eval();
  for (Eigen::Index node = 0; node < forces.cols(); ++node)
    for (int k = 0; k < 2; ++k)
      if (const int number = system.unknown[node][k]; number != DisplacementSystem::prescribed)
        b(number) += forces(k, node);
}

// A triangle in the unknowns' directions.
struct Element {
  DisplacementTriangle::Nodes nodes;
  std::array<int, 2 * DisplacementTriangle::max_nodes> unknown;  // those of its nodes come first
  DisplacementTriangle::Vector given;  // the prescribed coefficients, else 0
  DisplacementTriangle::Stiffness K;
};

Element element(const Problem& problem, const DisplacementSystem& system,
                const CurvedTraces& traces, const std::map<int, Eigen::Matrix2d>& frame, int t,
                const Eigen::Matrix3d& elasticity) {
  const auto& triangle = DisplacementTriangle::of_degree(system.degree);
  Element result{triangle_nodes(problem, system.degree, t),
                 {},
                 DisplacementTriangle::Vector(2 * triangle.nodes),
                 triangle_stiffness(problem, system.degree, t, elasticity)};
  if (const auto* const curved = traces.of(t)) result.K = curved->of_traces(result.K);
  for (int m = 0; m < triangle.nodes; ++m) {
    const int node = result.nodes[m];
    Eigen::Vector2d given = system.given.u.col(node);
    if (const auto own = frame.find(node); own != frame.end()) {
      const Eigen::Matrix2d& axes = own->second;
      auto columns = result.K.middleCols<2>(2 * m);
      columns = columns.lazyProduct(axes).eval();
      auto rows = result.K.middleRows<2>(2 * m);
      rows = axes.transpose().lazyProduct(rows).eval();
      given = axes.transpose() * given.eval();
    }
    result.given.segment<2>(2 * m) = given;
    for (int k = 0; k < 2; ++k) result.unknown[2 * m + k] = system.unknown[node][k];
  }
  return result;
}

// b −= K_e u0 of a triangle.
void subtract_known_forces(const Element& element, DisplacementSystem& system) {
  if (element.given.isZero(0)) return;
  const DisplacementTriangle::Vector force = element.K.lazyProduct(element.given);
  for (int j = 0; j < force.size(); ++j)
    if (element.unknown[j] != DisplacementSystem::prescribed)
      system.b(element.unknown[j]) -= force(j);
}

void add_triangles(const Problem& problem, const CurvedTraces& traces,
                   const std::map<int, Eigen::Matrix2d>& frame, DisplacementSystem& system) {
  constexpr double rigid = 1e8;
  const std::vector<Eigen::Matrix3d> elasticity = elasticities(problem);
  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t) {
    const Element own =
        element(problem, system, traces, frame, t, elasticity[problem.mesh.triangle_body[t]]);
    const auto centre = centre_of(problem.vertices_of(t));
    system.K.add(own.unknown, centre, own.K);
    subtract_known_forces(own, system);
    if (system.held_tangent.empty()) continue;
    for (int j = 1; j < system.K.size; j += 2)
      if (const auto row = system.held_tangent.find(own.nodes[j / 2]);
          row != system.held_tangent.end() && own.unknown[j] == DisplacementSystem::prescribed)
        system.K.add_diagonal(row->second, centre, rigid * own.K(j, j));
  }
}

void subtract_known_forces(const Problem& problem, const CurvedTraces& traces,
                           const std::map<int, Eigen::Matrix2d>& frame,
                           DisplacementSystem& system) {
  const std::vector<Eigen::Matrix3d> elasticity = elasticities(problem);
  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t)
    if (std::ranges::any_of(triangle_nodes(problem, system.degree, t),
                            [&](int node) { return !system.given.u.col(node).isZero(0); }))
      subtract_known_forces(
          element(problem, system, traces, frame, t, elasticity[problem.mesh.triangle_body[t]]),
          system);
}

void add_loads(const Problem& problem, const CurvedTraces& traces,
               const std::map<int, Eigen::Matrix2d>& frame, DisplacementSystem& system) {
  if (problem.loads.has_body_force() || problem.loads.traction_MPa)
    add_nodal(traces.forces(nodal_loads(problem, system.degree)), frame, system, system.b);
  if (!problem.loads.thermal.empty())
    add_nodal(traces.forces(thermal_forces(problem, system.degree)), frame, system, system.b);
}

}  // namespace

std::size_t DisplacementSystem::bytes() const {
  return K.bytes() + static_cast<std::size_t>(b.size() + given.u.size()) * sizeof(double) +
         unknown.size() * sizeof(unknown[0]);
}

DisplacementSystem assemble_displacement_system(const Problem& problem, int degree) {
  DisplacementSystem system;
  system.degree = degree;
  const CurvedTraces traces(problem, degree);
  system.control = control_points(problem, degree);
  system.given = traces.prescribed();
  const int n = number_unknowns(problem, system);
  const std::map<int, Eigen::Matrix2d> frame = frames(system);
  system.b = Eigen::VectorXd::Zero(n);
  system.K = ElementMatrices(2 * bernstein_count(degree));
  system.K.order = n;
  system.K.reserve(problem.mesh.triangles.size());
  add_triangles(problem, traces, frame, system);
  add_loads(problem, traces, frame, system);
  return system;
}

void set_load_case(const Problem& problem, DisplacementSystem& system) {
  const CurvedTraces traces(problem, system.degree);
  system.control = control_points(problem, system.degree);
  system.given = traces.prescribed();
  system.b.setZero();
  const std::map<int, Eigen::Matrix2d> frame = frames(system);
  subtract_known_forces(problem, traces, frame, system);
  add_loads(problem, traces, frame, system);
}

DisplacementField displacement_field(const Problem& problem, const DisplacementSystem& system,
                                     const Eigen::VectorXd& unknowns) {
  DisplacementField u = system.given.u;
  const auto set = [&](int node, auto&& components) {
    for (int k = 0; k < 2; ++k)
      if (const int number = system.unknown[node][k]; number != DisplacementSystem::prescribed)
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
  return CurvedTraces(problem, system.degree).coefficients(u);
}

Eigen::VectorXd unbalanced_forces(const Problem& problem, const DisplacementSystem& system,
                                  const NodalForces& of_stresses, const Eigen::VectorXd& F_C) {
  Eigen::VectorXd r = Eigen::VectorXd::Zero(system.b.size());
  add_nodal(CurvedTraces(problem, system.degree)
                .forces(nodal_loads(problem, system.degree) - of_stresses.sum),
            frames(system), system, r);
  r.tail(system.n_c()) += F_C;
  for (const auto& [node, row] : system.held_tangent) r(row) = 0;  // the roller bears it
  return r;
}

}  // namespace airybench
