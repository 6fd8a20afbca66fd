#include "solvers/condensation/degree_system.hpp"

#include <limits>
#include <string>

#include "assembly/equilibrium_element.hpp"
#include "solvers/condensation/edge_unknowns.hpp"
#include "solvers/contact/condensed.hpp"
#include "solvers/direct/cholmod.hpp"

namespace airybench {
namespace {

// What differs by degree, behind functions of one type. Arrays as in EquilibriumElement, by
// columns.
struct Input {
  TriangleVertices vertices;
  const Eigen::Matrix3d& compliance;
  Eigen::Matrix3d particular;  // σ_p at the vertices
  bool loaded;
};
struct Kernels {
  // Returns the element's independence.
  double (*stiffness)(const Input& input, Eigen::MatrixXd& K, Eigen::VectorXd& f);
  // Returns ∫ σ:C:σ.
  double (*stress)(const Input& input, const Eigen::VectorXd& displacement,
                   Eigen::Matrix3Xd& stress, Eigen::VectorXd& forces);
};

template <int k>
typename EquilibriumElement<double, k>::Stress particular_of(const Input& input) {
  if (!input.loaded) return EquilibriumElement<double, k>::Stress::Zero();
  return linear_stress<k>(input.particular);
}

template <int k>
constexpr Kernels kernels = {
    [](const Input& input, Eigen::MatrixXd& K, Eigen::VectorXd& f) {
      const EquilibriumElement<double, k> element(input.vertices, input.compliance);
      K = element.stiffness();
      if (input.loaded)
        f = element.load(particular_of<k>(input));
      else
        f.setZero(K.rows());
      return element.independence();
    },
    [](const Input& input, const Eigen::VectorXd& displacement, Eigen::Matrix3Xd& stress,
       Eigen::VectorXd& forces) {
      const EquilibriumElement<double, k> element(input.vertices, input.compliance);
      const auto sigma = element.stress(displacement, particular_of<k>(input));
      stress = sigma;
      forces = element.edge_forces(sigma);
      return element.energy(sigma, sigma);
    }};

const Kernels& kernels_of(int degree) {
#define AIRYBENCH_CASE(k) \
  case k:                 \
    return kernels<k>;
  switch (degree) { AIRYBENCH_STRESS_DEGREES(AIRYBENCH_CASE) }
  throw std::invalid_argument("stresses of degree " + std::to_string(degree) + " (allowed: 1 to " +
                              std::to_string(highest_stress_degree) + ")");
}

void refuse_what_is_missing(const Problem& problem, int degree) {
  const std::string of_degree = "stresses of degree " + std::to_string(degree) + ": ";
  if (!problem.later_steps.empty() || !problem.loads.slid_mm.empty())
    throw std::invalid_argument(of_degree + "load steps (allowed: one step)");
  if (problem.contact_turns())
    throw std::invalid_argument(of_degree +
                                "a wall whose normal turns along an edge (allowed: flat walls)");
}

// (k + 1)/L ∫ B_j q ds, q with these Bernstein coefficients of degree 2.
template <typename Value>
Value moment_of_quadratic(int k, int j, const std::array<Value, 3>& q) {
  Value sum = 0 * q[0];
  for (int i = 0; i < 3; ++i)
    sum += (k + 1.) / (k + 3.) * binomial(k, j) * binomial(2, i) / binomial(k + 2, i + j) * q[i];
  return sum;
}

ContactPoints points_of_degree(const Problem& problem, int k) {
  ContactPoints contact;
  contact.components = problem.has_friction() ? 2 : 1;
  std::vector<double> gap;
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row) {
    if (problem.mesh.boundary[row].role != BoundaryRole::contact) continue;
    const Eigen::Vector2d normal = problem.frame_of_moment(row, 0).normal;
    const std::array<ContactOffset, 3> offset = problem.offset_coefficients(row);
    const std::array<Eigen::Vector2d, 3> along = {offset[0].along(normal), offset[1].along(normal),
                                                  offset[2].along(normal)};
    for (int j = 0; j <= k; ++j) {
      contact.boundary.push_back(row);
      if (contact.components == 2) contact.friction.push_back(problem.friction_at(row));
      if (!problem.has_gap()) continue;
      const Eigen::Vector2d moment = moment_of_quadratic(k, j, along);
      gap.insert(gap.end(), moment.data(), moment.data() + contact.components);
    }
  }
  contact.count = static_cast<int>(contact.boundary.size());
  contact.gap = Eigen::Map<Eigen::VectorXd>(gap.data(), static_cast<Eigen::Index>(gap.size()));
  return contact;
}

// Numbers all unknowns; returns how many there are.
int number_degree_unknowns(const Problem& problem, DegreeSystem& system) {
  const int points = system.degree + 1, components = system.contact.components;
  constexpr int prescribed = -1, unnumbered = -2;
  system.unknown.assign(static_cast<std::size_t>(problem.edges.count()),
                        std::vector<int>(static_cast<std::size_t>(2 * points), unnumbered));
  std::vector<bool> is_contact(static_cast<std::size_t>(problem.edges.count()), false);
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row) {
    const int edge = problem.edges.of_boundary[row];
    const EdgeCondition condition = problem.condition(row);
    is_contact[edge] = problem.mesh.boundary[row].role == BoundaryRole::contact;
    for (int j = 0; j < points; ++j)
      for (int i = 0; i < 2; ++i)
        if (condition.component[i] == Known::displacement)
          system.unknown[edge][2 * j + i] = prescribed;
  }
  int count = 0;
  for (int edge = 0; edge < problem.edges.count(); ++edge)
    for (int j = 0; j < 2 * points; ++j)
      if (system.unknown[edge][j] == unnumbered && !(is_contact[edge] && j % 2 < components))
        system.unknown[edge][j] = count++;
  for (int p = 0; p < system.contact.count; ++p)
    for (int i = 0; i < components; ++i)
      system.unknown[problem.edges.of_boundary[system.contact.boundary[p]]][2 * (p % points) + i] =
          count++;
  return count;
}

void note_given(const Problem& problem, DegreeSystem& system) {
  const int k = system.degree;
  system.given.setZero(2 * (k + 1), problem.edges.count());
  const auto& u0 = problem.loads.displacement_mm;
  for (int row = 0; u0 && row < static_cast<int>(problem.mesh.boundary.size()); ++row) {
    if (problem.mesh.boundary[row].role != BoundaryRole::displacement) continue;
    auto [start, end] = problem.mesh.boundary[row].vertices;
    const bool roller = problem.is_roller(row);
    const Eigen::Vector2d normal =
        edge_frame(problem.mesh.vertices[start], problem.mesh.vertices[end]).normal;
    if (!roller && start > end) std::swap(start, end);
    const auto &a = problem.mesh.vertices[start], &b = problem.mesh.vertices[end];
    const Eigen::Vector2d u_a = u0(a, row), u_m = u0((a + b) / 2, row), u_b = u0(b, row);
    const std::array<Eigen::Vector2d, 3> q = {u_a, 2 * u_m - (u_a + u_b) / 2, u_b};
    for (int j = 0; j <= k; ++j) {
      const Eigen::Vector2d moment = moment_of_quadratic(k, j, q);
      system.given.col(problem.edges.of_boundary[row]).segment<2>(2 * j) =
          roller ? Eigen::Vector2d(normal.dot(moment), 0) : moment;
    }
  }
}

// An element and how its edges' components make those of the system.
class Element {
 public:
  Element(const Problem& problem, const DegreeSystem& system, const std::vector<int>& rows, int t)
      : input{problem.vertices_of(t), problem.compliance_of(t), {}, problem.loads.has_body_force()},
        points_(system.degree + 1) {
    if (input.loaded)
      for (int i = 0; i < 3; ++i)
        input.particular.col(i) = problem.particular_stress(input.vertices.col(i));
    const auto& corner = problem.mesh.triangles[t];
    for (int e = 0; e < 3; ++e) {
      const int edge = problem.edges.of_triangle[t][e], row = rows[edge];
      const bool from_start = row != no_frame || corner[e] < corner[(e + 1) % 3];
      Eigen::Matrix2d frame = Eigen::Matrix2d::Identity();
      if (row != no_frame) {
        const EdgeFrame own = problem.frame_of_moment(row, 0);
        frame << own.normal, own.tangent;
      }
      for (int j = 0; j < points_; ++j) {
        const int place = from_start ? j : points_ - 1 - j;
        frames_.push_back(frame);
        for (int i = 0; i < 2; ++i) {
          unknown.push_back(system.unknown[edge][2 * place + i]);
          given.push_back(system.given(2 * place + i, edge));
        }
      }
    }
  }
  // x and y from the system's components, and back.
  void to_axes(Eigen::VectorXd& v) const {
    for (std::size_t p = 0; p < frames_.size(); ++p)
      v.segment<2>(2 * static_cast<int>(p)) =
          (frames_[p] * v.segment<2>(2 * static_cast<int>(p))).eval();
  }
  void from_axes(Eigen::VectorXd& v) const {
    for (std::size_t p = 0; p < frames_.size(); ++p)
      v.segment<2>(2 * static_cast<int>(p)) =
          (frames_[p].transpose() * v.segment<2>(2 * static_cast<int>(p))).eval();
  }
  void from_axes(Eigen::MatrixXd& K) const {
    for (std::size_t p = 0; p < frames_.size(); ++p) {
      if (frames_[p].isIdentity(0)) continue;
      const int at = 2 * static_cast<int>(p);
      K.middleCols<2>(at) = K.middleCols<2>(at).lazyProduct(frames_[p]).eval();
      K.middleRows<2>(at) = frames_[p].transpose().lazyProduct(K.middleRows<2>(at)).eval();
    }
  }
  // ū: what is given and the unknowns' values.
  Eigen::VectorXd displacement(const Eigen::VectorXd& u) const {
    Eigen::VectorXd local(static_cast<Eigen::Index>(given.size()));
    for (std::size_t i = 0; i < given.size(); ++i)
      local(static_cast<Eigen::Index>(i)) = unknown[i] < 0 ? given[i] : u(unknown[i]);
    to_axes(local);
    return local;
  }

  Input input;
  std::vector<int> unknown;
  std::vector<double> given;

 private:
  int points_;
  std::vector<Eigen::Matrix2d> frames_;
};

// Prescribed forces on Γ_F.
void add_degree_tractions(const Problem& problem, DegreeSystem& system) {
  const int k = system.degree;
  if (!problem.loads.traction_MPa) return;
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row) {
    if (problem.mesh.boundary[row].role != BoundaryRole::force) continue;
    const int edge = problem.edges.of_boundary[row];
    const auto [start, end] = problem.mesh.boundary[row].vertices;
    const EdgeFrame frame = edge_frame(problem.mesh.vertices[start], problem.mesh.vertices[end]);
    const auto traction_at = [&](int vertex) {
      return problem.loads.traction_MPa(problem.mesh.vertices[vertex], frame.normal, row);
    };
    const Eigen::Vector2d low = traction_at(problem.edges.vertices[edge][0]),
                          high = traction_at(problem.edges.vertices[edge][1]);
    for (int j = 0; j <= k; ++j) {
      const double s = static_cast<double>(j) / k;
      const Eigen::Vector2d force = frame.length_mm / (k + 1) * ((1 - s) * low + s * high);
      for (int i = 0; i < 2; ++i) system.b(system.unknown[edge][2 * j + i]) += force(i);
    }
  }
}

}  // namespace

DegreeSystem assemble_degree_system(const Problem& problem, int degree) {
  const Kernels& kernels = kernels_of(degree);
  refuse_what_is_missing(problem, degree);
  DegreeSystem system;
  system.degree = degree;
  system.contact = points_of_degree(problem, degree);
  const int n = number_degree_unknowns(problem, system);
  note_given(problem, system);
  system.b.setZero(n);
  const std::vector<int> rows = rows_in_frame(problem);
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixXd K;
  Eigen::VectorXd f;
  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t) {
    const Element element(problem, system, rows, t);
    constexpr double few_roundings = 100 * std::numeric_limits<double>::epsilon();
    if (!(kernels.stiffness(element.input, K, f) > few_roundings))
      throw Breakdown("degree " + std::to_string(degree) + ": triangle " + std::to_string(t + 1) +
                      ": its flexibility is not positive definite to rounding");
    element.from_axes(K);
    element.from_axes(f);
    const auto size = static_cast<int>(element.unknown.size());
    for (int i = 0; i < size; ++i) {
      const int row = element.unknown[i];
      if (row < 0) continue;
      system.b(row) -= f(i);
      for (int j = 0; j < size; ++j) {
        const int column = element.unknown[j];
        if (column < 0)
          system.b(row) -= K(i, j) * element.given[j];
        else if (column <= row)
          entries.emplace_back(row, column, K(i, j));
      }
    }
  }
  system.K.resize(n, n);
  system.K.setFromTriplets(entries.begin(), entries.end());
  add_degree_tractions(problem, system);
  return system;
}

DegreeAnswer solve_degree_system(const Problem& problem, const DegreeSystem& system) {
  const int n_c = system.contact.size();
  DegreeAnswer answer;
  CholmodFactor factor;
  factor.analyse(system.K, n_c);
  factor.factor(system.K);
  answer.u = system.b;
  factor.solve_in_place(answer.u);
  answer.contact_converged = true;
  if (n_c > 0) {
    answer.condensed = {factor.inverse_of_schur(), -answer.u.tail(n_c), system.contact, {}};
    const ContactResult contact = solve_contact(answer.condensed);
    answer.F_C = contact.F_C;
    answer.contact_converged = contact.converged;
    answer.u = system.b;
    answer.u.tail(n_c) += answer.F_C;
    factor.solve_in_place(answer.u);
  }

  const Kernels& kernels = kernels_of(system.degree);
  const std::vector<int> rows = rows_in_frame(problem);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(answer.u.size()), forces;
  double largest = 0;
  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t) {
    const Element element(problem, system, rows, t);
    Eigen::Matrix3Xd& stress = answer.stress.emplace_back();
    answer.strain_energy_Nmm +=
        kernels.stress(element.input, element.displacement(answer.u), stress, forces) / 2;
    element.from_axes(forces);
    largest = std::max(largest, forces.cwiseAbs().maxCoeff());
    for (std::size_t i = 0; i < element.unknown.size(); ++i)
      if (element.unknown[i] >= 0) sum(element.unknown[i]) += forces(static_cast<Eigen::Index>(i));
  }
  DegreeSystem known;  // b of the known forces alone
  known.degree = system.degree;
  known.unknown = system.unknown;
  known.b.setZero(answer.u.size());
  add_degree_tractions(problem, known);
  if (n_c > 0) known.b.tail(n_c) += answer.F_C;
  answer.unbalanced = largest > 0 ? (sum - known.b).cwiseAbs().maxCoeff() / largest : 0;
  return answer;
}

}  // namespace airybench
