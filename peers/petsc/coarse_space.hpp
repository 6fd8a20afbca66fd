// Coarse displacements v of nodes and their problem PᵀKP
// (solvers/two_level/coarse_displacements.hpp) over the ranks:
//
//   linear    a node per vertex:  ū_a = (2v_a + v_b)/3 along every edge
//   per_edge  a node per edge:    ū_a = ū_b = v; does not lock near incompressibility
//
// Nodes on Γ_C and rollers have normal and tangential components. A component is held where the
// slots of its edges are: P leaves it out, and in PᵀKP only its diagonal stays.
#pragma once

#include "peers/petsc/edge_system.hpp"

namespace airybench {

enum class CoarseKind { linear, per_edge };
// per_edge where a body is nearly incompressible, of all ranks; -coarse_space linear|per_edge.
CoarseKind coarse_kind_for(const BodyPart& part);

class CoarseSpace {
 public:
  CoarseSpace(const BodyPart& part, CoarseKind kind);
  CoarseSpace(const CoarseSpace&) = delete;
  CoarseSpace& operator=(const CoarseSpace&) = delete;

  // Adds a triangle of the part; what is prescribed in its K_e is diagonal.
  void add(int triangle, const ElementStiffness& K_e);
  void end_assembly();  // collective

  // Holds what these laws hold; collective. Whether that is other than before.
  bool set_laws(const std::vector<PointLaw>& laws);

  Mat matrix() const { return held_matrix_; }  // PᵀKP
  Mat prolongation() const { return shell_; }  // P
  CoarseKind kind() const { return kind_; }
  PetscInt unknowns() const;

 private:
  using Direction = Eigen::Vector2d;
  // A node that is not free in x and y.
  struct Node {
    bool has_frame = false;
    Eigen::Matrix2d frame = Eigen::Matrix2d::Identity();  // columns n, t
    std::array<bool, 2> prescribed = {}, held = {};
  };
  struct Held {  // own rows that are zero in P
    std::vector<PetscInt> fine, coarse;
    parallel::OwnedVec fine_work, coarse_work;
    Mat P = nullptr;
  };

  const Numbering& nodes() const {
    return kind_ == CoarseKind::linear ? part_.mesh.vertices : part_.mesh.edges;
  }
  std::array<int, 2> nodes_of_row(int row) const;  // of `boundary`: rows of boundary_nodes_
  const Node* node_at(int local) const;
  void find_boundary_nodes();
  template <typename Visit>
  void visit_slots(int row, const std::vector<bool>& held, Visit visit) const;
  Eigen::Matrix4d edge_rows(int edge, std::array<int, 2>& ends) const;
  void create_prolongation();
  void add_near_nullspace();
  static PetscErrorCode prolong(Mat shell, Vec v, Vec x);
  static PetscErrorCode prolong_add(Mat shell, Vec v, Vec add, Vec x);
  static PetscErrorCode restrict_to(Mat shell, Vec r, Vec f);

  const BodyPart& part_;
  CoarseKind kind_;
  std::vector<Node> boundary_nodes_;
  std::vector<int> boundary_node_of_;  // local node → row of these, or −1
  std::vector<int> row_of_edge_;       // local edge → row of the part's boundary, or −1
  parallel::OwnedMat matrix_, held_matrix_, P_, shell_;
  Held held_;
  std::vector<std::array<bool, 2>> held_by_matrix_;
  bool matrix_is_held_ = false;
  PetscReal share_of_changes_ = 0.01;  // of the contact rows, that the matrix is not made anew for
};

}  // namespace airybench
