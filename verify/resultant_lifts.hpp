// Displacements that single out contact forces.
//
// The lift of a face has [v] = n on the face (or t), [v] = 0 on other contact faces and v = 0 on
// Γ_D. By virtual work
//
//   ∫ σ:ε(v) − ∫ b·v − ∫_{Γ_F} f·v = Σ F_n of the face (or Σ F_t)
//
// for the exact σ; that of all faces has [v] = n on all. What is not known of the work is
// proportional to ‖Aε(v)‖. So v is a sum of displacements that each move one side of a face, with
// the weights that make this norm the least: the sides of a pair count alike, since σ_n is the same
// on both, and those of other faces may move together. Where a body, or several on top of one
// another, can be moved as a whole, the norm is 0 and the force known from statics.
//
// Without friction only n·v is prescribed on flat faces, unless that leaves a body free. Sides that
// meet where v would jump move together: their sum may have a lift, each of them has none.
#pragma once

#include <optional>

#include "assembly/displacement_field.hpp"
#include "verify/contact_faces.hpp"

namespace airybench {

struct Lift {
  DisplacementField v;
  StressField stress;  // A ε(v)
  double norm;         // its, √(N mm)
};
struct FaceLifts {
  std::optional<Lift> normal, tangential;
};

// For stresses of a degree; they do not depend on the loads. Without friction there are no
// tangential ones.
struct ResultantLifts {
  std::vector<ContactFace> faces;
  std::vector<FaceLifts> of_faces;
  FaceLifts of_all;
};
ResultantLifts resultant_lifts(const Problem& problem, int degree);

}  // namespace airybench
