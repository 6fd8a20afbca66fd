#include "solvers/contact/anderson.hpp"

#include <Eigen/QR>
#include <limits>

#include "solvers/contact/gauss_seidel.hpp"

namespace airybench {
namespace {

constexpr int memory = 10;
constexpr double growth = 2;  // of ‖f‖ over its smallest: too much

class Acceleration {
 public:
  explicit Acceleration(Eigen::Index size) : of_f_(size, memory), of_g_(size, memory) {}

  // From F, g = g(F) and f = g − F: where to go. `best` is kept for when it was too far.
  Eigen::VectorXd next(const Eigen::VectorXd& g, const Eigen::VectorXd& f) {
    const double norm = f.norm();
    if (norm > growth * smallest_) {
      kept_ = 0;
      started_ = false;
      smallest_ = norm;  // from here on by what the best F gives
      return best_;
    }
    if (norm < smallest_) {
      smallest_ = norm;
      best_ = g;
    }
    if (started_) {
      of_f_.col(column_) = f - last_f_;
      of_g_.col(column_) = g - last_g_;
      column_ = (column_ + 1) % memory;
      kept_ = std::min(kept_ + 1, memory);
    }
    last_f_ = f;
    last_g_ = g;
    started_ = true;
    if (kept_ == 0) return g;
    const Eigen::VectorXd gamma = of_f_.leftCols(kept_).colPivHouseholderQr().solve(f);
    return g - of_g_.leftCols(kept_) * gamma;
  }

 private:
  Eigen::MatrixXd of_f_, of_g_;  // differences, in any order
  Eigen::VectorXd last_f_, last_g_, best_;
  double smallest_ = std::numeric_limits<double>::infinity();
  int kept_ = 0, column_ = 0;
  bool started_ = false;
};

}  // namespace

ContactResult solve_contact_by_anderson(const CondensedSystem& condensed,
                                        const ContactPoints& contact, const RunControl& control,
                                        const Eigen::VectorXd& start) {
  const Eigen::VectorXd offset = contact_offset(condensed, contact);
  Acceleration acceleration(contact.size());
  Eigen::VectorXd from = start.size() > 0 ? start : Eigen::VectorXd::Zero(contact.size());
  // F is what a sweep gave, so that it meets the law's bounds; `from` is where the next one begins.
  return iterate_contact(condensed, contact, control, start, [&](Eigen::VectorXd& F) {
    F = from;
    const double change = gauss_seidel_sweep(condensed, contact, offset, F);
    from = acceleration.next(F, F - from);
    return change;
  });
}

}  // namespace airybench
