// The diagonal of D from below, without D: what moves where all is held but a few edges moves more
// where nothing is.
//
//   D_jj = e_jᵀ K⁻¹ e_j ≥ e_jᵀ K_PP⁻¹ e_j     for any set P of unknowns, j among them
//
// K as in hybridized.hpp, contact forces given. P: the edges of the contact edge's triangle. The
// natural map of the contact law grows with ρ: with ρ_j = 1 / (K_PP⁻¹)_jj it is at least that with
// ρ_j = 1/D_jj, up to what friction's cone, as wide as the normal force, moves with ρ_n.
//
// Of one material (K_PP⁻¹)_jj is 10 to 14 times too small. But a body is no stiffer than if all of
// it were of its stiffest material: half the rough diagonal (rough_compliance.hpp) of that, 0.4 of
// it for higher degrees, serves too.
#pragma once

#include <unordered_map>
#include <vector>

#include "assembly/contact_system.hpp"
#include "solvers/base/element_matrices.hpp"

namespace airybench {

class ContactCompliance {
 public:
  explicit ContactCompliance(const Problem& problem, int degree = 1);
  // Whether K_e of the triangle is needed: at a contact edge, or next to a triangle at one.
  bool asks_for(int triangle) const;
  // Every triangle that is asked for, once.
  void add(int triangle, const Eigen::Ref<const Eigen::MatrixXd>& K_e);
  // Per row of Mesh::boundary, in a column: of the normal and tangential unknowns of a contact
  // edge, from its start on, mm/N; zero elsewhere. Inner edges with one triangle, as of a part of a
  // body, count as held.
  Eigen::MatrixXd from_below() const;

 private:
  struct Near {
    Eigen::MatrixXd stiffness;  // block of K
    int triangles = 0;
  };
  bool is_contact(int edge) const;
  std::array<bool, 2> free_components(int edge) const;

  const Problem& problem_;
  Eigen::Index of_edge_;                                 // unknowns
  std::unordered_map<int, int> row_of_edge_;             // of Mesh::boundary
  std::vector<bool> is_near_;                            // edges of triangles at contact edges
  std::unordered_map<int, Near> near_;                   // these
  std::unordered_map<int, Eigen::MatrixXd> at_contact_;  // K_e of those triangles
};

// Of every row of F_C, the larger of both; of_rows: from_below() of the whole boundary.
Eigen::VectorXd at_contact_points(const Eigen::MatrixXd& of_rows, const Problem& problem,
                                  const ContactPoints& contact);
// Of a whole K.
Eigen::VectorXd compliance_from_below(const Problem& problem, const ElementMatrices& K,
                                      const ContactPoints& contact);

}  // namespace airybench
