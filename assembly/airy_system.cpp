#include "assembly/airy_system.hpp"

#include "assembly/displacement_field.hpp"
#include "assembly/elements/edge_forces.hpp"
#include "assembly/flexibility.hpp"
#include "assembly/row_order.hpp"
#include "assembly/sparse_bytes.hpp"
#include "assembly/stress_field.hpp"

namespace airybench {
namespace {

struct ForceRows {
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> force;

  void add(const Eigen::Matrix<double, 1, 7>& values, const std::array<int, 7>& dofs, double f) {
    const int row = static_cast<int>(force.size());
    for (int k = 0; k < 7; ++k)
      if (dofs[k] != DofNumbering::gauge && values(k) != 0)
        entries.emplace_back(row, dofs[k], values(k));
    force.push_back(f);
  }
  void store(SparseRows& matrix, int n) const {
    matrix.resize(static_cast<Eigen::Index>(force.size()), n);
    matrix.setFromTriplets(entries.begin(), entries.end());
  }
  Eigen::VectorXd forces() const {
    return Eigen::Map<const Eigen::VectorXd>(force.data(), static_cast<Eigen::Index>(force.size()));
  }
};

struct EdgeFunctionals {
  int row;  // of Mesh::boundary
  std::array<Eigen::Vector2d, 2> end;
  EdgeFrame frame;
  EdgeForces forces;  // rows F^a_x, F^a_y, F^b_x, F^b_y
  std::array<int, 7> dofs;
};

EdgeFunctionals edge_functionals(const AirySystem& system, int row) {
  const Problem& problem = *system.problem;
  const auto [a, b] = problem.mesh.boundary[row].vertices;
  const auto &xa = problem.mesh.vertices[a], &xb = problem.mesh.vertices[b];
  EdgeFunctionals edge{row,
                       {xa, xb},
                       edge_frame(xa, xb),
                       edge_forces(xa, xb, a < b ? 1 : -1),
                       system.dofs.of_edge_walk(a, b, problem.edges.of_boundary[row])};
  for (int k = 0; k < 7; ++k)
    if (edge.dofs[k] != DofNumbering::gauge) edge.forces.col(k) *= system.scale(edge.dofs[k]);
  return edge;
}

template <typename Visit>
void for_each_edge(const AirySystem& system, BoundaryRole role, Visit visit) {
  const auto& boundary = system.problem->mesh.boundary;
  for (int row = 0; row < static_cast<int>(boundary.size()); ++row)
    if (boundary[row].role == role) visit(edge_functionals(system, row));
}

// The force of the particular stress at an end of the edge, N.
Eigen::Vector2d particular_force(const Problem& problem, const EdgeFunctionals& edge, int end) {
  if (!problem.loads.has_body_force()) return Eigen::Vector2d::Zero();
  return edge.frame.length_mm / 2 *
         traction(problem.particular_stress(edge.end[end]), edge.frame.normal);
}

void build_constraints(AirySystem& system) {
  const Problem& problem = *system.problem;
  const Loads& loads = problem.loads;
  ForceRows on_force, on_contact;

  const auto add_in_axes = [&](const EdgeFunctionals& edge) {
    for (int k = 0; k < 2; ++k) {
      Eigen::Vector2d f = -particular_force(problem, edge, k);
      if (loads.traction_MPa)
        f +=
            edge.frame.length_mm / 2 * loads.traction_MPa(edge.end[k], edge.frame.normal, edge.row);
      for (int i = 0; i < 2; ++i)
        if (!problem.free.pins_down(edge.row, k, i))
          on_force.add(edge.forces.row(2 * k + i), edge.dofs, f(i));
    }
  };
  const auto add_in_frame = [&](const EdgeFunctionals& edge) {
    const EdgeCondition condition = problem.condition(edge.row);
    if (!condition.in_frame) return;
    for (int k = 0; k < 2; ++k) {
      const auto rows = edge.forces.middleRows<2>(2 * k);
      const Eigen::Vector2d f = particular_force(problem, edge, k);
      const EdgeFrame frame = problem.frame_of_moment(edge.row, 1, k);
      for (int i = 0; i < 2; ++i) {
        const Eigen::Vector2d& axis = i == 0 ? frame.normal : frame.tangent;
        if (condition.component[i] == Known::contact_law)
          on_contact.add(axis.transpose().lazyProduct(rows), edge.dofs, axis.dot(f));
        else if (condition.component[i] == Known::force)
          on_force.add(axis.transpose().lazyProduct(rows), edge.dofs, -axis.dot(f));
      }
    }
  };
  for_each_boundary_row(problem.mesh, [&](int row) {
    const EdgeFunctionals edge = edge_functionals(system, row);
    if (problem.mesh.boundary[row].role == BoundaryRole::force)
      add_in_axes(edge);
    else
      add_in_frame(edge);
  });
  on_force.store(system.C_F, system.dofs.count);
  on_contact.store(system.C_C, system.dofs.count);
  if (loads.traction_MPa || loads.has_body_force()) system.F = on_force.forces();
  if (loads.has_body_force()) system.F0 = on_contact.forces();
}

// q_i = ∫_{Γ_D} u0·σ(φ_i)n − ∫ σ(φ_i):(C:σ_p + ε0).
void build_load(AirySystem& system) {
  const Problem& problem = *system.problem;
  const Loads& loads = problem.loads;
  const bool loaded = loads.has_body_force() || !loads.thermal.empty();
  if (!loads.displacement_mm && !loaded) return;
  system.q = Eigen::VectorXd::Zero(system.dofs.count);

  if (loads.displacement_mm) {
    for_each_edge(system, BoundaryRole::displacement, [&](const EdgeFunctionals& edge) {
      const Eigen::Vector4d u = problem.prescribed_moments(edge.row).reshaped();
      for (int k = 0; k < 7; ++k)
        if (edge.dofs[k] != DofNumbering::gauge)
          system.q(edge.dofs[k]) += u.dot(edge.forces.col(k));
    });
  }
  if (loaded) {
    for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t) {
      const TriangleVertices v = problem.vertices_of(t);
      const HctStress stress = hct_stress(v, problem.edge_signs(t));
      ElementStress dual = ElementStress::Zero();
      if (loads.has_body_force())
        dual += stress_dual(particular_element_stress(problem, t), problem.area_mm2(t),
                            problem.compliance_of(t));
      if (problem.is_warm(t)) dual += thermal_dual<double>(problem, t);
      const Eigen::Matrix<double, 12, 1> load = stress.transpose().lazyProduct(dual.reshaped());
      const auto dofs = system.dofs.of_triangle(problem, t);
      for (int k = 0; k < 12; ++k)
        if (dofs[k] != DofNumbering::gauge) system.q(dofs[k]) -= load(k) * system.scale(dofs[k]);
    }
  }
}

}  // namespace

std::size_t AirySystem::bytes() const {
  const auto vectors = scale.size() + q.size() + F.size() + F0.size();
  return ContactSystem::bytes() + bytes_of(S) + bytes_of(C_F) + bytes_of(C_C) +
         static_cast<std::size_t>(vectors) * sizeof(double) +
         (dofs.of_vertex.size() + dofs.of_edge.size()) * sizeof(int);
}

void AirySystem::set_load_case(std::shared_ptr<const Problem> load_case) {
  ContactSystem::set_load_case(std::move(load_case));
  for (Eigen::VectorXd* load : {&q, &F, &F0}) load->resize(0);
  build_constraints(*this);
  build_load(*this);
}

std::string why_no_airy_function(const Problem& problem) {
  const int holes = hole_count(problem.mesh);
  if (holes == 0) return "";
  return "a body with " + std::to_string(holes) + (holes == 1 ? " hole" : " holes") +
         " needs a multi-valued Airy function";
}

AirySystem airy_system(std::shared_ptr<const Problem> problem) {
  if (const std::string why = why_no_airy_function(*problem); !why.empty())
    throw std::invalid_argument(why);
  AirySystem system;
  system.ContactSystem::set_load_case(std::move(problem));
  {
    const NodeGraph graph = airy_node_graph(*system.problem);
    const std::vector<int> position = cuthill_mckee(graph);
    system.dofs = number_dofs(*system.problem, position);
    SparseColumns S = assemble_flexibility(*system.problem, system.dofs, graph, position);
    system.S.swap(S);
  }
  system.scale = equilibrate(system.S);
  build_constraints(system);
  build_load(system);
  return system;
}

Eigen::VectorXd airy_function(const AirySystem& system, const Eigen::VectorXd& x) {
  const DofNumbering& dofs = system.dofs;
  const auto vertices = static_cast<Eigen::Index>(dofs.of_vertex.size());
  const auto edges = static_cast<Eigen::Index>(dofs.of_edge.size());
  Eigen::VectorXd phi(3 * vertices + edges);
  for (Eigen::Index v = 0; v < vertices; ++v)
    for (int k = 0; k < 3; ++k) {
      const int dof = dofs.of_vertex[v];
      phi(3 * v + k) = dof == DofNumbering::gauge ? 0 : system.scale(dof + k) * x(dof + k);
    }
  for (Eigen::Index e = 0; e < edges; ++e) {
    const int dof = dofs.of_edge[e];
    phi(3 * vertices + e) = system.scale(dof) * x(dof);
  }
  return phi;
}

}  // namespace airybench
