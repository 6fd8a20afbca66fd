#include "verify/displacement_recovery.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "assembly/curved_traces.hpp"
#include "verify/displacement_constraints.hpp"
#include "verify/own_displacement.hpp"
#include "verify/positive_definite.hpp"
#include "verify/vertex_stars.hpp"
#include "verify/zone_recovery.hpp"

namespace airybench {
namespace {

using Triangle = DisplacementTriangle;

// Adds to w the rigid motion that fits its edge moments to the given ones (least squares), those of
// straight sides if there are any.
void set_rigid_motion(const Problem& problem, const Triangle& element, int triangle,
                      const Eigen::MatrixXd& edge_moments, Triangle::Displacement& w) {
  const int p = element.degree, k = p - 1;
  const TriangleVertices v = problem.vertices_of(triangle);
  const Eigen::Matrix<double, 2, 3> corner = v.colwise() - v.rowwise().mean();
  const auto& corners = problem.mesh.triangles[triangle];
  const auto curves = problem.curves_of(triangle, k);
  const auto is_curved = [&](int e) { return curves && !(*curves)[e].is_straight(); };
  const bool all_curved = is_curved(0) && is_curved(1) && is_curved(2);
  int count = 0;
  Eigen::Vector2d missing_sum = Eigen::Vector2d::Zero(), arms = Eigen::Vector2d::Zero();
  double turned = 0, spread = 0;
  for (int e = 0; e < 3; ++e) {
    if (is_curved(e) && !all_curved) continue;
    const int next = (e + 1) % 3;
    const bool from_low = corners[e] < corners[next];
    const auto given = edge_moments.col(problem.edges.of_triangle[triangle][e]);
    for (int j = 0; j <= k; ++j) {
      Eigen::Vector2d missing = given.segment<2>(2 * (from_low ? j : k - j));
      for (int i = 0; i <= p; ++i)
        missing -= element.edge_moments(j, i) * w.col(element.on_edge(e, i));
      const Eigen::Vector2d arm =
          ((k + 1 - j) * corner.col(e) + (j + 1) * corner.col(next)) / (k + 2);
      ++count;
      missing_sum += missing;
      arms += arm;
      turned += arm.x() * missing.y() - arm.y() * missing.x();
      spread += arm.squaredNorm();
    }
  }
  const Eigen::Vector2d mean_arm = arms / count, mean = missing_sum / count;
  const double rotation =
      (turned - mean_arm.x() * missing_sum.y() + mean_arm.y() * missing_sum.x()) /
      (spread - count * mean_arm.squaredNorm());
  for (int m = 0; m < element.nodes; ++m) {
    const auto& [a, b, c] = element.exponents[m];
    const Eigen::Vector2d x =
        (a * corner.col(0) + b * corner.col(1) + c * corner.col(2)) / p - mean_arm;
    w.col(m) += mean + rotation * Eigen::Vector2d(-x.y(), x.x());
  }
}

// Diagonal of the triangle's stiffness per node, the mean of x and y.
std::array<double, Triangle::max_nodes> stiffnesses(const Triangle& element,
                                                    const TriangleShape& shape,
                                                    const Eigen::Matrix3d& c) {
  const double along = c(0, 0) / (c(0, 0) * c(0, 0) - c(0, 1) * c(0, 1)), shear = 1 / c(2, 2);
  const auto &g = shape.gradients.col(0), &h = shape.gradients.col(1);
  const double gg = g.squaredNorm(), hh = h.squaredNorm(), gh = 2 * g.dot(h);
  const auto& [D11, D22, D12] = element.products;
  std::array<double, Triangle::max_nodes> stiffness{};
  for (int m = 0; m < element.nodes; ++m)
    stiffness[m] =
        shape.area_mm2 * (along + shear) / 2 * (gg * D11(m, m) + hh * D22(m, m) + gh * D12(m, m));
  return stiffness;
}

// Of the x and y of nodes, columns.
Triangle::Displacement mapped(const Eigen::MatrixXd& map, const Triangle::Displacement& u) {
  return map.lazyProduct(u.reshaped()).reshaped(2, u.cols());
}

// Half the gradient of a triangle's ‖σ − Aε(w)‖², N: K_e (w − w_e) with its displacement w_e.
Triangle::Displacement half_gradient(const Triangle& element, const TriangleShape& shape,
                                     const Eigen::Matrix3d& elasticity,
                                     const Triangle::DisplacementRef& own,
                                     const DisplacementField& w, const Triangle::Nodes& nodes,
                                     const CurvedTraces::Map* curved) {
  Triangle::Displacement difference(2, element.nodes);
  for (int m = 0; m < element.nodes; ++m) difference.col(m) = w.col(nodes[m]) - own.col(m);
  if (curved) difference = mapped(curved->to_coefficients, difference);
  const Triangle::Strain weighted =
      element.strain(shape.gradients, difference).lazyProduct(element.mass);
  const Eigen::Matrix3d stiffness = shape.area_mm2 * elasticity;
  const Triangle::Displacement forces =
      element.forces(shape.gradients, stiffness.lazyProduct(weighted).eval());
  return curved ? mapped(curved->to_coefficients.transpose(), forces) : forces;
}

// K of w, or of its traces.
Triangle::Stiffness stiffness(const Triangle& element, const TriangleShape& shape,
                              const Eigen::Matrix3d& elasticity, const CurvedTraces::Map* curved) {
  const Triangle::Stiffness K = element.stiffness(shape, elasticity);
  return curved ? curved->of_traces(K) : K;
}

// Calls visit(triangle, shape, elasticity, nodes) for all triangles.
template <typename Visit>
void for_triangles(const Problem& problem, int degree, Visit visit) {
  const std::vector<Eigen::Matrix3d> elasticity = elasticities(problem);
  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t)
    visit(t, TriangleShape(problem.vertices_of(t)), elasticity[problem.mesh.triangle_body[t]],
          triangle_nodes(problem, degree, t));
}

// Sets the inner coefficients to those that minimise ‖σ − Aε(w)‖ for the others: K_ii d = −f_i.
void set_inner(const Problem& problem, const Triangle& element, const CurvedTraces& traces,
               const Eigen::Matrix2Xd& own, DisplacementField& w) {
  const int inner = element.inner, outer = element.outer;
  if (inner == 0) return;
  for_triangles(
      problem, element.degree,
      [&](int t, const TriangleShape& shape, const Eigen::Matrix3d& A,
          const Triangle::Nodes& nodes) {
        const auto of_triangle = own.middleCols(element.nodes * t, element.nodes);
        const CurvedTraces::Map* curved = traces.of(t);
        Eigen::MatrixXd step = half_gradient(element, shape, A, of_triangle, w, nodes, curved)
                                   .rightCols(inner)
                                   .reshaped();
        const Triangle::Stiffness K =
            curved ? stiffness(element, shape, A, curved).bottomRightCorner(2 * inner, 2 * inner)
                   : element.stiffness(shape, A, outer, inner);
        if (!solve_positive_definite(K, step)) return;
        for (int m = 0; m < inner; ++m)
          w.col(nodes[outer + m]) -= Eigen::Vector2d(step(2 * m), step(2 * m + 1));
      });
}

// Jacobi steps come in pairs. λmax grows like k + 3 (4.3, 5.1, 6.1, 7.2 on right triangles, ν =
// 0.3): the first of a pair is for the highest modes, which the second, for those in the middle,
// lets grow.
constexpr int jacobi_pairs = 3;
constexpr double first_damping(int k) { return 1.2 / (k + 3); }
constexpr double damping(int k) { return 2.4 / (k + 3); }

// Neighbours hold one another, so that single coefficients hardly move: in triangles whose height
// is below this share of their longest side, or whose bulk modulus is above so many shear moduli.
constexpr double thin = 0.2, incompressible = 1000;

bool is_stiff(const TriangleShape& shape, const Eigen::Matrix3d& compliance) {
  const auto &a = shape.B.col(0), &b = shape.B.col(1);
  const double longest = std::max({a.squaredNorm(), b.squaredNorm(), (a - b).squaredNorm()});
  return 2 * shape.area_mm2 < thin * longest || bulk_over_shear(compliance) > incompressible;
}

// A damped Jacobi step on ½ e².
struct JacobiStep {
  DisplacementField w;
  Eigen::Matrix2Xd gradient;  // before the step, of `distance`; N
  double distance_Nmm = 0;    // there: ½ Σ (w − w_T)ᵀ K_T (w − w_T)
  Eigen::VectorXd
      gain_Nmm;  // per node: what can be gained of it, by the step or in stiff triangles
};

class Recovery {
 public:
  Recovery(const ContactSystem& system, const StressField& stress, const Eigen::VectorXd& F_C,
           const Eigen::MatrixXd& edge_moments)
      : problem_(*system.problem),
        element_(Triangle::of_degree(stress.degree() + 1)),
        traces_(problem_, element_.degree, sides_of_stresses(stress.degree())),
        own_(2, element_.nodes * static_cast<Eigen::Index>(stress.size())),
        constraints_(system, traces_, F_C),
        stress_(stress) {
    const OwnDisplacement& own_displacement = OwnDisplacement::of_degree(stress.degree());
    const int nodes = displacement_nodes(problem_, element_.degree);
    w_ = DisplacementField::Zero(2, nodes);
    stiffness_ = Eigen::VectorXd::Zero(nodes);
    for (int t = 0; t < static_cast<int>(stress.size()); ++t) {
      const TriangleShape shape(problem_.vertices_of(t));
      const Eigen::Matrix3d& compliance = problem_.compliance_of(t);
      Triangle::StrainByThirds strained = stress[t];  // A ε(u)
      if (problem_.is_warm(t))
        strained += thermal_stress(problem_, t, stress.degree()).lazyProduct(element_.on_thirds);
      Triangle::Displacement own = own_displacement(shape, compliance, strained);
      set_rigid_motion(problem_, element_, t, edge_moments, own);
      if (const auto* curved = traces_.of(t)) own = mapped(curved->to_traces, own);
      own_.middleCols(element_.nodes * t, element_.nodes) = own;
      const auto weight = stiffnesses(element_, shape, compliance);
      const auto node = triangle_nodes(problem_, element_.degree, t);
      for (int m = 0; m < element_.nodes; ++m) {
        w_.col(node[m]) += weight[m] * own.col(m);
        stiffness_(node[m]) += weight[m];
      }
    }
    w_.array().rowwise() /= stiffness_.transpose().array();
    constraints_.apply(stiffness_, w_);
  }

  DisplacementField displacement() {
    const double first = first_damping(stress_.degree());
    w_ = step(first).w;
    for (int pair = 1; pair < jacobi_pairs; ++pair) {
      w_ = step().w;
      w_ = step(first).w;
    }
    if (need_vertex_stars(problem_)) {
      const std::vector<bool> held = constraints_.nodes();
      VertexStars stars(problem_, element_, traces_, own_, held);
      for (int sweep = 0; sweep < 2; ++sweep) stars.sweep(w_);
    }
    improve_where_needed();
    set_inner(problem_, element_, traces_, own_, w_);
    return traces_.coefficients(w_);
  }

 private:
  JacobiStep step() const { return step(damping(stress_.degree())); }
  JacobiStep step(double damping) const {
    const Eigen::VectorXd stiffness = stiffness_ / damping;
    JacobiStep result;
    result.gradient = Eigen::Matrix2Xd::Zero(2, w_.cols());
    result.gain_Nmm = Eigen::VectorXd::Zero(w_.cols());
    for_triangles(problem_, element_.degree,
                  [&](int t, const TriangleShape& shape, const Eigen::Matrix3d& A,
                      const Triangle::Nodes& nodes) {
                    const auto own = own_.middleCols(element_.nodes * t, element_.nodes);
                    const Triangle::Displacement force =
                        half_gradient(element_, shape, A, own, w_, nodes, traces_.of(t));
                    double distance = 0;
                    for (int m = 0; m < element_.nodes; ++m) {
                      result.gradient.col(nodes[m]) += force.col(m);
                      distance += force.col(m).dot(w_.col(nodes[m]) - own.col(m)) / 2;
                    }
                    result.distance_Nmm += distance;
                    if (is_stiff(shape, problem_.compliance_of(t)))
                      for (const int node : nodes)
                        result.gain_Nmm(node) += distance / element_.nodes;
                  });
    result.w = w_.array() - result.gradient.array().rowwise() / stiffness.transpose().array();
    constraints_.apply(stiffness, result.w);
    result.gain_Nmm.array() +=
        stiffness.array() / 2 * (result.w - w_).colwise().squaredNorm().transpose().array();
    return result;
  }

  // The last Jacobi step. Before it zones, while it would gain more than a share of the distance,
  // or this is of the size of the energy, which a step between slivers may not see. What is true
  // error stays in stiff triangles, too: a zone is worth another one only if it has lowered the
  // distance by far. The last step puts w behind the walls. A millionth of ‖σ‖ is not worth it.
  void improve_where_needed() {
    constexpr double share = 0.06, far = 10, large = 0.25, negligible = 1e-12;
    constexpr int max_zones = 4;
    const double energy_Nmm = stress_norm_squared(problem_, stress_) / 2;
    JacobiStep now = step();
    bool is_needed =
        (now.gain_Nmm.sum() > share * now.distance_Nmm || now.distance_Nmm > large * energy_Nmm) &&
        now.distance_Nmm > negligible * energy_Nmm;
    for (int zones = 1; is_needed; ++zones) {
      improve_zone_of(now);
      JacobiStep next = step();
      const bool is_better = next.distance_Nmm < now.distance_Nmm;  // NaN: no
      is_needed = is_better && zones < max_zones && far * next.distance_Nmm < now.distance_Nmm &&
                  next.gain_Nmm.sum() > share * next.distance_Nmm;
      if (is_better) now = std::move(next);
    }
    w_ = std::move(now.w);
  }

  // All nodes but those where together hardly anything is to be gained, and two rings of triangles.
  void improve_zone_of(const JacobiStep& next) {
    constexpr double hardly_anything = 0.01;  // of the distance
    constexpr int rings = 2;
    std::vector<int> by_gain(static_cast<std::size_t>(w_.cols()));
    std::iota(by_gain.begin(), by_gain.end(), 0);
    std::ranges::sort(by_gain, {}, [&](int node) { return next.gain_Nmm(node); });
    std::vector<bool> is_free(by_gain.size(), false);
    double sum = 0;
    for (const int node : by_gain)
      is_free[node] = (sum += next.gain_Nmm(node)) > hardly_anything * next.distance_Nmm;
    for (int ring = 0; ring < rings; ++ring) is_free = with_neighbours(is_free);
    std::vector<ZoneTriangle> zone;
    for_triangles(problem_, element_.degree,
                  [&](int t, const TriangleShape& shape, const Eigen::Matrix3d& A,
                      const Triangle::Nodes& nodes) {
                    if (std::ranges::any_of(nodes, [&](int node) { return is_free[node]; }))
                      zone.push_back({{nodes.begin(), nodes.end()},
                                      stiffness(element_, shape, A, traces_.of(t))});
                  });
    improve_zone(constraints_, zone, std::move(is_free), next.gradient, w_);
  }
  std::vector<bool> with_neighbours(const std::vector<bool>& chosen) const {
    std::vector<bool> wider = chosen;
    for (int t = 0; t < static_cast<int>(problem_.mesh.triangles.size()); ++t) {
      const auto nodes = triangle_nodes(problem_, element_.degree, t);
      if (std::ranges::any_of(nodes, [&](int node) { return chosen[node]; }))
        for (const int node : nodes) wider[node] = true;
    }
    for (const auto& [node, contact] : constraints_.contact())
      if (const int partner = contact.partner; partner != ContactNode::none)
        wider[node] = wider[partner] = wider[node] || wider[partner];
    return wider;
  }

  const Problem& problem_;
  const Triangle& element_;
  const CurvedTraces traces_;
  Eigen::Matrix2Xd own_;  // one triangle after another: w_T, as its traces
  DisplacementConstraints constraints_;
  const StressField& stress_;
  DisplacementField w_;        // its traces
  Eigen::VectorXd stiffness_;  // per node
};

}  // namespace

DisplacementField recovered_displacement(const ContactSystem& system, const Solution& answer) {
  const auto& [moments] = std::get<EdgeDisplacements>(answer.unknowns);
  return Recovery(system, answer.stress, answer.F_C, moments).displacement();
}

std::optional<DisplacementField> displacement_of_answer(const ContactSystem& system,
                                                        const Solution& answer) {
  if (const auto* const displacements = answer.as<Displacements>()) return displacements->w;
  if (answer.as<EdgeDisplacements>()) return recovered_displacement(system, answer);
  return {};
}

DisplacementField admissible_displacement(const ContactSystem& system, const Eigen::VectorXd& F_C,
                                          DisplacementField w) {
  const Problem& problem = *system.problem;
  const auto& element = Triangle::of_degree(displacement_degree(problem, w));
  Eigen::VectorXd stiffness = Eigen::VectorXd::Zero(w.cols());
  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t) {
    const auto weight =
        stiffnesses(element, TriangleShape(problem.vertices_of(t)), problem.compliance_of(t));
    const auto node = triangle_nodes(problem, element.degree, t);
    for (std::size_t m = 0; m < node.size(); ++m) stiffness(node[m]) += weight[m];
  }
  const CurvedTraces traces(problem, element.degree, sides_of_stresses(element.degree - 1));
  w = traces.traces(w);
  DisplacementConstraints(system, traces, F_C).apply(stiffness, w);
  return traces.coefficients(w);
}

}  // namespace airybench
