// Coarse displacements of nodes (solvers/two_level/coarse_nodes.hpp) and their problem PᵀKP over
// the ranks. A component is held if the slots of its edges are: P omits it, and its rows and
// columns of PᵀKP are diagonal.
#pragma once

#include "peers/petsc/body_part.hpp"
#include "solvers/contact/point_laws.hpp"
#include "solvers/two_level/coarse_nodes.hpp"

namespace airybench {

class CoarseSpace {
 public:
  // Kind: as the materials need, or -coarse_space linear|per_edge.
  explicit CoarseSpace(const BodyPart& part);

  // K_e is diagonal in its prescribed slots.
  void add(int triangle, const ElementMatrices::Matrix& K_e);
  void end_assembly();  // collective

  // Holds what these laws hold; collective. True if PᵀKP changed.
  bool set_laws(const std::vector<PointLaw>& laws);

  Mat matrix() const { return held_matrix_; }
  Mat prolongation() const { return P_; }
  CoarseKind kind() const { return whole_.kind; }
  PetscInt unknowns() const;

 private:
  using Components = std::vector<std::array<bool, 2>>;

  const Numbering& nodes() const {
    return kind() == CoarseKind::linear ? part_.vertices : part_.edges;
  }
  bool is_held(int node, int component) const {
    return node_there_[node] >= 0 && held_[node_there_[node]][component];
  }
  void create_prolongation();
  void fill_prolongation(const std::vector<int>& edges);

  const BodyPart& part_;
  CoarseNodes whole_;            // of the whole boundary
  std::vector<int> block_;       // local edge → itself
  std::vector<int> node_there_;  // local node → node of the whole boundary, or none
  CoarseNodes own_;
  std::vector<int> at_boundary_;                   // own edges with a node on the boundary
  Components prescribed_, held_, held_by_matrix_;  // per node of the whole boundary
  parallel::OwnedMat matrix_, held_matrix_, P_;
  bool matrix_is_held_ = false;
  PetscReal share_of_changes_ = 0.01;  // of the contact rows; fewer changes keep the matrix
};

}  // namespace airybench
