// Which case of the contact law every point is in, for active sets that act on a stiffness: open,
// stick, or slip with F_t = ratio · F_n.
//
// The next laws are those of the trial F − r/D (coulomb_law.hpp), with D the rough compliance.
#pragma once

#include <vector>

#include "assembly/dual_system.hpp"

namespace airybench {

struct PointLaw {
  bool closed = false, sticks = false;
  double ratio = 0;  // F_t / F_n of a slipping point
  bool operator==(const PointLaw&) const = default;
};

// trial: F − r/D, in the rows of F_C.
std::vector<PointLaw> laws_of(const ContactPoints& contact, const Eigen::VectorXd& trial);

// F_C under the laws, of the reactions that hold the rows: K u − b there.
Eigen::VectorXd forces_under(const ContactPoints& contact, const std::vector<PointLaw>& laws,
                             const Eigen::VectorXd& reaction);

// Of those laws that would change, so many, where the natural map is largest.
std::vector<PointLaw> changed_in_part(const std::vector<PointLaw>& laws,
                                      const std::vector<PointLaw>& next, const Eigen::VectorXd& map,
                                      double share);

}  // namespace airybench
