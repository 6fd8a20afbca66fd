// Mesh files: Gmsh's MSH 2.2 ASCII format, so that Gmsh and its readers open them as they are.
//
//   $PhysicalNames  dimension 1: displacement, force, contact, and named groups of one of these,
//                   "force:top"; dimension 2: one or more bodies
//   $Nodes          coordinates in mm; z is the same for all
//   $Elements       lines of 2 to 8 nodes (curved where they have more than 2: ends first, then
//                   the inner ones at equidistant parameters, which no triangle has) and 3-node
//                   triangles; the first tag is the physical group
//
// Other element types, further sections (parametrisations, data) and MSH 4 files are refused:
// `meshgen --convert` turns any Gmsh model with those groups into such a file.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace airybench {

// A file that is not written as above, but may be a mesh or a model of Gmsh's.
struct ForeignMeshError : MeshError {
  using MeshError::MeshError;
};

// Reads, validates and mends (mend.hpp); notes: what mend() says. Throws MeshError with one line
// "file:line: entity: what is wrong". Mesh::name is the file's name without folder and ".msh".
Mesh read_msh(const std::filesystem::path& file, std::vector<std::string>* notes = nullptr);
Mesh read_msh(std::istream& in, const std::string& file_name,
              std::vector<std::string>* notes = nullptr);

// Writes the one canonical text of a mesh: numbers from 1 in order, coordinates in the shortest
// form that reads back as the same double; equal meshes give equal bytes.
void write_msh(std::ostream& out, const Mesh& mesh);
std::string msh_text(const Mesh& mesh);

}  // namespace airybench
