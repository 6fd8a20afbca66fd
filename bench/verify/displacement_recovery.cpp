#include "bench/verify/displacement_recovery.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "assembly/edge_forces.hpp"
#include "bench/verify/vertex_stars.hpp"

namespace airybench {
namespace {

using LocalCoefficients = VertexStars::OfTriangle;

// L² projection of a stress that is linear on each third on linear fields; columns: corners.
Eigen::Matrix3d linear_stress(const ElementStress& stress) {
  // ∫ σ λ_i up to area/36, from moments with each third's linear functions; λ_i(centroid) = 1/3.
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (int t = 0; t < 3; ++t) {
    const Eigen::Matrix3d corners = stress.middleCols<3>(3 * t);
    const Eigen::Matrix3d own = corners.colwise() + corners.rowwise().sum();
    moments.col(t) += own.col(0);
    moments.col((t + 1) % 3) += own.col(1);
    moments.colwise() += own.col(2) / 3;
  }
  const Eigen::Vector3d sum = moments.rowwise().sum();
  return (moments.colwise() - sum / 4) / 3;
}

// A displacement with this linear strain (columns: corners) in polar form: u(p, p) is its value at
// p, u(p, q) the Bernstein coefficient of the edge pq. Points are relative to the centroid.
class IntegratedStrain {
 public:
  IntegratedStrain(const Eigen::Matrix3d& strain, const Eigen::Matrix<double, 2, 3>& gradients)
      : mean_(strain.rowwise().mean()), slope_(strain * gradients.transpose()) {}

  Eigen::Vector2d operator()(const Eigen::Vector2d& p, const Eigen::Vector2d& q) const {
    const Eigen::Vector2d middle = (p + q) / 2;
    const double xx = p.x() * q.x(), yy = p.y() * q.y(), xy = (p.x() * q.y() + p.y() * q.x()) / 2;
    return {mean_(0) * middle.x() + mean_(2) / 2 * middle.y() + slope_(0, 0) / 2 * xx +
                slope_(0, 1) * xy + (slope_(2, 1) - slope_(1, 0)) / 2 * yy,
            mean_(1) * middle.y() + mean_(2) / 2 * middle.x() + slope_(1, 1) / 2 * yy +
                slope_(1, 0) * xy + (slope_(2, 0) - slope_(0, 1)) / 2 * xx};
  }

 private:
  Eigen::Vector3d mean_;
  Eigen::Matrix<double, 3, 2> slope_;  // rows xx, yy, 2xy; columns ∂x, ∂y
};

struct Shape {
  Eigen::Matrix<double, 2, 3> corner, gradient;
};

Shape shape_of(const TriangleVertices& v) {
  Shape shape;
  const Eigen::Vector2d centroid = v.rowwise().mean();
  shape.corner = v.colwise() - centroid;
  const double twice_area = cross_area(v.col(0), v.col(1), v.col(2));
  for (int j = 0; j < 3; ++j) {
    const Eigen::Vector2d opposite = v.col((j + 2) % 3) - v.col((j + 1) % 3);
    shape.gradient.col(j) << -opposite.y() / twice_area, opposite.x() / twice_area;
  }
  return shape;
}

// Adds to w the rigid motion that fits its edge moments to the given ones (least squares).
void set_rigid_motion(const Problem& problem, int triangle, const Shape& shape,
                      const Eigen::MatrixXd& edge_moments, LocalCoefficients& w) {
  Eigen::Vector2d translation = Eigen::Vector2d::Zero();
  double turned = 0, spread = 0;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    const auto& corners = problem.mesh.triangles[triangle];
    const auto moments = edge_moments.col(problem.edges.of_triangle[triangle][k]);
    for (const bool at_start : {true, false}) {
      const int here = at_start ? k : next, there = at_start ? next : k;
      const bool low = corners[here] < corners[there];
      const Eigen::Vector2d missing =
          moments.segment<2>(low ? 0 : 2) - (w.col(here) / 2 + w.col(3 + k) / 3 + w.col(there) / 6);
      const Eigen::Vector2d arm = (2 * shape.corner.col(here) + shape.corner.col(there)) / 3;
      translation += missing / 6;
      turned += arm.x() * missing.y() - arm.y() * missing.x();
      spread += arm.squaredNorm();
    }
  }
  const double rotation = turned / spread;
  for (int m = 0; m < 6; ++m) {
    const Eigen::Vector2d x =
        m < 3 ? Eigen::Vector2d(shape.corner.col(m))
              : Eigen::Vector2d((shape.corner.col(m - 3) + shape.corner.col((m - 2) % 3)) / 2);
    w.col(m) += translation + rotation * Eigen::Vector2d(-x.y(), x.x());
  }
}

LocalCoefficients local_displacement(const Problem& problem, int triangle, const Shape& shape,
                                     const ElementStress& stress,
                                     const Eigen::MatrixXd& edge_moments) {
  const IntegratedStrain u(problem.compliance_of(triangle) * linear_stress(stress), shape.gradient);
  LocalCoefficients w;
  for (int k = 0; k < 3; ++k) {
    w.col(k) = u(shape.corner.col(k), shape.corner.col(k));
    w.col(3 + k) = u(shape.corner.col(k), shape.corner.col((k + 1) % 3));
  }
  set_rigid_motion(problem, triangle, shape, edge_moments, w);
  return w;
}

// Diagonal of the triangle's stiffness per node, the mean of x and y.
Eigen::Matrix<double, 6, 1> stiffnesses(const Problem& problem, int triangle, const Shape& shape) {
  const Eigen::Matrix3d& c = problem.compliance_of(triangle);
  const double along = c(0, 0) / (c(0, 0) * c(0, 0) - c(0, 1) * c(0, 1)), shear = 1 / c(2, 2);
  const double factor = 2. / 3 * problem.area_mm2(triangle) * (along + shear) / 2;
  Eigen::Matrix<double, 6, 1> stiffness;
  for (int k = 0; k < 3; ++k) {
    const auto &g = shape.gradient.col(k), &h = shape.gradient.col((k + 1) % 3);
    stiffness(k) = factor * g.squaredNorm();
    stiffness(3 + k) = factor * (g.squaredNorm() + h.squaredNorm() + g.dot(h));
  }
  return stiffness;
}

// Half the gradient of ‖σ − Aε(w)‖², N: Σ K_e (w − w_e) with the displacements w_e in `own`.
Eigen::Matrix2Xd half_gradient(const Problem& problem, const std::vector<LocalCoefficients>& own,
                               const DisplacementField& w) {
  std::vector<Eigen::Matrix3d> elasticity;
  for (const Eigen::Matrix3d& compliance : problem.compliance)
    elasticity.push_back(elasticity_of(compliance));
  Eigen::Matrix2Xd gradient = Eigen::Matrix2Xd::Zero(2, w.cols());
  for (int t = 0; t < static_cast<int>(own.size()); ++t) {
    const std::array<int, 6> nodes = triangle_nodes(problem, t);
    LocalCoefficients difference;
    for (int m = 0; m < 6; ++m) difference.col(m) = w.col(nodes[m]) - own[t].col(m);
    const QuadraticStrain strain = quadratic_strain(problem.vertices_of(t));
    Eigen::Matrix3d corners;
    corners.reshaped() = strain.lazyProduct(difference.reshaped());
    const Eigen::Matrix3d dual = problem.area_mm2(t) / 12 *
                                 elasticity[problem.mesh.triangle_body[t]] *
                                 (corners.colwise() + corners.rowwise().sum());
    LocalCoefficients force;
    force.reshaped() = strain.transpose().lazyProduct(dual.reshaped());
    for (int m = 0; m < 6; ++m) gradient.col(nodes[m]) += force.col(m);
  }
  return gradient;
}

struct Barrier {
  Eigen::Vector2d normal;
  double limit;
  double excess(const Eigen::Vector2d& w) const { return normal.dot(w) - limit; }
};
struct ContactNode {
  std::vector<Barrier> walls;  // one or two
  ContactOffset offset;
  Eigen::Vector2d force = {0, 0};                             // ∫ σn B over Γ_C, N
  double friction = std::numeric_limits<double>::infinity();  // smallest μ of its edges
};

std::map<int, ContactNode> contact_nodes(const DualSystem& system, const Eigen::VectorXd& F_C) {
  constexpr std::array<double, 3> of_start = {1. / 2, 1. / 3, 1. / 6};  // (2/L) ∫ N B over an edge
  const Problem& problem = *system.problem;
  const int m = system.contact.components;
  std::map<int, ContactNode> contact;
  for (int point = 0; point < system.contact.count; point += 2) {
    const int row = system.contact.boundary[point];
    const std::array<int, 3> nodes = boundary_nodes(problem, row);
    const EdgeFrame at_start = problem.frame_of_moment(row, 0),
                    at_end = problem.frame_of_moment(row, 1);
    const auto force_at = [&](int end, const EdgeFrame& frame) -> Eigen::Vector2d {
      const int p = m * (point + end);
      return F_C(p) * frame.normal + (m == 2 ? F_C(p + 1) : 0) * frame.tangent;
    };
    const Eigen::Vector2d start = force_at(0, at_start), end = force_at(1, at_end);
    const std::array<ContactOffset, 3> offset = problem.offset_coefficients(row);
    const WallDetail detail = problem.wall_detail_at(row);
    for (int k = 0; k < 3; ++k) {
      ContactNode& node = contact[nodes[k]];
      node.offset = offset[k];
      const Eigen::Vector2d normal = problem.frame_at_node(row, k).normal;
      node.walls.push_back(
          {normal, offset[k].gap_mm - detail.lowered_mm[k] - normal.dot(offset[k].motion_mm)});
      node.friction = std::min(node.friction, system.contact.friction_at(point));
      node.force += of_start[k] * start + of_start[2 - k] * end;
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

class Constraints {
 public:
  Constraints(const DualSystem& system, const Eigen::VectorXd& F_C)
      : given_(prescribed_displacement(*system.problem)), contact_(contact_nodes(system, F_C)) {}

  std::vector<bool> nodes() const {
    std::vector<bool> nodes = given_.at;
    for (const auto& [node, normal] : given_.normal) nodes[static_cast<std::size_t>(node)] = true;
    for (const auto& [node, contact] : contact_) nodes[static_cast<std::size_t>(node)] = true;
    return nodes;
  }

  // stiffness: per node, k of in_contact().
  void apply(const Eigen::VectorXd& stiffness, DisplacementField& w) const {
    for (Eigen::Index node = 0; node < w.cols(); ++node)
      if (given_.at[static_cast<std::size_t>(node)]) w.col(node) = given_.u.col(node);
    for (const auto& [node, n] : given_.normal)
      w.col(node) += given_.u.col(node) - n * n.dot(w.col(node));
    for (const auto& [number, node] : contact_) {
      if (given_.at[static_cast<std::size_t>(number)]) continue;
      if (const auto roller = given_.normal.find(number); roller != given_.normal.end())
        move_along_roller(roller->second, node.walls, w.col(number));
      else
        w.col(number) = in_contact(node, stiffness(number), w.col(number));
    }
  }

 private:
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

}  // namespace

DisplacementField recovered_displacement(const DualSystem& system, const StressField& stress,
                                         const Eigen::VectorXd& F_C,
                                         const Eigen::MatrixXd& edge_moments) {
  constexpr double damping = 0.6;  // of the Jacobi step
  const Problem& problem = *system.problem;
  const int nodes = displacement_nodes(problem);
  std::vector<LocalCoefficients> own(stress.size());
  DisplacementField w = DisplacementField::Zero(2, nodes);
  Eigen::VectorXd stiffness = Eigen::VectorXd::Zero(nodes);
  for (int t = 0; t < static_cast<int>(stress.size()); ++t) {
    const Shape shape = shape_of(problem.vertices_of(t));
    own[t] = local_displacement(problem, t, shape, stress[t], edge_moments);
    const Eigen::Matrix<double, 6, 1> weight = stiffnesses(problem, t, shape);
    const std::array<int, 6> node = triangle_nodes(problem, t);
    for (int m = 0; m < 6; ++m) {
      w.col(node[m]) += weight(m) * own[t].col(m);
      stiffness(node[m]) += weight(m);
    }
  }
  w.array().rowwise() /= stiffness.transpose().array();
  const Constraints constraints(system, F_C);
  constraints.apply(stiffness, w);

  stiffness /= damping;
  w.array() -= half_gradient(problem, own, w).array().rowwise() / stiffness.transpose().array();
  constraints.apply(stiffness, w);
  if (VertexStars::are_needed(problem)) {
    VertexStars stars(problem, own, constraints.nodes());
    for (int sweep = 0; sweep < 2; ++sweep) stars.sweep(w);
  }
  return w;
}

DisplacementField admissible_displacement(const DualSystem& system, const Eigen::VectorXd& F_C,
                                          DisplacementField w) {
  const Problem& problem = *system.problem;
  Eigen::VectorXd stiffness = Eigen::VectorXd::Zero(w.cols());
  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t) {
    const auto weight = stiffnesses(problem, t, shape_of(problem.vertices_of(t)));
    const std::array<int, 6> node = triangle_nodes(problem, t);
    for (int m = 0; m < 6; ++m) stiffness(node[m]) += weight(m);
  }
  Constraints(system, F_C).apply(stiffness, w);
  return w;
}

}  // namespace airybench
