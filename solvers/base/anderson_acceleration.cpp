#include "solvers/base/anderson_acceleration.hpp"

#include <algorithm>

namespace airybench {

const Eigen::VectorXd& AndersonAcceleration::next(const Eigen::VectorXd& g,
                                                  const Eigen::VectorXd& f) {
  constexpr double growth = 2;  // of ‖f‖ over its smallest: too much
  const double norm = f.norm();
  if (norm > growth * smallest_) {
    forget();
    smallest_ = norm;  // from here on by what the best x gives
    return best_;
  }
  if (norm < smallest_) {
    smallest_ = norm;
    best_ = g;
  }
  const auto memory = static_cast<int>(of_f_.cols());
  if (started_) {
    of_f_.col(column_) = f - last_f_;
    of_g_.col(column_) = g - last_g_;
    column_ = (column_ + 1) % memory;
    kept_ = std::min(kept_ + 1, memory);
  }
  last_f_ = f;
  last_g_ = g;
  started_ = true;
  next_ = g;
  subtract_least_squares(f);
  return next_;
}

// By modified Gram–Schmidt, of_f = Q U; a difference that depends on the others is left out.
void AndersonAcceleration::subtract_least_squares(const Eigen::VectorXd& f) {
  constexpr double independent = 1e-10;
  rest_ = f;
  for (int j = 0; j < kept_; ++j) {
    auto q = Q_.col(j);
    q = of_f_.col(j);
    const double before = q.norm();
    for (int i = 0; i < j; ++i) {
      U_(i, j) = Q_.col(i).dot(q);
      q -= U_(i, j) * Q_.col(i);
    }
    U_(j, j) = q.norm();
    if (U_(j, j) > independent * before) {
      q /= U_(j, j);
    } else {
      q.setZero();
      U_(j, j) = 0;
    }
    gamma_(j) = q.dot(rest_);
    rest_ -= gamma_(j) * q;
  }
  for (int j = kept_ - 1; j >= 0; --j) {
    for (int k = j + 1; k < kept_; ++k) gamma_(j) -= U_(j, k) * gamma_(k);
    gamma_(j) = U_(j, j) > 0 ? gamma_(j) / U_(j, j) : 0;
    next_ -= gamma_(j) * of_g_.col(j);
  }
}

void AndersonAcceleration::forget() {
  kept_ = 0;
  column_ = 0;
  started_ = false;
  smallest_ = std::numeric_limits<double>::infinity();
}

std::size_t AndersonAcceleration::bytes(Eigen::Index size, int memory) {
  return static_cast<std::size_t>(size * (3 * memory + 5) + memory * (memory + 1)) * sizeof(double);
}

}  // namespace airybench
