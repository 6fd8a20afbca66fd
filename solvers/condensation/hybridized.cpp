#include "solvers/condensation/hybridized.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include "assembly/edge_forces.hpp"

namespace airybench {
namespace {

using Matrix9x12 = Eigen::Matrix<double, 9, 12>;

// One triangle, with its edge components turned into those of HybridizedSystem::unknown.
struct HybridElement {
  HctStress stress;                                     // of the 12 unknowns
  Eigen::LLT<Eigen::Matrix<double, 9, 9>> flexibility;  // without vertex 1's three unknowns
  Matrix9x12 forces;                                    // T_eᵀ without them
  Eigen::Matrix<double, 9, 1> particular_load;          // p_e without them
  Eigen::Matrix<double, 12, 1> particular_forces;       // F_p
  std::array<int, 12> unknown;                          // numbers in the system
};

// How the components of HybridizedSystem::unknown make an element's edge components: x, y at the
// start and at the end of its walk.
Eigen::Matrix4d edge_components(const Mesh& mesh, int triangle, int k, bool is_contact) {
  const auto& v = mesh.triangles[triangle];
  const int a = v[k], b = v[(k + 1) % 3];
  Eigen::Matrix4d q = Eigen::Matrix4d::Zero();
  if (is_contact) {
    const EdgeFrame frame = edge_frame(mesh.vertices[a], mesh.vertices[b]);
    q.block<2, 1>(0, 0) = q.block<2, 1>(2, 2) = frame.normal;
    q.block<2, 1>(0, 1) = q.block<2, 1>(2, 3) = frame.tangent;
  } else if (a < b) {
    q.setIdentity();
  } else {
    q.topRightCorner<2, 2>().setIdentity();
    q.bottomLeftCorner<2, 2>().setIdentity();
  }
  return q;
}

HybridElement make_element(const Problem& problem, const HybridizedSystem& system,
                           const std::vector<bool>& is_contact_edge, int t) {
  const TriangleVertices v = problem.vertices_of(t);
  const EdgeSigns outward = problem.edge_signs(t);
  const auto& compliance = problem.compliance_of(t);
  const double area = problem.area_mm2(t);
  HybridElement element;
  element.stress = hct_stress(v, outward);
  const HctFlexibility flexibility = hct_flexibility(element.stress, area, compliance);
  element.flexibility.compute(flexibility.bottomRightCorner<9, 9>());
  if (element.flexibility.info() != Eigen::Success)
    throw Breakdown("hybridized: triangle " + std::to_string(t + 1) +
                    ": its flexibility is not positive definite to rounding");

  const bool loaded = problem.loads.has_body_force();
  ElementStress particular = ElementStress::Zero();
  if (loaded) particular = particular_element_stress(problem, t);
  element.particular_load =
      loaded ? Eigen::Matrix<double, 9, 1>((element.stress.transpose() *
                                            stress_dual(particular, area, compliance).reshaped())
                                               .tail<9>())
             : Eigen::Matrix<double, 9, 1>(Eigen::Matrix<double, 9, 1>::Zero());

  Eigen::Matrix<double, 12, 12> T = Eigen::Matrix<double, 12, 12>::Zero();
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3, edge = problem.edges.of_triangle[t][k];
    const EdgeForces f = edge_forces(v.col(k), v.col(next), outward[k]);
    const Eigen::Matrix4d q = edge_components(problem.mesh, t, k, is_contact_edge[edge]);
    Eigen::Matrix<double, 4, 12> rows = Eigen::Matrix<double, 4, 12>::Zero();
    rows.middleCols<3>(3 * k) = f.leftCols<3>();
    rows.middleCols<3>(3 * next) = f.middleCols<3>(3);
    rows.col(9 + k) = f.col(6);
    T.middleRows<4>(4 * k) = q.transpose() * rows;
    element.particular_forces.segment<4>(4 * k) =
        q.transpose() * element_edge_forces(v, particular, k).reshaped();
    std::copy_n(system.unknown[edge].begin(), 4, element.unknown.begin() + 4 * k);
  }
  element.forces = T.rightCols<9>().transpose();
  return element;
}

std::vector<bool> contact_edges(const Problem& problem) {
  std::vector<bool> is_contact(static_cast<std::size_t>(problem.edges.count()), false);
  for (std::size_t row = 0; row < problem.mesh.boundary.size(); ++row)
    is_contact[problem.edges.of_boundary[row]] =
        problem.mesh.boundary[row].role == BoundaryRole::contact;
  return is_contact;
}

// Numbers the unknowns and sets the prescribed displacements; returns the number of inner unknowns.
int number_unknowns(const Problem& problem, const ContactPoints& contact,
                    HybridizedSystem& system) {
  const Mesh& mesh = problem.mesh;
  system.unknown.assign(static_cast<std::size_t>(problem.edges.count()), {0, 0, 0, 0});
  for (std::size_t row = 0; row < mesh.boundary.size(); ++row)
    if (mesh.boundary[row].role == BoundaryRole::displacement)
      system.unknown[problem.edges.of_boundary[row]].fill(HybridizedSystem::prescribed);
  // Contact unknowns are marked by −2 − row until the inner ones are counted.
  for (int p = 0; p < contact.count; ++p) {
    auto& edge = system.unknown[problem.edges.of_boundary[contact.boundary[p]]];
    const int end = p % 2;  // points come in pairs: start and end of an edge
    for (int k = 0; k < contact.components; ++k)
      edge[2 * end + k] = -2 - (contact.components * p + k);
  }
  int inner = 0;
  for (auto& edge : system.unknown)
    for (int& unknown : edge)
      if (unknown == 0) unknown = inner++;
  for (auto& edge : system.unknown)
    for (int& unknown : edge)
      if (unknown <= -2) unknown = inner + (-2 - unknown);
  return inner;
}

void prescribe_displacements(const Problem& problem, HybridizedSystem& system) {
  const auto& u0 = problem.loads.displacement_mm;
  if (!u0) return;
  system.displacement.assign(system.unknown.size(), Eigen::Vector4d::Zero());
  for (std::size_t row = 0; row < problem.mesh.boundary.size(); ++row) {
    if (problem.mesh.boundary[row].role != BoundaryRole::displacement) continue;
    const int edge = problem.edges.of_boundary[row];
    const auto [low, high] = problem.edges.vertices[edge];
    const auto &a = problem.mesh.vertices[low], &b = problem.mesh.vertices[high];
    const auto [start, end] = edge_moments(u0(a), u0((a + b) / 2), u0(b));
    system.displacement[edge] << start, end;
  }
}

// The prescribed forces on Γ_F into b.
void add_tractions(const Problem& problem, HybridizedSystem& system) {
  if (!problem.loads.traction_MPa) return;
  for (std::size_t row = 0; row < problem.mesh.boundary.size(); ++row) {
    if (problem.mesh.boundary[row].role != BoundaryRole::force) continue;
    const int edge = problem.edges.of_boundary[row];
    const auto [start, stop] = problem.mesh.boundary[row].vertices;
    const EdgeFrame frame = edge_frame(problem.mesh.vertices[start], problem.mesh.vertices[stop]);
    for (int end = 0; end < 2; ++end) {
      const auto& at = problem.mesh.vertices[problem.edges.vertices[edge][end]];
      const Eigen::Vector2d force =
          frame.length_mm / 2 * problem.loads.traction_MPa(at, frame.normal);
      for (int k = 0; k < 2; ++k) system.b(system.unknown[edge][2 * end + k]) += force(k);
    }
  }
}

}  // namespace

std::size_t HybridizedSystem::bytes() const {
  return static_cast<std::size_t>(K.nonZeros()) * (sizeof(double) + sizeof(int)) +
         static_cast<std::size_t>(K.cols() + 1) * sizeof(int) +
         static_cast<std::size_t>(b.size()) * sizeof(double) + unknown.size() * sizeof(unknown[0]) +
         displacement.size() * sizeof(Eigen::Vector4d);
}

HybridizedSystem assemble_hybridized(const Problem& problem, const ContactPoints& contact) {
  HybridizedSystem system;
  system.n_c = contact.size();
  const int n = number_unknowns(problem, contact, system) + system.n_c;
  prescribe_displacements(problem, system);
  const std::vector<bool> is_contact = contact_edges(problem);
  system.b = Eigen::VectorXd::Zero(n);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(78 * problem.mesh.triangles.size());

  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t) {
    const HybridElement element = make_element(problem, system, is_contact, t);
    const Matrix9x12 root = element.flexibility.matrixL().solve(element.forces);
    const Eigen::Matrix<double, 12, 12> K = root.transpose() * root;
    Eigen::Matrix<double, 12, 1> f = element.particular_forces;  // f_e + K_e ū0
    if (problem.loads.has_body_force())
      f -= element.forces.transpose() * element.flexibility.solve(element.particular_load);
    if (!system.displacement.empty())
      for (int k = 0; k < 3; ++k)
        f += K.middleCols<4>(4 * k) * system.displacement[problem.edges.of_triangle[t][k]];

    for (int j = 0; j < 12; ++j) {
      const int column = element.unknown[j];
      if (column == HybridizedSystem::prescribed) continue;
      system.b(column) -= f(j);
      for (int i = 0; i < 12; ++i)
        if (element.unknown[i] >= column)  // the lower triangle, and nothing prescribed
          entries.emplace_back(element.unknown[i], column, K(i, j));
    }
  }
  add_tractions(problem, system);
  system.K.resize(n, n);
  system.K.setFromTriplets(entries.begin(), entries.end());
  return system;
}

StressField hybridized_stress(const Problem& problem, const HybridizedSystem& system,
                              StiffnessFactor& factor,
                              const Eigen::VectorXd& contact_displacement) {
  const Eigen::VectorXd u = all_displacements(factor, contact_displacement);
  const std::vector<bool> is_contact = contact_edges(problem);
  StressField field(problem.mesh.triangles.size());
  for (int t = 0; t < static_cast<int>(field.size()); ++t) {
    const HybridElement element = make_element(problem, system, is_contact, t);
    Eigen::Matrix<double, 12, 1> local;
    for (int k = 0; k < 12; ++k) {
      const int edge = problem.edges.of_triangle[t][k / 4], unknown = element.unknown[k];
      if (unknown != HybridizedSystem::prescribed)
        local(k) = u(unknown);
      else
        local(k) = system.displacement.empty() ? 0 : system.displacement[edge](k % 4);
    }
    const Eigen::Matrix<double, 9, 1> phi =
        element.flexibility.solve(element.forces * local - element.particular_load);
    field[t].reshaped() = element.stress.rightCols<9>() * phi;
    if (problem.loads.has_body_force()) field[t] += particular_element_stress(problem, t);
  }
  return field;
}

}  // namespace airybench
