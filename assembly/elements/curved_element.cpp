#include "assembly/elements/curved_element.hpp"

#include <cmath>

#include "assembly/elements/equilibrium_element.hpp"

namespace airybench {

template <typename Scalar>
CurvedElement<Scalar>::CurvedElement(const TriangleVertices& vertices,
                                     const Eigen::Matrix3d& compliance, const CurvedSides& sides,
                                     int degree)
    : third_(bernstein_count(degree)) {
  using Point = Eigen::Vector2<Scalar>;
  const int points = degree + 1;
  const Eigen::Matrix<Scalar, 2, 3> v = vertices.cast<Scalar>();
  const Point centroid = (v.col(0) + v.col(1) + v.col(2)) / Scalar(3);
  const ReferenceMatrices<Scalar>& reference = reference_matrices<Scalar>(degree);
  Eigen::Matrix2<Scalar> B;
  B << v.col(1) - v.col(0), v.col(2) - v.col(0);
  const Scalar determinant = B(0, 0) * B(1, 1) - B(0, 1) * B(1, 0);
  using std::sqrt;
  for (int t = 0; t < 3; ++t) {
    if (!sides[t].empty()) {
      const CurvedSide<Scalar> side(sides[t], degree);
      forces_[t] = side.stress_forces(centroid);
      mass_root_[t] = side.mass_root(centroid);
      continue;
    }
    mass_root_[t] =
        sqrt(determinant) * Eigen::Map<const Matrix>(reference.mass_root, third_, third_);
    const Point edge = (v.col((t + 1) % 3) - v.col(t)) / Scalar(points);
    forces_[t] = Matrix::Zero(2 * points, 3 * third_);
    for (int j = 0; j < points; ++j)  // from xx, yy, xy, with n = (y, −x)
      forces_[t].template block<2, 3>(2 * j, 3 * j) << edge.y(), 0, -edge.x(), 0, -edge.x(),
          edge.y();
  }
  compliance_root_ = SmallCholesky<Scalar, 3>(compliance.cast<Scalar>()).L().transpose();

  const Eigen::Matrix3<Scalar> to_stress = equilibrium_formulas::stress_map(B, determinant);
  const Eigen::Index coefficients = 3 * third_,
                     modes = with_degree(degree, [](auto k) { return StressDegree<k>::modes; });
  modes_.resize(3 * coefficients, modes);
  of_modes_.resize(3 * coefficients, modes);
  forces_of_modes_.resize(6 * points, modes);
  for (Eigen::Index mode = 0; mode < modes; ++mode) {
    Stress tau(3, coefficients);
    for (int x = 0; x < 3; ++x)
      tau.row(x) = Eigen::Map<const Vector>(reference.stress[x] + coefficients * mode, coefficients)
                       .transpose();
    const Stress stress = to_stress.lazyProduct(tau);
    modes_.col(mode) = stress.reshaped();
    of_modes_.col(mode) = weighted(stress);
    forces_of_modes_.col(mode) = edge_forces(stress);
  }
  root_ = GramRoot<Scalar>(of_modes_);
}

template <typename Scalar>
typename CurvedElement<Scalar>::Vector CurvedElement<Scalar>::weighted(const Stress& stress) const {
  Stress result(3, stress.cols());
  for (int t = 0; t < 3; ++t)
    result.middleCols(third_ * t, third_) =
        compliance_root_.lazyProduct(stress.middleCols(third_ * t, third_))
            .eval()
            .lazyProduct(mass_root_[t].transpose());
  return result.reshaped();
}

template <typename Scalar>
typename CurvedElement<Scalar>::OnEdges CurvedElement<Scalar>::edge_forces(
    const Stress& stress) const {
  const Eigen::Index per_edge = forces_[0].rows();
  OnEdges forces(3 * per_edge);
  for (int t = 0; t < 3; ++t)
    forces.segment(per_edge * t, per_edge) =
        forces_[t].lazyProduct(stress.middleCols(third_ * t, third_).reshaped());
  return forces;
}

// R⁻ᵀ Tᵀ, of all modes.
template <typename Scalar>
typename CurvedElement<Scalar>::Root CurvedElement<Scalar>::root() const {
  Matrix root = forces_of_modes_.transpose();
  for (Eigen::Index j = 0; j < root.cols(); ++j) root_.solve_lower(&root(0, j));
  return root;
}

template <typename Scalar>
void CurvedElement<Scalar>::square(const Root& R, Scalar* lower) {
  for (Eigen::Index j = 0; j < R.cols(); ++j)
    for (Eigen::Index i = j; i < R.cols(); ++i) *lower++ = R.col(i).dot(R.col(j));
}

template <typename Scalar>
void CurvedElement<Scalar>::subtract_outer_load(const Root& R, const Stress& particular,
                                                Scalar* forces) const {
  Vector y = of_modes_.transpose().lazyProduct(weighted(particular));
  root_.solve_lower(y.data());
  Eigen::Map<Vector>(forces, R.cols()) -= R.transpose().lazyProduct(y);
}

template <typename Scalar>
typename CurvedElement<Scalar>::Vector CurvedElement<Scalar>::excess_work(
    const OnEdges& displacement, const Stress& stress) const {
  return forces_of_modes_.transpose().lazyProduct(displacement) -
         of_modes_.transpose().lazyProduct(weighted(stress));
}

template <typename Scalar>
typename CurvedElement<Scalar>::Stress CurvedElement<Scalar>::of_modes(Vector work) const {
  root_.solve(work.data());
  return modes_.lazyProduct(work).reshaped(3, 3 * third_);
}

template <typename Scalar>
typename CurvedElement<Scalar>::Stress CurvedElement<Scalar>::stress(
    const OnEdges& displacement) const {
  return of_modes(forces_of_modes_.transpose().lazyProduct(displacement));
}

template <typename Scalar>
typename CurvedElement<Scalar>::Stress CurvedElement<Scalar>::stress(
    const OnEdges& displacement, const Stress& particular) const {
  return particular + of_modes(excess_work(displacement, particular));
}

template <typename Scalar>
typename CurvedElement<Scalar>::Defect CurvedElement<Scalar>::defect(const OnEdges& displacement,
                                                                     const Stress& total) const {
  const Vector g = excess_work(displacement, total);
  Vector correction = g;
  root_.solve(correction.data());
  return {edge_forces(of_modes(g)), g.dot(correction)};
}

template <typename Scalar>
Scalar CurvedElement<Scalar>::energy(const Stress& sigma, const Stress& tau) const {
  return weighted(sigma).dot(weighted(tau));
}

template class CurvedElement<double>;
template class CurvedElement<Wide>;

}  // namespace airybench
