// Coarse displacements of the hybridized system, and their problem PᵀKP, factorised.
//
// P takes displacements v of nodes to edge moments (edge_forces.hpp), along the edge's frame where
// it has one:
//
//   linear    a node per vertex, continuous piecewise linear:  ū_a = (2v_a + v_b)/3
//   per_edge  a node per edge, constant on it:                 ū_a = ū_b = v
//
// The first is a third of the second's size; the second does not lock near incompressibility.
//
// Nodes on Γ_C have normal and tangential components, and are the last unknowns: which of them are
// held by closed contact rows changes, and costs a dense factorisation of the Schur complement S on
// the free ones only (stiffness_condensation.hpp has the algebra).
#pragma once

#include <Eigen/Core>
#include <map>

#include "solvers/condensation/stiffness_condensation.hpp"
#include "solvers/two_level/edge_matrix.hpp"

namespace airybench {

enum class CoarseKind { linear, per_edge };

// per_edge where a body is nearly incompressible.
CoarseKind coarse_kind_for(const Problem& problem);

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

  CoarseKind kind() const { return kind_; }
  int unknowns() const { return unknowns_; }
  std::size_t bytes() const;  // without the factor
  const MultifrontalFactor& factor() const { return factor_; }

 private:
  using NodeUnknowns = std::array<int, 2>;  // negative: held for good
  // An edge whose slots are not all free, or along a frame.
  struct BoundaryBlock {
    int block;
    std::array<int, 2> nodes;                     // the second may be no_node
    std::array<Eigen::Vector2d, 4> direction;     // of its slots
    Eigen::Matrix4d P = Eigen::Matrix4d::Zero();  // slots × components of the two nodes
    std::array<bool, 4> held = {};
  };
  static constexpr int no_node = -1;

  void find_boundary_blocks(const Problem& problem, const EdgeMatrix& K);
  void choose_frames(const Problem& problem);
  void number_nodes(const Problem& problem);
  void fill_prolongation(BoundaryBlock& of) const;
  Eigen::Matrix<double, 12, 6> prolongation(const Problem& problem, const EdgeMatrix& K,
                                            const HybridizedSystem& system, int t,
                                            const std::array<int, 3>& nodes) const;
  // Calls visit(component) for those of a node that a direction has a part in.
  template <typename Visit>
  void visit_components(int node, const Eigen::Vector2d& direction, Visit visit) const;
  Eigen::VectorXd restricted(const Eigen::VectorXd& r) const;
  void add_prolonged(const Eigen::VectorXd& v, Eigen::VectorXd& x) const;

  CoarseKind kind_;
  int unknowns_ = 0, first_trailing_ = 0;
  std::vector<NodeUnknowns> unknown_;            // per node
  std::vector<int> frame_of_node_;               // row of frame_, or −1: x and y
  std::vector<Eigen::Matrix2d> frame_;           // columns n, t
  std::vector<std::array<int, 2>> block_nodes_;  // of every block
  std::vector<int> boundary_of_block_;           // row of boundary_, or −1
  std::vector<BoundaryBlock> boundary_;
  std::vector<int> node_of_point_;  // per contact point
  MultifrontalFactor factor_;
  Eigen::MatrixXd S_;               // Schur complement on trailing unknowns, lower triangle
  std::vector<int> free_;           // trailing unknowns that are not held, from the first on
  Eigen::MatrixXd on_free_factor_;  // Cholesky factor of S's rows and columns of these
};

}  // namespace airybench
