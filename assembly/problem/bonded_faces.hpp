// Faces of bodies that are bonded: they have the same displacements, and any tractions.
//
// The two meshes are made to match (matched_faces.hpp), vertices that face each other become one,
// half way between them, and their edges inner ones. So bonded bodies are one piece of several
// materials, for every method, degree and bound; the ends of a bonded part within an interface are
// tips of cracks.
#pragma once

#include "assembly/problem/scene.hpp"

namespace airybench {

// Takes a valid mesh. Throws TransformError, "contacts: …": as with_matched_faces(), and for faces
// that are apart by more than a tenth of an edge, or a boundary that would touch itself.
Mesh with_bonded_faces(Mesh mesh, const Scene& scene);

}  // namespace airybench
