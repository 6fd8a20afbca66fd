// A user's Gmsh model as a mesh of ours.
//
// The model (model_format.hpp) is one or more surfaces in a plane. Its physical surfaces, or all of
// its surfaces, are bodies, each of its own material. Every curve of the boundary has a role: by
// the physical curves named displacement (at least one), force, contact, or one of these with a
// name, "force:top", or by ModelOptions::roles; else it is free. The model is meshed if it holds no
// surface mesh yet. Other physical groups are left aside.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "meshgen/model_options.hpp"
#include "meshgen/open_model.hpp"
#include "meshgen/plane_model.hpp"

namespace airybench {

struct ConvertedModel {
  Mesh mesh;
  std::vector<std::string> notes;  // for the user, a line each without the file's name
};

// Opens a GmshSession (none may live), because a model may set Gmsh's options. Nodes of no triangle
// are dropped, vertices numbered in the order of Gmsh's node numbers, triangles turned
// counter-clockwise, boundary edges walked with the body on the left. A surface, or group of them,
// without a name becomes "body", or "body<number>" when there are several. The result is valid.
// Throws MeshError, one line "file: what is wrong", with Gmsh's own message where it fails; where
// no curve is held, a table of the curves follows.
ConvertedModel convert_model(const std::filesystem::path& model, const ModelOptions& options = {},
                             const AboutToMesh& about_to_mesh = {});

// The model's triangles and its curves with their roles, which need not be a body.
PlaneModel read_model(const std::filesystem::path& file, const ModelOptions& options,
                      const AboutToMesh& about_to_mesh, std::vector<std::string>& notes);

}  // namespace airybench
