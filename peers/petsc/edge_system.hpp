// The hybridized system over the ranks: K in 4×4 blocks over edges
// (solvers/two_level/edge_matrix.hpp), four slots per edge, edges numbered as in MeshPart. Vectors
// have the slots of this rank's edges, or local: of all edges of its part.
//
//   A   K with the rows and columns of held slots empty but for the diagonal; the tangential row of
//       a slipping point has ratio × its normal row taken from it
//   K   all of it, but for the slots prescribed on Γ_D: these are in b
//
// The two differ in the blocks of edges on Γ_C only, each of which is in one triangle. What the two
// are of these triangles is kept; when laws change, their blocks are put into A anew.
#pragma once

#include "peers/petsc/body_part.hpp"
#include "solvers/contact/point_laws.hpp"

namespace airybench {

using ElementStiffness = ElementMatrices::Matrix;

class EdgeSystem {
 public:
  // Assembles A, no point being held, and b. visit: every triangle's K_e, what is prescribed in it.
  using Visit = std::function<void(int triangle, const ElementStiffness& K_e)>;
  EdgeSystem(const BodyPart& part, const Visit& visit);

  // All collective. Laws of every contact point.
  void set_laws(const std::vector<PointLaw>& laws);
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;  // y = K x
  // r as the right-hand side of A: slip rows combined, zero where held.
  void reduce(Eigen::VectorXd& r) const;
  Eigen::VectorXd of_contact(const Eigen::VectorXd& x) const;  // in the rows of F_C, at every rank
  double energy(const Eigen::VectorXd& u, const Eigen::VectorXd& K_times_u) const;  // of u + ū0
  // Slots of other ranks' edges, too; and back, added up.
  Eigen::VectorXd to_local(const Eigen::VectorXd& x) const;
  Eigen::VectorXd from_local(const Eigen::VectorXd& local) const;

  // Calls set(row of F_C, slot) for the contact rows of this rank.
  template <typename Set>
  void visit_contact(Set set) const {
    const int m = part_.contact.components;
    for (const auto& [edge, first_point] : part_.contact_edges)
      for (int end = 0; end < 2; ++end)
        for (int k = 0; k < m; ++k) set(m * (first_point + end) + k, own_slot(edge) + 2 * end + k);
  }

  Mat A() const { return A_; }
  const Eigen::VectorXd& b() const { return b_; }
  const BodyPart& part() const { return part_; }
  const std::vector<PointLaw>& laws() const { return laws_; }
  // Of every row of F_C (contact_compliance.hpp).
  const Eigen::VectorXd& compliance_from_below() const { return compliance_from_below_; }

 private:
  struct ContactTriangle {
    int triangle;
    std::array<int, 3> first_point;  // of its edges; −1: not on Γ_C
    ElementStiffness K, A;
  };

  void create_matrix();
  void add_element(int triangle, const ElementStiffness& K_e);
  void find_contact_triangles();
  PetscInt own_slot(int edge) const {  // of an edge of this rank, its first one
    return 4 * (part_.mesh.edges.global[edge] - part_.mesh.edges.begin);
  }

  const BodyPart& part_;
  parallel::OwnedMat A_;
  PetscInt block_size_ = 4;
  Eigen::VectorXd b_, prescribed_force_;  // K ū0 at the slots that are not prescribed
  double prescribed_energy_ = 0;          // ū0ᵀ K ū0
  std::vector<ContactTriangle> contact_triangles_;
  std::vector<PointLaw> laws_;
  Eigen::VectorXd compliance_from_below_;
};

}  // namespace airybench
