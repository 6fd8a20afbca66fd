#include "solvers/krylov/gmres.hpp"

#include <algorithm>
#include <cmath>

#include "solvers/base/parallel.hpp"

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

// Calls work(slice, first row, rows): slices, and strips of them that stay in a cache.
constexpr int slices = 16;
void visit_strips(int threads, Eigen::Index rows,
                  const std::function<void(int, Eigen::Index, Eigen::Index)>& work) {
  constexpr Eigen::Index strip = 8192, few = 200'000;
  in_parallel(rows < few ? 1 : threads, slices, [&](int begin, int end) {
    for (int slice = begin; slice < end; ++slice) {
      const Eigen::Index last = rows * (slice + 1) / slices;
      for (Eigen::Index first = rows * slice / slices; first < last; first += strip)
        work(slice, first, std::min(strip, last - first));
    }
  });
}

}  // namespace

GmresResult solve_by_gmres(const ApplyTo& A, const ApplyTo& M_inverse, const Eigen::VectorXd& r,
                           const GmresOptions& options, const Deadline& deadline,
                           KrylovSpace& space, Eigen::VectorXd& x) {
  const OwnerScope scope(MemoryOwner::iteration);
  constexpr double rounding = 1e-7;  // of norms from differences of squares
  const int most = options.max_iterations;
  std::vector<Eigen::VectorXd>& Z = space.Z;
  Eigen::VectorXd& w = space.w;
  Eigen::VectorXd h = Eigen::VectorXd::Zero(most + 1);
  Eigen::MatrixXd partial(most + 1, slices);
  GmresResult result;

  // Z_n = M⁻¹ w − Σ_{i<n} h_i Z_i, made a unit vector; returns its norm, 0 where rounding is all
  // that the difference leaves: w·z has the errors of w·M⁻¹w.
  const auto add_vector = [&](int n) {
    if (static_cast<int>(Z.size()) == n) Z.emplace_back();
    M_inverse(w, Z[n]);
    partial.setZero();
    visit_strips(options.threads, w.size(), [&](int slice, Eigen::Index at, Eigen::Index count) {
      auto z = Z[n].segment(at, count);
      partial(1, slice) += w.segment(at, count).dot(z);
      for (int i = 0; i < n; ++i) z.noalias() -= h(i) * Z[i].segment(at, count);
      partial(0, slice) += w.segment(at, count).dot(z);
    });
    const double squared = partial.row(0).sum(), before = partial.row(1).sum();
    if (!std::isfinite(squared)) throw Breakdown("GMRES: a vector is not finite");
    const double norm = squared > rounding * rounding * before ? std::sqrt(squared) : 0;
    if (norm > 0)
      visit_strips(options.threads, w.size(), [&](int, Eigen::Index at, Eigen::Index count) {
        Z[n].segment(at, count) /= norm;
      });
    return norm;
  };
  w = r;
  result.norm = add_vector(0);
  if (result.norm == 0) {
    result.reduction = 0;
    x.setZero(r.size());
    return result;
  }
  RotatedHessenberg least_squares(most, result.norm);
  const double end = std::max(options.tolerance, options.enough / result.norm);
  while (result.iterations < most && result.reduction > end) {
    const int n = ++result.iterations;
    A(Z[n - 1], w);
    partial.setZero();
    visit_strips(options.threads, w.size(), [&](int slice, Eigen::Index at, Eigen::Index count) {
      for (int i = 0; i < n; ++i)
        partial(i, slice) += w.segment(at, count).dot(Z[i].segment(at, count));
    });
    h.head(n) = partial.topRows(n).rowwise().sum();
    h(n) = add_vector(n);
    const double next = h(n);
    result.reduction = least_squares.add(n - 1, h) / result.norm;
    if (next == 0) {  // the space is exhausted
      result.reduction = std::max(result.reduction, rounding);
      break;
    }
    deadline.check("GMRES");
  }
  const Eigen::VectorXd y = least_squares.solution(result.iterations);
  x.resize(r.size());
  visit_strips(options.threads, r.size(), [&](int, Eigen::Index at, Eigen::Index count) {
    auto part = x.segment(at, count);
    part.setZero();
    for (int i = 0; i < result.iterations; ++i) part.noalias() += y(i) * Z[i].segment(at, count);
  });
  if (!x.allFinite()) throw Breakdown("GMRES: the correction is not finite");
  return result;
}

}  // namespace airybench
