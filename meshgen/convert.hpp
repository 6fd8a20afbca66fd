// A user's Gmsh model as a mesh of ours.
//
// The model (.geo, .msh of any version, .step and whatever else Gmsh opens) needs physical curves
// named displacement (at least one), force, contact, or one of these with a name, "force:top",
// which together make the whole boundary, and one or more physical surfaces, each a body of its own
// material. Other names take such a label by ModelOptions::roles. A CAD file has no physical
// groups: its surfaces are one body, and its curves go by their numbers. The model is meshed if it
// holds no surface mesh yet. Other physical groups are left aside; so are surfaces in no physical
// group. Of elements of higher order the corners are kept.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "meshgen/model_options.hpp"

namespace airybench {

struct ConvertedModel {
  Mesh mesh;
  std::vector<std::string> notes;  // what the user should know of it, a line each
};

// Opens a GmshSession of its own (none may live), because a model may set Gmsh's options. Nodes of
// no triangle are dropped, vertices numbered in the order of Gmsh's node numbers, triangles turned
// counter-clockwise, boundary edges walked with the body on the left; coordinates are kept as they
// are, in mm. A surface group without a name becomes "body", or "body<number>" when there are
// several groups. The result is valid. Throws MeshError, one line "file: what is wrong", with
// Gmsh's own message where it fails.
ConvertedModel convert_model(const std::filesystem::path& model, const ModelOptions& options = {});

}  // namespace airybench
