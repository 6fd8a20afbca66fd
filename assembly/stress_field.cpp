#include "assembly/stress_field.hpp"

#include <cmath>

#include "assembly/elements/curved_side.hpp"
#include "assembly/elements/edge_forces.hpp"
#include "assembly/elements/equilibrium_element.hpp"
#include "assembly/elements/stress_degrees.hpp"
#include "support/wide.hpp"

namespace airybench {
namespace {

// What is linear on the triangle, at the nine corners of its thirds.
template <typename Scalar>
ElementStressIn<Scalar> at_corners(const TriangleVertices& vertices, const auto& linear) {
  const Eigen::Matrix<Scalar, 2, 3> v = vertices.cast<Scalar>();
  const Eigen::Vector3<Scalar> centre = linear((v.col(0) + v.col(1) + v.col(2)) / Scalar(3));
  ElementStressIn<Scalar> corners;
  for (int t = 0; t < 3; ++t)
    corners.template middleCols<3>(3 * t) << linear(v.col(t)), linear(v.col((t + 1) % 3)), centre;
  return corners;
}

}  // namespace

template <typename Scalar>
ElementStressIn<Scalar> particular_element_stress(const Problem& problem, int triangle) {
  return at_corners<Scalar>(problem.vertices_of(triangle), [&](const Eigen::Vector2<Scalar>& x) {
    return problem.particular_stress<Scalar>(x);
  });
}

template <typename Scalar>
void subtract_affine_part(const TriangleVertices& v, const EdgeSigns& outward,
                          Eigen::Matrix<Scalar, 12, 1>& local) {
  const Eigen::Vector2<Scalar> slope =
      (local.template segment<2>(1) + local.template segment<2>(4) + local.template segment<2>(7)) /
      3;
  const Scalar value = (local(0) + local(3) + local(6)) / 3;
  const Eigen::Matrix<Scalar, 2, 3> corners = v.cast<Scalar>();
  const Eigen::Vector2<Scalar> centroid = corners.rowwise().mean();
  for (int k = 0; k < 3; ++k) {
    local(3 * k) -= value + slope.dot(corners.col(k) - centroid);
    local.template segment<2>(3 * k + 1) -= slope;
    local(9 + k) -= outward[k] * slope.dot(edge_frame<Scalar>(v.col(k), v.col((k + 1) % 3)).normal);
  }
}

template <typename Scalar>
ElementStressIn<Scalar> stress_dual(const Eigen::Matrix<Scalar, 3, 9>& stress,
                                    std::type_identity_t<Scalar> area_mm2,
                                    const Eigen::Matrix3<Data<Scalar>>& compliance) {
  // On a third of area a: ∫ λ_m λ_n = a (1 + δ_mn) / 12.
  const Eigen::Matrix3<Scalar> weight = area_mm2 / Scalar(36) * compliance.template cast<Scalar>();
  ElementStressIn<Scalar> dual;
  for (int t = 0; t < 3; ++t) {
    const Eigen::Matrix3<Scalar> corners = stress.template middleCols<3>(3 * t);
    dual.template middleCols<3>(3 * t) = weight * (corners.colwise() + corners.rowwise().sum());
  }
  return dual;
}

template <typename Scalar>
ElementStressIn<Scalar> thermal_dual(const Problem& problem, int triangle) {
  const ThermalStrain& thermal = problem.thermal_strain(triangle);
  const auto strain = [&](const Eigen::Vector2<Scalar>& x) -> Eigen::Vector3<Scalar> {
    const Scalar e = Scalar(thermal.at_origin) + thermal.slope_per_mm.cast<Scalar>().dot(x);
    return {e, e, Scalar(0)};
  };
  return stress_dual<Scalar>(at_corners<Scalar>(problem.vertices_of(triangle), strain),
                             problem.area_mm2<Scalar>(triangle), Eigen::Matrix3d::Identity());
}

StressField stress_of_airy_function(const Problem& problem, const Eigen::VectorXd& phi) {
  const auto vertices = static_cast<Eigen::Index>(problem.mesh.vertices.size());
  StressField field(problem.mesh.triangles.size());
  for (int t = 0; t < static_cast<int>(field.size()); ++t) {
    const TriangleVertices v = problem.vertices_of(t);
    const auto& corner = problem.mesh.triangles[t];
    Eigen::Matrix<double, 12, 1> local;
    for (int k = 0; k < 3; ++k) {
      local.segment<3>(3 * k) = phi.segment<3>(3 * corner[k]);
      local(9 + k) = phi(3 * vertices + problem.edges.of_triangle[t][k]);
    }
    const EdgeSigns outward = problem.edge_signs(t);
    subtract_affine_part(v, outward, local);
    const HctStress from_dofs = hct_stress(v, outward);
    field[t].reshaped() = from_dofs.lazyProduct(local);
    if (problem.loads.has_body_force()) field[t] += particular_element_stress(problem, t);
  }
  return field;
}

namespace {

template <int k>
double product(const double* sigma, const double* tau, double area_mm2, const Eigen::Matrix3d& C) {
  constexpr int n = bernstein_count(k);
  using OfThird = Eigen::Matrix<double, 3, n>;
  static const Eigen::Matrix<double, n, n> mass = bernstein_mass(k, 1.);
  double sum = 0;
  for (int t = 0; t < 3; ++t) {
    const OfThird strain = C.lazyProduct(Eigen::Map<const OfThird>(sigma + 3 * n * t));
    const OfThird weighted = Eigen::Map<const OfThird>(tau + 3 * n * t).lazyProduct(mass);
    sum += strain.cwiseProduct(weighted).sum();
  }
  return area_mm2 / 3 * sum;
}

int degree_of(const StressCoefficients& stress) {
  int degree = 1;
  while (3 * bernstein_count(degree) < stress.cols()) ++degree;
  return degree;
}

double curved_product(const TriangleVertices& v, double area_mm2, const CurvedSides& curves,
                      const StressCoefficients& sigma, const StressCoefficients& tau,
                      const Eigen::Matrix3d& C) {
  const int degree = degree_of(sigma);
  const Eigen::Index n = bernstein_count(degree);
  const Eigen::MatrixXd of_straight =
      std::sqrt(2 * area_mm2) *
      Eigen::Map<const Eigen::MatrixXd>(reference_matrices<double>(degree).mass_root, n, n);
  double sum = 0;
  for (int t = 0; t < 3; ++t) {
    const Eigen::MatrixXd root =
        (curves[t].is_straight()
             ? of_straight
             : CurvedThird<double>(curves[t], degree).mass_root(v.rowwise().mean()))
            .transpose();
    const auto weighted = [&](const StressCoefficients& stress) {
      return Eigen::Matrix3Xd(stress.middleCols(n * t, n).lazyProduct(root));
    };
    sum += C.lazyProduct(weighted(sigma)).cwiseProduct(weighted(tau)).sum();
  }
  return sum;
}

}  // namespace

double stress_product(const Problem& problem, int triangle, const StressCoefficients& sigma,
                      const StressCoefficients& tau) {
  const int degree = degree_of(sigma);
  if (const auto curves = problem.curves_of(triangle, degree))
    return curved_product(problem.vertices_of(triangle), problem.area_mm2(triangle), *curves, sigma,
                          tau, problem.compliance_of(triangle));
  return with_degree(degree, [&](auto k) {
    return product<k>(sigma.data(), tau.data(), problem.area_mm2(triangle),
                      problem.compliance_of(triangle));
  });
}

double stress_norm_squared(const Problem& problem, const StressField& stress) {
  double sum = 0;
  for (int t = 0; t < static_cast<int>(stress.size()); ++t)
    sum += stress_product(problem, t, stress, stress);
  return sum;
}

double stress_distance(const Problem& problem, const StressField& stress,
                       const StressField& other) {
  StressField difference = stress;
  difference.values() -= other.values();
  return std::sqrt(stress_norm_squared(problem, difference));
}

ForcesOnEdge element_edge_forces(const TriangleVertices& v, const StressCoefficients& stress,
                                 int k) {
  const int degree = degree_of(stress);
  const EdgeFrame frame = edge_frame(v.col(k), v.col((k + 1) % 3));
  ForcesOnEdge forces(2, degree + 1);
  for (int j = 0; j <= degree; ++j)
    forces.col(j) = frame.length_mm / (degree + 1) *
                    traction(stress.col(bernstein_count(degree) * k + j), frame.normal);
  return forces;
}

ForcesOnEdge curved_edge_forces(const TriangleVertices& v, const StressCoefficients& stress, int k,
                                const SideCurve& curve) {
  const int degree = degree_of(stress);
  const Eigen::Index n = bernstein_count(degree);
  const Eigen::VectorXd forces = CurvedSide<double>(curve, degree)
                                     .stress_forces(v.rowwise().mean())
                                     .lazyProduct(stress.middleCols(n * k, n).reshaped());
  return forces.reshaped(2, degree + 1);
}

template ElementStressIn<double> particular_element_stress(const Problem&, int);
template ElementStressIn<double> thermal_dual(const Problem&, int);
template ElementStressIn<double> stress_dual(const ElementStressIn<double>&, double,
                                             const Eigen::Matrix3d&);
template void subtract_affine_part(const TriangleVertices&, const EdgeSigns&,
                                   Eigen::Matrix<double, 12, 1>&);
template void subtract_affine_part(const TriangleVertices&, const EdgeSigns&,
                                   Eigen::Matrix<Wide, 12, 1>&);
template ElementStressIn<Wide> particular_element_stress(const Problem&, int);
template ElementStressIn<Wide> thermal_dual(const Problem&, int);
template ElementStressIn<Wide> stress_dual(const ElementStressIn<Wide>&, Wide,
                                           const Eigen::Matrix3d&);

}  // namespace airybench
