// The hybridized system over the ranks: K in 4×4 blocks over edges
// (solvers/two_level/edge_matrix.hpp), four slots per edge, edges numbered as in MeshPart.
//
//   A   K with the rows and columns of held slots empty but for the diagonal; the tangential row of
//       a slipping point has ratio × its normal row taken from it
//   K   all of it, but for the slots prescribed on Γ_D: these are in b
//
// The two differ in the blocks of edges on Γ_C only, each of which is in one triangle. The K_e of
// these triangles are kept; when laws change, their blocks are put into A anew.
#pragma once

#include <functional>

#include "peers/petsc/body_part.hpp"
#include "peers/petsc/rigid_modes.hpp"
#include "solvers/condensation/hybridized.hpp"
#include "solvers/contact/point_laws.hpp"

namespace airybench {

using ElementStiffness = Eigen::Matrix<double, 12, 12>;

class EdgeSystem {
 public:
  // Assembles A, no point being held, and b. visit: every triangle's K_e, what is prescribed in it.
  using Visit = std::function<void(int triangle, const ElementStiffness& K_e)>;
  EdgeSystem(const BodyPart& part, const Visit& visit);

  // All collective. Laws of every contact point.
  void set_laws(const std::vector<PointLaw>& laws);
  void multiply(Vec x, Vec y) const;  // y = K x
  // r as the right-hand side of A: slip rows combined, zero where held.
  void reduce(Vec r) const;
  // The rows of F_C of a vector in slots, known to every rank; and back, set.
  Eigen::VectorXd of_contact(Vec x) const;
  void set_at_contact(const Eigen::VectorXd& rows, const std::vector<bool>& which, Vec x) const;
  double energy(Vec u, Vec K_times_u) const;  // (u + ū0)ᵀ K (u + ū0)
  parallel::OwnedVec new_vector() const;      // zeros

  // Four slots per local edge, those of other ranks' edges, too; and back, added up.
  Eigen::VectorXd to_local(Vec x) const;
  void add_from_local(const Eigen::VectorXd& local, Vec x) const;

  Mat A() const { return A_; }
  Vec b() const { return b_; }
  bool slips() const { return slips_; }
  const BodyPart& part() const { return part_; }
  // For recover_stresses: the slots of local edges are its unknowns, it has no K.
  const HybridizedSystem& of_part() const { return local_; }
  const std::vector<PointLaw>& laws() const { return laws_; }
  // Of every row of F_C (contact_compliance.hpp).
  const Eigen::VectorXd& compliance_from_below() const { return compliance_from_below_; }

 private:
  struct ContactTriangle {
    int triangle;
    ElementStiffness K = ElementStiffness::Zero();
    std::array<bool, 12> on_contact = {}, held = {};
    std::array<double, 12> ratio = {};
  };
  struct ContactEdge {
    int edge, first_point;  // local; of its start
  };

  void create_matrix();
  void sum_compliance(const Eigen::Matrix4Xd& of_part);
  std::vector<FramedPoint> points_of_slots() const;
  std::array<PetscInt, 12> slots_of(int triangle) const;
  PetscInt own_slot(int edge) const {  // of an edge of this rank, its first one
    return 4 * (part_.mesh.edges.global[edge] - part_.mesh.edges.begin);
  }
  void find_contact();
  void put_into_A(const ContactTriangle& of) const;
  // x at the slots of contact triangles, 12 each.
  Eigen::VectorXd at_contact_triangles(Vec x) const;

  const BodyPart& part_;
  HybridizedSystem local_;
  parallel::OwnedMat A_;
  parallel::OwnedVec b_, prescribed_force_;  // K ū0 at the slots that are not prescribed
  double prescribed_energy_ = 0;             // ū0ᵀ K ū0
  std::vector<ContactEdge> contact_edges_;   // of own triangles
  std::vector<int> contact_triangle_of_;     // triangle → row of contact_triangles_, or −1
  std::vector<ContactTriangle> contact_triangles_;
  parallel::OwnedScatter to_contact_triangles_, to_local_;
  parallel::OwnedVec contact_values_, local_values_;
  std::vector<PointLaw> laws_;
  Eigen::VectorXd compliance_from_below_;
  bool slips_ = false;
};

}  // namespace airybench
