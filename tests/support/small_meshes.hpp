// Meshes made on the spot, so that a test shows what it is about.
#pragma once

#include "mesh/mesh.hpp"

namespace airybench::testing {

// The tooth of the documentation as nx×ny cells of two triangles each, their inner vertices moved a
// little (deterministically) so that nothing holds by symmetry. Roles as for the generated meshes.
Mesh small_tooth(int nx, int ny);

// A block 10 mm square as such cells, turned about the origin: "displacement:root" on its side x =
// 0, contact on x = 10, "force:bottom" and "force:top" on y = 0 and 10.
Mesh small_block(int nx, int ny, double turn_degrees);

// A plate 12 mm square with a hole in its middle, 4 mm square: 3n×3n cells without n×n. Roles as
// for the tooth; the hole is "force:hole".
Mesh small_plate(int n);

// A ring as so many cells around and across, wider outwards: "displacement:rim", "force:hole". Its
// circles are polygons, a corner of each on the x axis.
Mesh small_ring(int around, int across, double inner_mm, double outer_mm);

// A quarter of it in x, y ≥ 0: "displacement:bottom" on y = 0, "displacement:left" on x = 0,
// "force:hole", "force:rim".
Mesh quarter_ring(int around, int across, double inner_mm, double outer_mm);

// So many of these teeth side by side on a block, as in the documentation's rack.
Mesh small_rack(int teeth, int nx, int ny);

// With one role in place of another.
Mesh with_role(Mesh mesh, BoundaryRole before, BoundaryRole after);

}  // namespace airybench::testing
