// The hybridized system over the ranks: K in 4×4 blocks over edges
// (solvers/two_level/edge_matrix.hpp), four slots per edge, edges numbered as in MeshPart. Vectors
// have the slots of this rank's edges; local ones those of all edges of its part.
//
//   A   K with only the diagonal in rows and columns of held slots; from the tangential row of a
//       slipping point ratio × its normal row is subtracted
//   K   all of it, except the slots prescribed on Γ_D, which are in b
//
// They differ only in the blocks of edges on Γ_C, each in one triangle. Both are kept for these
// triangles; new laws replace their blocks of A.
//
// PETSc's options choose the Krylov method and the preconditioner of A x = r: KSP without a prefix
// if A is symmetric, -slip_ksp_type if points slip. -pc_type mg has two levels, A and the coarse
// displacements' PᵀKP; options set the rest (peers/petsc/*.options).
#pragma once

#include "peers/petsc/coarse_space.hpp"
#include "solvers/active_sets/active_rows.hpp"

namespace airybench {

class RankRows : public ContactRows {
 public:
  // Assembles A without held points, b, and the second level `coarse`, which may be null. With one
  // displacement per edge, -per_edge_mg_coarse_pc_type and …_pc_factor_mat_solver_type replace
  // -mg_coarse_….
  RankRows(const BodyPart& part, CoarseSpace* coarse);
  RankRows(const RankRows&) = delete;
  RankRows& operator=(const RankRows&) = delete;

  // All functions are collective.
  Eigen::Index slots() const override { return b_.size(); }
  // Points that the body would push through the wall are closed and stick; the others are open.
  std::vector<PointLaw> first_laws(int& sweeps) override;
  void set(const std::vector<PointLaw>& laws) override;
  void move_to_gap(Eigen::VectorXd& u) const override;
  double measure(const Eigen::VectorXd& u, Eigen::VectorXd& unbalanced) override;
  // x is zero if the method breaks down.
  GmresResult solve(Eigen::VectorXd r, const GmresOptions& options, Eigen::VectorXd& x) override;
  double error_left(const GmresResult& solve, const Eigen::VectorXd& r, bool measured) override;
  Eigen::VectorXd of_contact(const Eigen::VectorXd& x) const override;
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const override;
  double dot(const Eigen::VectorXd& x, const Eigen::VectorXd& y) const override {
    return parallel::sum(x.dot(y));
  }
  double norm_from_below(const Eigen::VectorXd& F_C) override;

  // Includes slots of other ranks' edges; and back, summed.
  Eigen::VectorXd to_local(const Eigen::VectorXd& x) const;
  Eigen::VectorXd from_local(const Eigen::VectorXd& local) const;
  // Calls set_row(row of F_C, slot) for this rank's contact rows.
  template <typename Set>
  void visit_contact(Set set_row) const {
    const int m = contact.components;
    for (const auto& [edge, first_point] : part_.contact_edges)
      for (int end = 0; end < 2; ++end)
        for (int k = 0; k < m; ++k)
          set_row(m * (first_point + end) + k, own_slot(edge) + 2 * end + k);
  }
  // Per row of F_C (contact_compliance.hpp).
  const Eigen::VectorXd& compliance_from_below() const { return compliance_from_below_; }

 private:
  struct ContactTriangle {
    int triangle;
    std::array<int, 3> first_point;  // of its edges; −1: not on Γ_C
    ElementMatrices::Matrix K, A;
  };

  void create_matrix();
  void add_element(int triangle, const ElementMatrices::Matrix& K_e);
  void find_contact_triangles();
  void assemble_system();
  void put_laws_into_A();
  void create_solvers();
  // Turns r into a right-hand side of A: slip rows combined, zero where held.
  void reduce(Eigen::VectorXd& r) const;
  double norm(const Eigen::VectorXd& r) const;  // √(r·M⁻¹r)
  PetscInt own_slot(int edge) const {           // first slot of an edge of this rank
    return 4 * (part_.edges.global[edge] - part_.edges.begin);
  }

  const BodyPart& part_;
  CoarseSpace* coarse_;
  parallel::OwnedMat A_;
  PetscInt block_size_ = 4;
  Eigen::VectorXd b_, prescribed_force_;  // K ū0 at unprescribed slots
  double prescribed_energy_ = 0;          // ū0ᵀ K ū0
  std::vector<ContactTriangle> contact_triangles_;
  std::vector<PointLaw> laws_;
  Eigen::VectorXd compliance_from_below_;
  parallel::OwnedKsp symmetric_, slipping_;
  bool is_set_up_ = false;
};

}  // namespace airybench
