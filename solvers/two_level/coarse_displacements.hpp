// Coarse displacements of the hybridized system (coarse_nodes.hpp), and their problem PᵀKP,
// factorised.
//
// Nodes on Γ_C are the last unknowns: which of them are held by closed contact rows changes, and
// costs a dense factorisation of the Schur complement S on the free ones only
// (stiffness_condensation.hpp has the algebra).
#pragma once

#include <Eigen/Core>
#include <map>

#include "solvers/condensation/stiffness_condensation.hpp"
#include "solvers/two_level/coarse_nodes.hpp"
#include "solvers/two_level/edge_matrix.hpp"

namespace airybench {

// The contact law on the coarse displacements, means over groups of neighbouring nodes where there
// are many: which one a contact point begins with.
struct CoarseContact {
  contact::Problem problem;
  std::vector<int> of_point;  // contact point → coarse one, or −1
};

class CoarseDisplacements {
 public:
  CoarseDisplacements(const Problem& problem, const ContactPoints& contact, const EdgeMatrix& K,
                      CoarseKind kind);
  // PᵀKP.
  ElementMatrices galerkin(const Problem& problem, const EdgeMatrix& K,
                           const HybridizedSystem& system) const;
  // Its factor, a large one rounded; stages order and factor. Throws Breakdown, TimeoutReached,
  // std::bad_alloc.
  void factorise(const ElementMatrices& coarse, const Deadline& deadline, StageTimes& times);

  // Holds what these slots hold (per block, if any), and nothing else.
  void hold(const std::map<int, std::array<bool, 4>>& held);
  // x += P (PᵀKP)⁻¹ Pᵀ r over what is not held; slots that are held stay as they are.
  void correct(const Eigen::VectorXd& r, Eigen::VectorXd& x) const;

  // The contact problem PᵀKP v = Pᵀb + F.
  CoarseContact contact_problem(const ContactPoints& contact, const Eigen::VectorXd& b) const;

  CoarseKind kind() const { return nodes_.kind; }
  int unknowns() const { return unknowns_; }
  std::size_t bytes() const;  // without the factor
  const MultifrontalFactor& factor() const { return factor_; }

 private:
  using NodeUnknowns = std::array<int, 2>;  // negative: held for good

  void number_nodes(const Problem& problem);
  Eigen::VectorXd restricted(const Eigen::VectorXd& r) const;
  void add_prolonged(const Eigen::VectorXd& v, Eigen::VectorXd& x) const;

  CoarseNodes nodes_;
  int unknowns_ = 0, first_trailing_ = 0;
  std::vector<NodeUnknowns> unknown_;  // per node
  std::vector<int> node_of_point_;     // per contact point
  MultifrontalFactor factor_;
  Eigen::MatrixXd S_;               // Schur complement on trailing unknowns, lower triangle
  std::vector<int> free_;           // trailing unknowns that are not held, from the first on
  Eigen::MatrixXd on_free_factor_;  // Cholesky factor of S's rows and columns of these
};

}  // namespace airybench
