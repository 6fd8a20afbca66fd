#include "assembly/displacement_field.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "assembly/elements/edge_forces.hpp"
#include "assembly/elements/small_cholesky.hpp"

namespace airybench {
namespace {

// Nodes after the vertices: those of edges, those of triangles.
int first_on_edge(const Problem& problem, int p, int edge) {
  return static_cast<int>(problem.mesh.vertices.size()) + (p - 1) * edge;
}
int first_inside(const Problem& problem, int p, int triangle) {
  return first_on_edge(problem, p, problem.edges.count()) + (p - 1) * (p - 2) / 2 * triangle;
}

// Writes the p − 1 nodes of an edge, from its vertex `start` on.
template <typename Nodes>
void put_edge_nodes(const Problem& problem, int p, int edge, int start, Nodes nodes) {
  const int first = first_on_edge(problem, p, edge);
  const bool from_low = problem.edges.vertices[edge][0] == start;
  for (int i = 0; i < p - 1; ++i) nodes[i] = first + (from_low ? i : p - 2 - i);
}

// Holds n·u = d. Two rollers that are not parallel hold their common vertex fully.
void hold_along(const Eigen::Vector2d& n, double d, int node, PrescribedDisplacement& prescribed) {
  const auto [other, is_first] = prescribed.normal.try_emplace(node, n);
  if (is_first) {
    prescribed.u.col(node) = d * n;
    return;
  }
  const Eigen::Vector2d m = other->second;
  const double sine = m.x() * n.y() - m.y() * n.x();
  if (std::abs(sine) < straight_roller) return;
  // n·u = d and m·u = c:  u = (c (n_y, −n_x) + d (−m_y, m_x)) / (m × n)
  const double c = m.dot(prescribed.u.col(node));
  prescribed.u.col(node) << (c * n.y() - d * m.y()) / sine, (d * m.x() - c * n.x()) / sine;
  prescribed.at[node] = true;
  prescribed.normal.erase(other);
}

}  // namespace

namespace {

// Of B_α of degree d in B_β of degree d + 1: β_i/(d + 1) where β = α + e_i.
double elevation(const std::array<int, 3>& alpha, const std::array<int, 3>& beta) {
  int raised = -1, sum = 0;
  for (int i = 0; i < 3; ++i) {
    if (beta[i] < alpha[i]) return 0;
    if (beta[i] > alpha[i]) raised = i;
    sum += beta[i];
  }
  return static_cast<double>(beta[raised]) / sum;
}

}  // namespace

int displacement_nodes(const Problem& problem, int degree) {
  return first_inside(problem, degree, static_cast<int>(problem.mesh.triangles.size()));
}

int displacement_degree(const Problem& problem, const DisplacementField& u) {
  for (int p = 2; p <= highest_stress_degree + 1; ++p)
    if (displacement_nodes(problem, p) == u.cols()) return p;
  throw std::invalid_argument(
      "a displacement field of " + std::to_string(u.cols()) +
      " coefficients (allowed: " + std::to_string(displacement_nodes(problem)) +
      " for quadratic ones on this mesh, more for higher degrees)");
}

DisplacementTriangle::Nodes triangle_nodes(const Problem& problem, int p, int triangle) {
  DisplacementTriangle::Nodes nodes(static_cast<std::size_t>(bernstein_count(p)));
  for (int k = 0; k < 3; ++k) {
    nodes[k] = problem.mesh.triangles[triangle][k];
    put_edge_nodes(problem, p, problem.edges.of_triangle[triangle][k], nodes[k],
                   nodes.begin() + 3 + k * (p - 1));
  }
  std::iota(nodes.begin() + 3 * p, nodes.end(), first_inside(problem, p, triangle));
  return nodes;
}

template <int p>
std::array<int, p + 1> boundary_nodes(const Problem& problem, int row) {
  const auto [start, end] = problem.mesh.boundary[row].vertices;
  std::array<int, p + 1> nodes;
  nodes.front() = start;
  put_edge_nodes(problem, p, problem.edges.of_boundary[row], start, nodes.begin() + 1);
  nodes.back() = end;
  return nodes;
}

DisplacementTriangle::Displacement of_triangle(const Problem& problem, int degree,
                                               const DisplacementField& u, int triangle) {
  const auto nodes = triangle_nodes(problem, degree, triangle);
  DisplacementTriangle::Displacement local(2, nodes.size());
  for (std::size_t m = 0; m < nodes.size(); ++m)
    local.col(static_cast<Eigen::Index>(m)) = u.col(nodes[m]);
  return local;
}

Eigen::Matrix3d elasticity_of(const Eigen::Matrix3d& compliance) {
  Eigen::Matrix3d elasticity = Eigen::Matrix3d::Identity();
  SmallCholesky<double, 3>(compliance).solve(elasticity);
  return elasticity;
}

std::vector<Eigen::Matrix3d> elasticities(const Problem& problem) {
  std::vector<Eigen::Matrix3d> elasticity;
  for (const Eigen::Matrix3d& compliance : problem.compliance)
    elasticity.push_back(elasticity_of(compliance));
  return elasticity;
}

Eigen::Vector2d displacement_at(const Problem& problem, const DisplacementField& u, int triangle,
                                const Eigen::Vector3d& lambda) {
  const int p = displacement_degree(problem, u);
  const auto& element = DisplacementTriangle::of_degree(p);
  const auto local = of_triangle(problem, p, u, triangle);
  Eigen::Vector2d value = Eigen::Vector2d::Zero();
  for (int m = 0; m < element.nodes; ++m) {
    const auto& [a, b, c] = element.exponents[m];
    value += binomial(p, a) * binomial(p - a, b) * std::pow(lambda(0), a) * std::pow(lambda(1), b) *
             std::pow(lambda(2), c) * local.col(m);
  }
  return value;
}

// All Bernstein polynomials have the same mean.
Eigen::Vector2d mean_on_edge(const Problem& problem, const DisplacementField& u, int row) {
  return with_degree(displacement_degree(problem, u) - 1, [&](auto k) -> Eigen::Vector2d {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const int node : boundary_nodes<k + 1>(problem, row)) sum += u.col(node);
    return sum / (k + 2);
  });
}

// A coefficient is the motion's value at the coefficient's place.
DisplacementField with_motion(const Problem& problem, DisplacementField w, const Motion& motion) {
  const int p = displacement_degree(problem, w);
  const auto& x = problem.mesh.vertices;
  const auto vertices = static_cast<Eigen::Index>(x.size());
  for (Eigen::Index v = 0; v < vertices; ++v) w.col(v) += motion(x[v], static_cast<int>(v));
  for (int e = 0; e < problem.edges.count(); ++e) {
    const auto [a, b] = problem.edges.vertices[e];
    for (int i = 1; i < p; ++i)
      w.col(first_on_edge(problem, p, e) + i - 1) += motion(((p - i) * x[a] + i * x[b]) / p, a);
  }
  for (int t = 0; p > 2 && t < static_cast<int>(problem.mesh.triangles.size()); ++t) {
    const TriangleVertices v = problem.vertices_of(t);
    int node = first_inside(problem, p, t);
    for (int c = 1; c < p - 1; ++c)
      for (int b = 1; b < p - c; ++b)
        w.col(node++) +=
            motion(v * Eigen::Vector3d(p - b - c, b, c) / p, problem.mesh.triangles[t][0]);
  }
  return w;
}

Eigen::Matrix3Xd thermal_stress(const Problem& problem, int triangle, int k) {
  const Eigen::Vector3d of_one =
      elasticity_of(problem.compliance_of(triangle)) * Eigen::Vector3d(1, 1, 0);
  const TriangleVertices v = problem.vertices_of(triangle);
  Eigen::Matrix3Xd stress(3, bernstein_count(k));
  for (int c = 0; c <= k; ++c)
    for (int b = 0; b <= k - c; ++b)
      stress.col(ring_place(k, b, c)) =
          problem.thermal_strain(triangle).at(v * Eigen::Vector3d(k - b - c, b, c) / k) * of_one;
  return stress;
}

namespace {

// Adds σ*, times a factor, to warm triangles.
void add_thermal_stress(const Problem& problem, double factor, StressField& field) {
  const auto& element = DisplacementTriangle::of_degree(field.degree() + 1);
  for (int t = 0; t < static_cast<int>(field.size()); ++t)
    if (problem.is_warm(t))
      field[t] +=
          factor * thermal_stress(problem, t, field.degree()).lazyProduct(element.on_thirds);
}

}  // namespace

double thermal_work(const Problem& problem, const StressField& stress) {
  if (problem.loads.thermal.empty()) return 0;
  StressField thermal(stress.size(), stress.degree());
  thermal.values().setZero();
  add_thermal_stress(problem, 1, thermal);
  double work = 0;
  for (int t = 0; t < static_cast<int>(stress.size()); ++t)
    if (problem.is_warm(t)) work += stress_product(problem, t, stress, thermal);
  return work;
}

DisplacementField elevated(const Problem& problem, const DisplacementField& u, int degree) {
  const int p = displacement_degree(problem, u);
  if (p >= degree) return u;
  const auto &lower = DisplacementTriangle::of_degree(p),
             &higher = DisplacementTriangle::of_degree(p + 1);
  DisplacementField result(2, displacement_nodes(problem, p + 1));
  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t) {
    const auto own = of_triangle(problem, p, u, t);
    const auto nodes = triangle_nodes(problem, p + 1, t);
    for (int m = 0; m < higher.nodes; ++m) {
      Eigen::Vector2d value = Eigen::Vector2d::Zero();
      for (int l = 0; l < lower.nodes; ++l)
        value += elevation(lower.exponents[l], higher.exponents[m]) * own.col(l);
      result.col(nodes[m]) = value;
    }
  }
  return elevated(problem, result, degree);
}

StressField stress_of_displacement(const Problem& problem, const DisplacementField& u) {
  StressField field = stress_of_strain(problem, u);
  add_thermal_stress(problem, -1, field);
  return field;
}

StressField stress_of_strain(const Problem& problem, const DisplacementField& u) {
  const auto& element = DisplacementTriangle::of_degree(displacement_degree(problem, u));
  const std::vector<Eigen::Matrix3d> elasticity = elasticities(problem);
  StressField field(problem.mesh.triangles.size(), element.degree - 1);
  for (int t = 0; t < static_cast<int>(field.size()); ++t) {
    const DisplacementTriangle::Strain stress =
        elasticity[problem.mesh.triangle_body[t]].lazyProduct(
            element.strain(TriangleShape(problem.vertices_of(t)).gradients,
                           of_triangle(problem, element.degree, u, t)));
    field[t] = stress.lazyProduct(element.on_thirds);
  }
  return field;
}

StressField own_stress(const Problem& problem, const DisplacementField& u) {
  const int degree = displacement_degree(problem, u) - 1;
  return stress_of_displacement(problem,
                                problem.round.empty() || sides_of_stresses(degree) == Sides::curves
                                    ? u
                                    : elevated(problem, u, degree + 2));
}

template <int p>
std::array<ContactOffset, p + 1> offset_coefficients(const Problem& problem, int row) {
  const auto [start, end] = problem.mesh.boundary[row].vertices;
  const auto &a = problem.mesh.vertices[start], &b = problem.mesh.vertices[end];
  std::array<double, p + 1> gap{}, slid{};
  if (const auto& g0 = problem.loads.gap_mm)
    gap = elevated<p>(edge_coefficients(g0(a, row), g0((a + b) / 2, row), g0(b, row)));
  if (const auto& s = problem.loads.slid_mm; s.rows() > p + 1)
    throw std::invalid_argument("slip of degree " + std::to_string(s.rows() - 1) +
                                " for displacements of degree " + std::to_string(p));
  else if (s.size() > 0)
    slid = elevated<p>(s.col(row));
  std::array<ContactOffset, p + 1> offsets;
  for (int i = 0; i <= p; ++i)
    offsets[i] = {gap[i], slid[i], problem.motion_at(a + i * (b - a) / p, start)};
  return offsets;
}

PrescribedDisplacement prescribed_displacement(const Problem& problem, int degree,
                                               const RollerNormal& roller_normal) {
  return with_degree(degree - 1, [&](auto stress_degree) {
    constexpr int p = stress_degree + 1;
    const int count = displacement_nodes(problem, p);
    PrescribedDisplacement prescribed{std::vector<bool>(static_cast<std::size_t>(count), false),
                                      {},
                                      DisplacementField::Zero(2, count)};
    const auto& u0 = problem.loads.displacement_mm;
    for (const bool rollers : {true, false})  // full supports last: they win
      for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row) {
        if (problem.mesh.boundary[row].role != BoundaryRole::displacement ||
            problem.is_roller(row) != rollers)
          continue;
        const auto [start, end] = problem.mesh.boundary[row].vertices;
        const auto &a = problem.mesh.vertices[start], &b = problem.mesh.vertices[end];
        std::array<Eigen::Vector2d, 3> quadratic;
        quadratic.fill(Eigen::Vector2d::Zero());
        if (u0) quadratic = edge_coefficients(u0(a, row), u0((a + b) / 2, row), u0(b, row));
        const std::array<Eigen::Vector2d, p + 1> u = elevated<p>(quadratic);
        const std::array<int, p + 1> nodes = boundary_nodes<p>(problem, row);
        const EdgeFrame frame = edge_frame(a, b);
        for (int i = 0; i <= p; ++i) {
          if (rollers) {
            const Eigen::Vector2d n = roller_normal ? roller_normal(row, i) : frame.normal;
            hold_along(n, n.dot(u[i]), nodes[i], prescribed);
          } else {
            prescribed.at[nodes[i]] = true;
            prescribed.normal.erase(nodes[i]);
            prescribed.u.col(nodes[i]) = u[i];
          }
        }
      }
    return prescribed;
  });
}

#define AIRYBENCH_INSTANTIATE(k)                                                  \
  template std::array<int, (k) + 2> boundary_nodes<(k) + 1>(const Problem&, int); \
  template std::array<ContactOffset, (k) + 2> offset_coefficients<(k) + 1>(const Problem&, int);
AIRYBENCH_STRESS_DEGREES(AIRYBENCH_INSTANTIATE)
#undef AIRYBENCH_INSTANTIATE

}  // namespace airybench
