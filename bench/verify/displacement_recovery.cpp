#include "bench/verify/displacement_recovery.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "assembly/small_cholesky.hpp"
#include "bench/verify/own_displacement.hpp"
#include "bench/verify/vertex_stars.hpp"

namespace airybench {
namespace {

template <int k>
using Triangle = DisplacementTriangle<k + 1>;
template <int k>
using LocalCoefficients = typename Triangle<k>::Displacement;

// Adds to w the rigid motion that fits its edge moments to the given ones (least squares).
template <int k>
void set_rigid_motion(const Problem& problem, int triangle, const Eigen::MatrixXd& edge_moments,
                      LocalCoefficients<k>& w) {
  constexpr int p = k + 1;
  constexpr auto weight = [] {
    std::array<std::array<double, p + 1>, p> moment{};
    for (int j = 0; j < p; ++j)
      for (int i = 0; i <= p; ++i) moment[j][i] = edge_moment(k, j, p, i);
    return moment;
  }();
  const TriangleVertices v = problem.vertices_of(triangle);
  const Eigen::Matrix<double, 2, 3> corner = v.colwise() - v.rowwise().mean();
  const auto& corners = problem.mesh.triangles[triangle];
  Eigen::Vector2d translation = Eigen::Vector2d::Zero();
  double turned = 0, spread = 0;
  for (int e = 0; e < 3; ++e) {
    const int next = (e + 1) % 3;
    const bool from_low = corners[e] < corners[next];
    const auto given = edge_moments.col(problem.edges.of_triangle[triangle][e]);
    for (int j = 0; j <= k; ++j) {
      Eigen::Vector2d missing = given.segment<2>(2 * (from_low ? j : k - j));
      for (int i = 0; i <= p; ++i) missing -= weight[j][i] * w.col(Triangle<k>::on_edge(e, i));
      const Eigen::Vector2d arm =
          ((k + 1 - j) * corner.col(e) + (j + 1) * corner.col(next)) / (k + 2);
      translation += missing / (3 * (k + 1));
      turned += arm.x() * missing.y() - arm.y() * missing.x();
      spread += arm.squaredNorm();
    }
  }
  const double rotation = turned / spread;
  for (int m = 0; m < Triangle<k>::nodes; ++m) {
    const auto& [a, b, c] = Triangle<k>::exponents[m];
    const Eigen::Vector2d x = (a * corner.col(0) + b * corner.col(1) + c * corner.col(2)) / p;
    w.col(m) += translation + rotation * Eigen::Vector2d(-x.y(), x.x());
  }
}

// Diagonal of the triangle's stiffness per node, the mean of x and y.
template <int k>
Eigen::Matrix<double, Triangle<k>::nodes, 1> stiffnesses(const TriangleShape& shape,
                                                         const Eigen::Matrix3d& c) {
  static const auto diagonals = [] {
    Eigen::Matrix<double, Triangle<k>::nodes, 3> of_products;
    for (int i = 0; i < 3; ++i)
      of_products.col(i) = Triangle<k>::constants().stiffness[i].diagonal();
    return of_products;
  }();
  const double along = c(0, 0) / (c(0, 0) * c(0, 0) - c(0, 1) * c(0, 1)), shear = 1 / c(2, 2);
  const auto &g = shape.gradients.col(0), &h = shape.gradients.col(1);
  return shape.area_mm2 * (along + shear) / 2 *
         (g.squaredNorm() * diagonals.col(0) + h.squaredNorm() * diagonals.col(1) +
          2 * g.dot(h) * diagonals.col(2));
}

// Half the gradient of a triangle's ‖σ − Aε(w)‖², N: K_e (w − w_e) with its displacement w_e.
template <int k>
LocalCoefficients<k> half_gradient(const TriangleShape& shape, const Eigen::Matrix3d& elasticity,
                                   const LocalCoefficients<k>& own, const DisplacementField& w,
                                   const std::array<int, Triangle<k>::nodes>& nodes) {
  LocalCoefficients<k> difference;
  for (int m = 0; m < Triangle<k>::nodes; ++m) difference.col(m) = w.col(nodes[m]) - own.col(m);
  const typename Triangle<k>::Strain strain = Triangle<k>::strain(shape.gradients, difference),
                                     weighted = strain.lazyProduct(Triangle<k>::constants().mass);
  return Triangle<k>::forces(shape.gradients,
                             (shape.area_mm2 * elasticity).lazyProduct(weighted).eval());
}

// Calls visit(triangle, shape, elasticity, nodes) for all triangles.
template <int k, typename Visit>
void for_triangles(const Problem& problem, Visit visit) {
  const std::vector<Eigen::Matrix3d> elasticity = elasticities(problem);
  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t)
    visit(t, TriangleShape(problem.vertices_of(t)), elasticity[problem.mesh.triangle_body[t]],
          triangle_nodes<k + 1>(problem, t));
}

template <int k>
Eigen::Matrix2Xd half_gradient(const Problem& problem, const std::vector<LocalCoefficients<k>>& own,
                               const DisplacementField& w) {
  Eigen::Matrix2Xd gradient = Eigen::Matrix2Xd::Zero(2, w.cols());
  for_triangles<k>(
      problem, [&](int t, const TriangleShape& shape, const Eigen::Matrix3d& A, const auto& nodes) {
        const LocalCoefficients<k> force = half_gradient<k>(shape, A, own[t], w, nodes);
        for (int m = 0; m < Triangle<k>::nodes; ++m) gradient.col(nodes[m]) += force.col(m);
      });
  return gradient;
}

// Sets the inner coefficients to those that minimise ‖σ − Aε(w)‖ for the others: K_ii d = −f_i.
template <int k>
void set_inner(const Problem& problem, const std::vector<LocalCoefficients<k>>& own,
               DisplacementField& w) {
  constexpr int inner = Triangle<k>::inner, outer = Triangle<k>::outer;
  if constexpr (inner > 0)
    for_triangles<k>(problem, [&](int t, const TriangleShape& shape, const Eigen::Matrix3d& A,
                                  const auto& nodes) {
      Eigen::Matrix<double, 2 * inner, 1> step =
          half_gradient<k>(shape, A, own[t], w, nodes).template rightCols<inner>().reshaped();
      const SmallCholesky<double, 2 * inner> factor(
          Triangle<k>::template stiffness<outer, inner>(shape, A));
      if (!(factor.last_pivot() > 0)) return;
      factor.solve(step);
      for (int m = 0; m < inner; ++m) w.col(nodes[outer + m]) -= step.template segment<2>(2 * m);
    });
}

struct Barrier {
  Eigen::Vector2d normal;
  double limit;
  double excess(const Eigen::Vector2d& w) const { return normal.dot(w) - limit; }
};
// A node at a wall; or a node of one body and its partner of another, for the difference of their
// displacements.
struct ContactNode {
  static constexpr int none = -1;
  int partner = none;
  std::vector<Barrier> walls;  // one or two
  ContactOffset offset;
  Eigen::Vector2d force = {0, 0};                             // ∫ σn B over Γ_C, N
  double friction = std::numeric_limits<double>::infinity();  // smallest μ of its edges
};

template <int k>
std::map<int, ContactNode> contact_nodes(const DualSystem& system, const Eigen::VectorXd& F_C) {
  constexpr int p = k + 1;
  const Problem& problem = *system.problem;
  const int m = system.contact.components;
  std::map<int, ContactNode> contact;
  for (int point = 0; point < system.contact.count; point += k + 1) {
    const int row = system.contact.boundary[point], other = problem.opposite_of(row);
    if (problem.is_second_of_pair(row)) continue;
    const std::array<int, p + 1> nodes = boundary_nodes<p>(problem, row);
    std::array<Eigen::Vector2d, k + 1> force;
    for (int j = 0; j <= k; ++j) {
      const EdgeFrame frame = problem.frame_of_moment(row, k, j);
      const int at = m * (point + j);
      force[j] = F_C(at) * frame.normal + (m == 2 ? F_C(at + 1) : 0) * frame.tangent;
    }
    std::array<ContactOffset, p + 1> offset = offset_coefficients<p>(problem, row);
    if (other != Problem::no_row) {
      const std::array<int, p + 1> partners = boundary_nodes<p>(problem, other);
      const std::array<ContactOffset, p + 1> beyond = offset_coefficients<p>(problem, other);
      for (int i = 0; i <= p; ++i) {
        contact[nodes[i]].partner = partners[p - i];
        offset[i].gap_mm += beyond[p - i].gap_mm;
        offset[i].slid_mm += beyond[p - i].slid_mm;
        offset[i].motion_mm -= beyond[p - i].motion_mm;
      }
    }
    const std::array<double, p + 1> lowered = elevated<p>(problem.wall_detail_at(row).lowered_mm);
    for (int i = 0; i <= p; ++i) {
      ContactNode& node = contact[nodes[i]];
      node.offset = offset[i];
      const Eigen::Vector2d normal = frame_of_coefficient<p>(problem, row, i).normal;
      node.walls.push_back(
          {normal, offset[i].gap_mm - lowered[i] - normal.dot(offset[i].motion_mm)});
      node.friction = std::min(node.friction, system.contact.friction_at(point));
      for (int j = 0; j <= k; ++j) node.force += edge_moment(k, j, p, i) * force[j];
    }
  }
  return contact;
}

Eigen::Vector2d behind(const std::vector<Barrier>& walls, const Eigen::Vector2d& w) {
  const auto moved = [](const Barrier& wall, const Eigen::Vector2d& x) {
    return Eigen::Vector2d(x - std::max(0.0, wall.excess(x)) * wall.normal);
  };
  const Barrier &one = walls.front(), &other = walls.back();
  const Eigen::Vector2d &n = one.normal, &m = other.normal;
  const double sine = n.x() * m.y() - n.y() * m.x();
  if (std::abs(sine) < straight_roller) return moved(one, moved(other, moved(one, w)));
  if (const Eigen::Vector2d x = moved(one, w); other.excess(x) <= 0) return x;
  if (const Eigen::Vector2d x = moved(other, w); one.excess(x) <= 0) return x;
  return Eigen::Vector2d(one.limit * m.y() - other.limit * n.y(),
                         other.limit * n.x() - one.limit * m.x()) /
         sine;
}

// Minimises ½ k |w − w_0|² + F_n (w_n − g) + μ|F_n||Δ| + F_t Δ, Δ = w_t + ρ_t − s, behind the
// walls: both contact terms of e² plus the cost of moving w in the first term. A closed node moves
// to the wall, a sticking one back to its old place.
Eigen::Vector2d in_contact(const ContactNode& node, double k, const Eigen::Vector2d& w_0) {
  Eigen::Vector2d n = node.walls.front().normal;
  if (node.walls.size() == 2) n = (n + node.walls.back().normal).normalized();
  const Eigen::Vector2d t(-n.y(), n.x());
  const double slope = node.friction * std::abs(n.dot(node.force)) / k,
               at_rest = node.offset.along(n).y(), slid = t.dot(w_0 - node.force / k) - at_rest;
  const double w_n = n.dot(w_0 - node.force / k),
               w_t = at_rest + std::copysign(std::max(0.0, std::abs(slid) - slope), slid);
  return behind(node.walls, w_n * n + w_t * t);
}

// Of the Jacobi step: λmax grows like k + 3 (4.3, 5.1, 6.1, 7.2 on right triangles, ν = 0.3).
template <int k>
constexpr double damping = 2.4 / (k + 3);

class Constraints {
 public:
  template <int k>
  Constraints(std::integral_constant<int, k>, const DualSystem& system, const Eigen::VectorXd& F_C)
      : given_(prescribed_displacement(*system.problem, k + 1)),
        contact_(contact_nodes<k>(system, F_C)) {}

  std::vector<bool> nodes() const {
    std::vector<bool> nodes = given_.at;
    for (const auto& [node, normal] : given_.normal) nodes[static_cast<std::size_t>(node)] = true;
    for (const auto& [node, contact] : contact_) {
      nodes[static_cast<std::size_t>(node)] = true;
      if (contact.partner != ContactNode::none)
        nodes[static_cast<std::size_t>(contact.partner)] = true;
    }
    return nodes;
  }

  // stiffness: per node, k of in_contact().
  void apply(const Eigen::VectorXd& stiffness, DisplacementField& w) const {
    for (Eigen::Index node = 0; node < w.cols(); ++node)
      if (given_.at[static_cast<std::size_t>(node)]) w.col(node) = given_.u.col(node);
    for (const auto& [node, n] : given_.normal)
      w.col(node) += given_.u.col(node) - n * n.dot(w.col(node));
    for (const auto& [number, node] : contact_) {
      if (node.partner != ContactNode::none) {
        move_pair(number, node, stiffness, w);
        continue;
      }
      if (given_.at[static_cast<std::size_t>(number)]) continue;
      if (const auto roller = given_.normal.find(number); roller != given_.normal.end())
        move_along_roller(roller->second, node.walls, w.col(number));
      else
        w.col(number) = in_contact(node, stiffness(number), w.col(number));
    }
  }

 private:
  // Each takes the part of the change that its stiffness leaves it; along a roller only what takes
  // both apart.
  void move_pair(int one, const ContactNode& node, const Eigen::VectorXd& stiffness,
                 DisplacementField& w) const {
    const std::array<int, 2> nodes = {one, node.partner};
    std::array<double, 2> softness{};
    std::array<std::optional<Eigen::Vector2d>, 2> along;
    for (const int k : {0, 1}) {
      if (given_.at[static_cast<std::size_t>(nodes[k])]) continue;
      softness[k] = 1 / stiffness(nodes[k]);
      if (const auto roller = given_.normal.find(nodes[k]); roller != given_.normal.end())
        along[k] = Eigen::Vector2d(-roller->second.y(), roller->second.x());
    }
    const double both = softness[0] + softness[1];
    if (both == 0) return;
    const auto apart = [&] { return Eigen::Vector2d(w.col(nodes[0]) - w.col(nodes[1])); };
    if (!along[0] && !along[1]) {
      const Eigen::Vector2d before = apart(), change = in_contact(node, 1 / both, before) - before;
      for (const int k : {0, 1}) w.col(nodes[k]) += (k == 0 ? 1 : -1) * softness[k] / both * change;
      return;
    }
    for (const Barrier& wall : node.walls) {
      std::array<Eigen::Vector2d, 2> way;
      double yields = 0;
      for (const int k : {0, 1}) {
        const Eigen::Vector2d axis = along[k].value_or(wall.normal);
        way[k] = softness[k] * wall.normal.dot(axis) * axis;
        yields += wall.normal.dot(way[k]);
      }
      if (yields < straight_roller * straight_roller * both) continue;
      const double excess = std::max(0.0, wall.excess(apart()));
      w.col(nodes[0]) -= excess / yields * way[0];
      w.col(nodes[1]) += excess / yields * way[1];
    }
  }
  static void move_along_roller(const Eigen::Vector2d& normal, const std::vector<Barrier>& walls,
                                Eigen::Ref<Eigen::Vector2d> w) {
    const Eigen::Vector2d along(-normal.y(), normal.x());
    for (const Barrier& wall : walls)
      if (const double cosine = wall.normal.dot(along); std::abs(cosine) >= straight_roller)
        w -= std::max(0.0, wall.excess(w)) / cosine * along;
  }

  PrescribedDisplacement given_;
  std::map<int, ContactNode> contact_;
};

template <int k>
DisplacementField recovered(const DualSystem& system, const StressField& stress,
                            const Eigen::VectorXd& F_C, const Eigen::MatrixXd& edge_moments) {
  static const OwnDisplacement<k> own_displacement;
  const Problem& problem = *system.problem;
  const int nodes = displacement_nodes(problem, k + 1);
  std::vector<LocalCoefficients<k>> own(stress.size());
  DisplacementField w = DisplacementField::Zero(2, nodes);
  Eigen::VectorXd stiffness = Eigen::VectorXd::Zero(nodes);
  for (int t = 0; t < static_cast<int>(stress.size()); ++t) {
    const TriangleShape shape(problem.vertices_of(t));
    const Eigen::Matrix3d& compliance = problem.compliance_of(t);
    own[t] = own_displacement(shape, compliance, stress[t]);
    set_rigid_motion<k>(problem, t, edge_moments, own[t]);
    const Eigen::Matrix<double, Triangle<k>::nodes, 1> weight = stiffnesses<k>(shape, compliance);
    const auto node = triangle_nodes<k + 1>(problem, t);
    for (int m = 0; m < Triangle<k>::nodes; ++m) {
      w.col(node[m]) += weight(m) * own[t].col(m);
      stiffness(node[m]) += weight(m);
    }
  }
  w.array().rowwise() /= stiffness.transpose().array();
  const Constraints constraints(std::integral_constant<int, k>(), system, F_C);
  constraints.apply(stiffness, w);

  stiffness /= damping<k>;
  w.array() -= half_gradient<k>(problem, own, w).array().rowwise() / stiffness.transpose().array();
  constraints.apply(stiffness, w);
  if (need_vertex_stars(problem)) {
    const std::vector<bool> held = constraints.nodes();
    VertexStars<k> stars(problem, own, held);
    for (int sweep = 0; sweep < 2; ++sweep) stars.sweep(w);
  }
  set_inner<k>(problem, own, w);
  return w;
}

}  // namespace

DisplacementField recovered_displacement(const DualSystem& system, const StressField& stress,
                                         const Eigen::VectorXd& F_C,
                                         const Eigen::MatrixXd& edge_moments) {
  return with_degree(stress.degree(),
                     [&](auto k) { return recovered<k>(system, stress, F_C, edge_moments); });
}

DisplacementField admissible_displacement(const DualSystem& system, const Eigen::VectorXd& F_C,
                                          DisplacementField w) {
  const Problem& problem = *system.problem;
  return with_degree(displacement_degree(problem, w) - 1, [&](auto k) {
    Eigen::VectorXd stiffness = Eigen::VectorXd::Zero(w.cols());
    for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t) {
      const auto weight =
          stiffnesses<k>(TriangleShape(problem.vertices_of(t)), problem.compliance_of(t));
      const auto node = triangle_nodes<k + 1>(problem, t);
      for (std::size_t m = 0; m < node.size(); ++m)
        stiffness(node[m]) += weight(static_cast<Eigen::Index>(m));
    }
    Constraints(k, system, F_C).apply(stiffness, w);
    return w;
  });
}

}  // namespace airybench
