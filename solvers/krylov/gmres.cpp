#include "solvers/krylov/gmres.hpp"

#include <cmath>
#include <vector>

namespace airybench {
namespace {

// The least squares problem of the Hessenberg matrix, by Givens rotations.
class RotatedHessenberg {
 public:
  RotatedHessenberg(int most, double norm)
      : H_(Eigen::MatrixXd::Zero(most + 1, most)), g_(Eigen::VectorXd::Zero(most + 1)) {
    g_(0) = norm;
  }
  // Takes column j; returns the residual's norm.
  double add(int j, Eigen::Ref<Eigen::VectorXd> h) {
    for (int i = 0; i < j; ++i) rotate(c_[i], s_[i], h(i), h(i + 1));
    const double length = std::hypot(h(j), h(j + 1));
    c_.push_back(length > 0 ? h(j) / length : 1);
    s_.push_back(length > 0 ? h(j + 1) / length : 0);
    rotate(c_[j], s_[j], h(j), h(j + 1));
    rotate(c_[j], s_[j], g_(j), g_(j + 1));
    H_.col(j).head(j + 2) = h.head(j + 2);
    return std::abs(g_(j + 1));
  }
  Eigen::VectorXd solution(int columns) const {
    return H_.topLeftCorner(columns, columns)
        .triangularView<Eigen::Upper>()
        .solve(g_.head(columns));
  }

 private:
  static void rotate(double c, double s, double& a, double& b) {
    const double first = c * a + s * b;
    b = c * b - s * a;
    a = first;
  }
  Eigen::MatrixXd H_;
  Eigen::VectorXd g_;
  std::vector<double> c_, s_;
};

}  // namespace

GmresResult solve_by_gmres(const ApplyTo& A, const ApplyTo& M_inverse, const Eigen::VectorXd& r,
                           const GmresOptions& options, const Deadline& deadline,
                           Eigen::VectorXd& x) {
  const OwnerScope scope(MemoryOwner::iteration);
  const int most = options.most_iterations;
  x.setZero(r.size());
  std::vector<Eigen::VectorXd> V = {r}, Z(1);
  // The last of V, made a unit vector.
  const auto normalise = [&] {
    M_inverse(V.back(), Z.back());
    const double squared = V.back().dot(Z.back());
    if (!std::isfinite(squared)) throw Breakdown("GMRES: a vector is not finite");
    const double norm = std::sqrt(std::max(0.0, squared));
    if (norm > 0) {
      V.back() /= norm;
      Z.back() /= norm;
    }
    return norm;
  };
  GmresResult result;
  result.norm = normalise();
  if (result.norm == 0) {
    result.reduction = 0;
    return result;
  }
  RotatedHessenberg least_squares(most, result.norm);
  Eigen::VectorXd h(most + 1);
  const double end = std::max(options.tolerance, options.enough / result.norm);
  while (result.iterations < most && result.reduction > end) {
    const int j = result.iterations;
    Eigen::VectorXd w;
    A(Z[j], w);
    for (int i = 0; i <= j; ++i) {
      h(i) = w.dot(Z[i]);
      w.noalias() -= h(i) * V[i];
    }
    V.push_back(std::move(w));
    Z.emplace_back();
    const double next = normalise();
    h(j + 1) = next;
    result.reduction = least_squares.add(j, h) / result.norm;
    ++result.iterations;
    if (!(next > 1e-15 * result.norm)) break;  // the space is exhausted
    deadline.check("GMRES");
  }
  const Eigen::VectorXd y = least_squares.solution(result.iterations);
  for (int i = 0; i < result.iterations; ++i) x.noalias() += y(i) * Z[i];
  if (!x.allFinite()) throw Breakdown("GMRES: the correction is not finite");
  return result;
}

std::size_t gmres_bytes(Eigen::Index rows, int iterations) {
  return static_cast<std::size_t>(rows) * 2 * static_cast<std::size_t>(iterations + 1) *
         sizeof(double);
}

}  // namespace airybench
