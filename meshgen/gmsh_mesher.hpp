// Triangulates the inside of a boundary polygon with Gmsh.
//
// Gmsh's library is one global state: a GmshSession must live while these functions run, and there
// is at most one. It is silent, single-threaded and reads no configuration of the user, so that a
// mesh depends on its arguments and Gmsh's version alone.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "mesh/mesh.hpp"
#include "meshgen/tooth_geometry.hpp"

namespace airybench {

class GmshSession {
 public:
  // constants: numbers in place of those that a .geo defines by DefineConstant under these names;
  // Gmsh keeps them for later sessions of the process.
  explicit GmshSession(const std::map<std::string, double>& constants = {});
  ~GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;
};

// The library's version, "4.8.4"; needs a session, as everything here.
std::string gmsh_version();
std::string version_of_gmsh();  // the same, where no session lives

// The message of the exception being handled, which Gmsh threw: a std::string, since 4.9 a
// std::runtime_error. Others, InputError among them, are thrown on.
std::string message_of_gmsh();

enum class MeshAlgorithm { delaunay = 5, frontal_delaunay = 6 };  // Gmsh's own numbers

// What can be varied inside, the boundary edges being given.
struct InteriorRecipe {
  MeshAlgorithm algorithm = MeshAlgorithm::frontal_delaunay;
  double size_factor = 1;       // f in f·h(x)
  double grading_exponent = 1;  // of ξ in h(x)
};

// The polygon's edges unchanged and first in the vertex numbering, one body "body". Throws
// MeshError "name: what Gmsh says" when Gmsh fails.
Mesh mesh_interior(const BoundaryPolygon& polygon, const SizeField& size,
                   const InteriorRecipe& recipe, const std::string& name);

}  // namespace airybench
