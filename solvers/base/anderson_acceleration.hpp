// Anderson acceleration of a fixed-point iteration x ← g(x) (Anderson 1965,
// doi:10.1145/321296.321305; Walker & Ni 2011, doi:10.1137/10078356X), safeguarded.
//
// With f_k = g(x_k) − x_k, or that in other units,
//
//   x_{k+1} = g(x_k) − Σ_j γ_j (g(x_{j+1}) − g(x_j)),   γ = argmin ‖f_k − Σ_j γ_j (f_{j+1} − f_j)‖
//
// over the last `memory` differences. Contact laws are only piecewise smooth: where ‖f‖ has grown
// above twice the smallest so far, the memory is dropped and plain steps go on from the best x.
#pragma once

#include <Eigen/Core>
#include <limits>

namespace airybench {

class AndersonAcceleration {
 public:
  AndersonAcceleration(Eigen::Index size, int memory)
      : of_f_(size, memory),
        of_g_(size, memory),
        Q_(size, memory),
        U_(memory, memory),
        gamma_(memory) {}

  // From g = g(x) and f: where to go. Allocates at its first call only.
  const Eigen::VectorXd& next(const Eigen::VectorXd& g, const Eigen::VectorXd& f);
  // g is another one from here on.
  void forget();
  static std::size_t bytes(Eigen::Index size, int memory);

 private:
  void subtract_least_squares(const Eigen::VectorXd& f);

  Eigen::MatrixXd of_f_, of_g_;  // differences, in any order
  Eigen::MatrixXd Q_, U_;        // of_f = Q U
  Eigen::VectorXd last_f_, last_g_, best_, next_, rest_, gamma_;
  double smallest_ = std::numeric_limits<double>::infinity();
  int kept_ = 0, column_ = 0;
  bool started_ = false;
};

}  // namespace airybench
