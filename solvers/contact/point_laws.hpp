// Which case of the contact law every point is in, for active sets that act on a stiffness: open,
// stick, or slip with F_t = ratio · F_n.
//
// The next laws are those of the trial F − r/D (coulomb_law.hpp), with D the rough compliance.
#pragma once

#include <limits>
#include <vector>

#include "assembly/contact_problem.hpp"
#include "assembly/problem/load_scale.hpp"

namespace airybench {

struct PointLaw {
  bool closed = false, sticks = false;
  double ratio = 0;  // F_t / F_n of a point that slips in the plane
  bool operator==(const PointLaw&) const = default;
};

// trial: F − r/D, in the rows of F_C.
std::vector<PointLaw> laws_of(const ContactPoints& contact, const Eigen::VectorXd& trial);

// F_C under the laws, of the reactions that hold the rows: K u − b there.
Eigen::VectorXd forces_under(const ContactPoints& contact, const std::vector<PointLaw>& laws,
                             const Eigen::VectorXd& reaction);

// The laws of one active set after another. There is no proof that they settle: after some without
// a natural map half as large, only half of those that would change do, where it is largest, then a
// quarter, …; each time that it halves, twice as many again.
class LawChoice {
 public:
  struct Next {
    double natural_map = 0;      // relative
    std::vector<PointLaw> laws;  // none: those at hand stay
  };
  // After `laws` with F_C and u_C; compliance: rough, of every row of F_C.
  Next after(const ContactPoints& contact, const Eigen::VectorXd& compliance,
             const std::vector<PointLaw>& laws, const Eigen::VectorXd& F_C,
             const Eigen::VectorXd& u_C, const LoadScale& scale, double tolerance);

 private:
  double share_ = 1, to_halve_ = std::numeric_limits<double>::infinity();
  int since_halved_ = 0;
};

}  // namespace airybench
