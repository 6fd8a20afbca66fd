// What it costs that curved sides are solved as their chords.
//
// σ balances the loads of the body between the chords. Continued to the true side it leaves there
//
//   r = f(n) − σ n = (f(n) − f(n_chord)) − σ (n − n_chord),   n: the true side's normal
//
// and the constitutive relation error e of the chords' problem does not see it:
//
//   ‖σ − σ_exact‖² ≤ e² + η²,   η² = Σ c h/E ∫ |r|² ds over the sides,   h: the chord,
//
// E that of plane strain or stress. Where the side is held, u0 on the chord is wrong by ∂u/∂n times
// the distance to the side, and E |∂u/∂n| |n − n_chord| takes the place of |r|. On sides in
// contact, whose law has the true side's normals, f(n) = f(n_chord). For chords that end on their
// curve c = 1.5, on held sides 0.3: 1.43 to 1.62 was measured on rings, holes, ellipses and fillets
// of degrees 1 to 3, 0.08 to 0.16 on held circles; it is not proven. Where the mesh does not know
// its curves, they are supposed (supposed_curves.hpp); h is then the whole side, however it is cut.
//
// Where a line between two materials looks like a curve, r = −(σ₁ − σ₂)(n − n_chord), E of the
// softer one; neither meshes nor stresses know curves inside a body.
//
// Stresses of degree k ≥ 2 follow curved edges (curved_element.hpp). Their tractions match the
// loads there, or those of the contact law, in moments only, so what is left has no resultant on
// any edge, and
//
//   η² = Σ c_k h/E ∫ |f − σ n|² ds,   c_k = 2^(1 − k)/sin³ of the triangle's smallest angle
//
// is local; fitted to seven shapes, ν up to 0.4999, not proven.
#pragma once

#include <string>
#include <vector>

#include "assembly/stress_field.hpp"

namespace airybench {

// η² per triangle, N mm; all zero where no side is curved. of_chords: of it, where a side's own
// curve is taken as its chord.
struct GeometryError {
  std::vector<double> of_triangle_Nmm, of_chords_Nmm;
};
GeometryError geometry_error(const Problem& problem, const StressField& stress);

// The groups, and the lines between materials, with curved sides that stresses or displacements of
// a degree take as chords, and how far these are off (curved_groups.hpp); empty: there are none.
std::string polygon_groups(const Problem& problem, int degree);

}  // namespace airybench
