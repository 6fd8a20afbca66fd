// The hybridized system over the ranks: K in 4×4 blocks over edges
// (solvers/two_level/edge_matrix.hpp), four slots per edge, edges numbered as in MeshPart. Vectors
// have the slots of this rank's edges, or local: of all edges of its part.
//
//   A   K with the rows and columns of held slots empty but for the diagonal; the tangential row of
//       a slipping point has ratio × its normal row taken from it
//   K   all of it, but for the slots prescribed on Γ_D: these are in b
//
// The two differ in the blocks of edges on Γ_C only, each of which is in one triangle. Both
// are kept for these triangles; when laws change, their blocks of A are replaced.
//
// A x = r by the Krylov method and the preconditioner of the options: KSP without a prefix where A
// is symmetric, -slip_ksp_type where points slip. With -pc_type mg it has two levels, A and the
// coarse displacements' PᵀKP, everything else as the options say (peers/petsc/*.options).
#pragma once

#include "peers/petsc/coarse_space.hpp"
#include "solvers/two_level/active_rows.hpp"

namespace airybench {

class RankRows : public ContactRows {
 public:
  // Assembles A, no point being held, and b. coarse: of two levels, or none; is assembled, too.
  // With one displacement per edge -per_edge_mg_coarse_pc_type and …_pc_factor_mat_solver_type go
  // before -mg_coarse_….
  RankRows(const BodyPart& part, CoarseSpace* coarse);
  RankRows(const RankRows&) = delete;
  RankRows& operator=(const RankRows&) = delete;

  // All collective.
  Eigen::Index slots() const override { return b_.size(); }
  // Points that the body would pass through the wall are closed and stick, the others are open.
  std::vector<PointLaw> first_laws(int& sweeps) override;
  void set(const std::vector<PointLaw>& laws) override;
  void move_to_gap(Eigen::VectorXd& u) const override;
  double measure(const Eigen::VectorXd& u, Eigen::VectorXd& unbalanced) override;
  // Where the method breaks down x is zero.
  GmresResult solve(Eigen::VectorXd r, const GmresOptions& options, Eigen::VectorXd& x) override;
  double error_left(const GmresResult& solve, const Eigen::VectorXd& r, bool measured) override;
  Eigen::VectorXd of_contact(const Eigen::VectorXd& x) const override;
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const override;
  double dot(const Eigen::VectorXd& x, const Eigen::VectorXd& y) const override {
    return parallel::sum(x.dot(y));
  }
  double norm_from_below(const Eigen::VectorXd& F_C) override;

  // Slots of other ranks' edges, too; and back, added up.
  Eigen::VectorXd to_local(const Eigen::VectorXd& x) const;
  Eigen::VectorXd from_local(const Eigen::VectorXd& local) const;
  // Calls set(row of F_C, slot) for the contact rows of this rank.
  template <typename Set>
  void visit_contact(Set set_row) const {
    const int m = contact.components;
    for (const auto& [edge, first_point] : part_.contact_edges)
      for (int end = 0; end < 2; ++end)
        for (int k = 0; k < m; ++k)
          set_row(m * (first_point + end) + k, own_slot(edge) + 2 * end + k);
  }
  // Of every row of F_C (contact_compliance.hpp).
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
  // r as the right-hand side of A: slip rows combined, zero where held.
  void reduce(Eigen::VectorXd& r) const;
  double norm(const Eigen::VectorXd& r) const;  // √(r·M⁻¹r)
  PetscInt own_slot(int edge) const {           // of an edge of this rank, its first one
    return 4 * (part_.edges.global[edge] - part_.edges.begin);
  }

  const BodyPart& part_;
  CoarseSpace* coarse_;
  parallel::OwnedMat A_;
  PetscInt block_size_ = 4;
  Eigen::VectorXd b_, prescribed_force_;  // K ū0 at the slots that are not prescribed
  double prescribed_energy_ = 0;          // ū0ᵀ K ū0
  std::vector<ContactTriangle> contact_triangles_;
  std::vector<PointLaw> laws_;
  Eigen::VectorXd compliance_from_below_;
  parallel::OwnedKsp symmetric_, slipping_;
  bool is_set_up_ = false;
};

}  // namespace airybench
