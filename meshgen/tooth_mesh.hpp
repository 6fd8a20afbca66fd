// The mesh of a tooth or rack.
#pragma once

#include <optional>
#include <string>

#include "mesh/mesh.hpp"
#include "meshgen/tooth_geometry.hpp"

namespace airybench {

// Needs a GmshSession. Without a number of vertices: the size field h(x) as it is (f = 1). Throws
// std::invalid_argument for impossible dimensions or counts, MeshError when no such mesh is found.
Mesh tooth_mesh(const ToothDimensions& dimensions, const EdgeCounts& edges,
                std::optional<int> vertices, const std::string& name);

}  // namespace airybench
