#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

struct NotConverged : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// F with r = D F + b, and the number of steps: Newton's method on F = P(F - r / diag D).
VectorXd contact_forces(const MatrixXd& D, const VectorXd& b, const VectorXd& mu, int& step) {
  const Eigen::Index components = b.size() / std::max<Eigen::Index>(1, mu.size());
  if (components > 2)
    throw std::runtime_error("3 components per contact point (allowed: 1 or 2, in the plane)");
  VectorXd F = VectorXd::Zero(b.size());
  for (step = 1; step <= 50; ++step) {
    const VectorXd trial = F - (D * F + b).cwiseQuotient(D.diagonal());
    MatrixXd A = D;  // r = 0, closed and sticking
    VectorXd right = -b;
    const auto replace = [&](Eigen::Index i) {
      A.row(i).setZero();
      A(i, i) = 1;
      right(i) = 0;
    };
    for (Eigen::Index point = 0; point < mu.size(); ++point) {
      const Eigen::Index i = components * point;
      if (trial(i) >= 0) {  // open: F = 0
        for (Eigen::Index k = 0; k < components; ++k) replace(i + k);
      } else if (components == 2 && std::abs(trial(i + 1)) >= -mu(point) * trial(i)) {  // slip
        replace(i + 1);
        A(i + 1, i) = trial(i + 1) > 0 ? mu(point) : -mu(point);
      }
    }
    const VectorXd before = F;
    F = A.partialPivLu().solve(right);
    if ((F - before).norm() <= 1e-13 * F.norm()) {
      const VectorXd r = D * F + b;
      for (Eigen::Index i = 0; i < r.size(); i += components)
        if (r(i) > 1e-9 * b.cwiseAbs().maxCoeff()) throw NotConverged("points are inside the wall");
      return F;
    }
  }
  throw NotConverged("no convergence in 50 steps");
}
