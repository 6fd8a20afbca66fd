#include "solvers/condensation/hybridized.hpp"

#include <algorithm>

#include "assembly/edge_forces.hpp"
#include "assembly/quad.hpp"
#include "assembly/sparse_bytes.hpp"
#include "solvers/condensation/hybrid_element.hpp"

namespace airybench {
namespace {

std::vector<bool> contact_edges(const Problem& problem) {
  std::vector<bool> is_contact(static_cast<std::size_t>(problem.edges.count()), false);
  for (std::size_t row = 0; row < problem.mesh.boundary.size(); ++row)
    is_contact[problem.edges.of_boundary[row]] =
        problem.mesh.boundary[row].role == BoundaryRole::contact;
  return is_contact;
}

using EdgeUnknowns = std::vector<std::array<int, 4>>;

// Numbers the unknowns of every edge; returns how many are inner ones.
int number_unknowns(const Problem& problem, const ContactPoints& contact, EdgeUnknowns& unknown) {
  const Mesh& mesh = problem.mesh;
  unknown.assign(static_cast<std::size_t>(problem.edges.count()), {0, 0, 0, 0});
  for (std::size_t row = 0; row < mesh.boundary.size(); ++row)
    if (mesh.boundary[row].role == BoundaryRole::displacement)
      unknown[problem.edges.of_boundary[row]].fill(HybridizedSystem::prescribed);
  // Contact unknowns are marked by −2 − row until the inner ones are counted.
  for (int p = 0; p < contact.count; ++p) {
    auto& edge = unknown[problem.edges.of_boundary[contact.boundary[p]]];
    const int end = p % 2;  // points come in pairs: start and end of an edge
    for (int k = 0; k < contact.components; ++k)
      edge[2 * end + k] = -2 - (contact.components * p + k);
  }
  int inner = 0;
  for (auto& edge : unknown)
    for (int& number : edge)
      if (number == 0) number = inner++;
  for (auto& edge : unknown)
    for (int& number : edge)
      if (number <= -2) number = inner + (-2 - number);
  return inner;
}

// ū0 per edge; empty: zero.
std::vector<Eigen::Vector4d> prescribed_displacements(const Problem& problem) {
  std::vector<Eigen::Vector4d> displacement;
  const auto& u0 = problem.loads.displacement_mm;
  if (!u0) return displacement;
  displacement.assign(static_cast<std::size_t>(problem.edges.count()), Eigen::Vector4d::Zero());
  for (std::size_t row = 0; row < problem.mesh.boundary.size(); ++row) {
    if (problem.mesh.boundary[row].role != BoundaryRole::displacement) continue;
    const int edge = problem.edges.of_boundary[row];
    const auto [low, high] = problem.edges.vertices[edge];
    const auto &a = problem.mesh.vertices[low], &b = problem.mesh.vertices[high];
    const auto [start, end] = edge_moments(u0(a), u0((a + b) / 2), u0(b));
    displacement[edge] << start, end;
  }
  return displacement;
}

// The prescribed forces on Γ_F into b.
template <typename Scalar>
void add_tractions(const Problem& problem, const EdgeUnknowns& unknown, Eigen::VectorX<Scalar>& b) {
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
      for (int k = 0; k < 2; ++k) b(unknown[edge][2 * end + k]) += force(k);
    }
  }
}

// The numbers of a triangle's twelve edge unknowns.
std::array<int, 12> element_unknowns(const Problem& problem, const EdgeUnknowns& unknown, int t) {
  std::array<int, 12> numbers;
  for (int k = 0; k < 3; ++k)
    std::copy_n(unknown[problem.edges.of_triangle[t][k]].begin(), 4, numbers.begin() + 4 * k);
  return numbers;
}

}  // namespace

template <typename Scalar>
std::size_t HybridizedSystemIn<Scalar>::bytes() const {
  return bytes_of(K) + static_cast<std::size_t>(b.size()) * sizeof(Scalar) +
         unknown.size() * sizeof(unknown[0]) + displacement.size() * sizeof(Eigen::Vector4d);
}

template <typename Scalar>
HybridizedSystemIn<Scalar> assemble_hybridized(const Problem& problem,
                                               const ContactPoints& contact) {
  HybridizedSystemIn<Scalar> system;
  system.n_c = contact.size();
  const int n = number_unknowns(problem, contact, system.unknown) + system.n_c;
  system.displacement = prescribed_displacements(problem);
  const std::vector<bool> is_contact = contact_edges(problem);
  system.b = Eigen::VectorX<Scalar>::Zero(n);
  std::vector<Eigen::Triplet<Scalar>> entries;
  entries.reserve(78 * problem.mesh.triangles.size());

  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t) {
    const auto element = make_hybrid_element<Scalar>(problem, is_contact, t);
    const std::array<int, 12> unknown = element_unknowns(problem, system.unknown, t);
    const Eigen::Matrix<Scalar, 12, 12> K = element.stiffness();
    Eigen::Matrix<Scalar, 12, 1> f = element.load();  // f_e + K_e ū0
    if (!system.displacement.empty())
      for (int k = 0; k < 3; ++k)
        f += K.template middleCols<4>(4 * k) *
             system.displacement[problem.edges.of_triangle[t][k]].template cast<Scalar>();

    for (int j = 0; j < 12; ++j) {
      const int column = unknown[j];
      if (column == HybridizedSystem::prescribed) continue;
      system.b(column) -= f(j);
      for (int i = 0; i < 12; ++i)
        if (unknown[i] >= column)  // the lower triangle, and nothing prescribed
          entries.emplace_back(unknown[i], column, K(i, j));
    }
  }
  add_tractions(problem, system.unknown, system.b);
  system.K.resize(n, n);
  system.K.setFromTriplets(entries.begin(), entries.end());
  return system;
}

template <typename Scalar>
StressField hybridized_stress(const Problem& problem, const HybridizedSystemIn<Scalar>& system,
                              const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& u) {
  const std::vector<bool> is_contact = contact_edges(problem);
  StressField field(problem.mesh.triangles.size());
  for (int t = 0; t < static_cast<int>(field.size()); ++t) {
    const std::array<int, 12> unknown = element_unknowns(problem, system.unknown, t);
    Eigen::Matrix<Scalar, 12, 1> local;
    for (int k = 0; k < 12; ++k) {
      const int edge = problem.edges.of_triangle[t][k / 4];
      if (unknown[k] != HybridizedSystem::prescribed)
        local(k) = u(unknown[k]);
      else
        local(k) = system.displacement.empty() ? 0 : system.displacement[edge](k % 4);
    }
    field[t] = make_hybrid_element<Scalar>(problem, is_contact, t)
                   .stress_at(local)
                   .template cast<double>();
  }
  return field;
}

UnbalancedForces unbalanced_forces(const Problem& problem, const HybridizedSystem& system,
                                   const StressField& stress, const Eigen::VectorXd& F_C) {
  const std::vector<bool> is_contact = contact_edges(problem);
  UnbalancedForces result;
  result.r.setZero(system.b.size());
  add_tractions(problem, system.unknown, result.r);
  result.r.tail(system.n_c) += F_C;
  for (int t = 0; t < static_cast<int>(stress.size()); ++t)
    for (int k = 0; k < 3; ++k) {
      const int edge = problem.edges.of_triangle[t][k];
      const Eigen::Vector4d forces =
          edge_components(problem.mesh, t, k, is_contact[edge]).transpose() *
          element_edge_forces(problem.vertices_of(t), stress[t], k).reshaped();
      result.largest = std::max(result.largest, forces.cwiseAbs().maxCoeff());
      for (int i = 0; i < 4; ++i)
        if (const int unknown = system.unknown[edge][i]; unknown != HybridizedSystem::prescribed)
          result.r(unknown) -= forces(i);
    }
  return result;
}

template struct HybridizedSystemIn<double>;
template HybridizedSystemIn<double> assemble_hybridized(const Problem&, const ContactPoints&);
template StressField hybridized_stress(const Problem&, const HybridizedSystemIn<double>&,
                                       const Eigen::VectorX<double>&);

template struct HybridizedSystemIn<long double>;
template HybridizedSystemIn<long double> assemble_hybridized(const Problem&, const ContactPoints&);
template StressField hybridized_stress(const Problem&, const HybridizedSystemIn<long double>&,
                                       const Eigen::VectorX<long double>&);

template struct HybridizedSystemIn<Quad>;
template HybridizedSystemIn<Quad> assemble_hybridized(const Problem&, const ContactPoints&);
template StressField hybridized_stress(const Problem&, const HybridizedSystemIn<Quad>&,
                                       const Eigen::VectorX<Quad>&);

}  // namespace airybench
