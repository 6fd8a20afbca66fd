// A body and the contact law between its contact forces F_C and r = ū_C − ḡ, where ū_C are its
// contact displacements, at every contact point: two per edge, its ends (k + 1 for stresses of
// degree k). ū_C belongs to w; ḡ contains g0 and the rigid motion (problem.hpp). edge_forces.hpp
// defines forces and displacements on edges.
#pragma once

#include <memory>

#include "assembly/contact_problem.hpp"
#include "assembly/problem/problem.hpp"

namespace airybench {

// degree: of the stresses, k + 1 points per edge. Two components if there is friction anywhere; ḡ
// from the moments of the offset.
ContactPoints contact_points(const Problem& problem, int degree = 1);

struct ContactSystem {
  std::shared_ptr<const Problem> problem;
  int degree = 1;  // of the stresses
  ContactPoints contact;

  virtual ~ContactSystem() = default;
  int n_c() const { return contact.size(); }
  virtual std::size_t bytes() const;  // of all arrays
  // Another load case of the same body (same_body).
  virtual void set_load_case(std::shared_ptr<const Problem> load_case);
};
ContactSystem contact_system(std::shared_ptr<const Problem> problem, int degree = 1);

}  // namespace airybench
