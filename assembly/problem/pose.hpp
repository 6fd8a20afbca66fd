// From a scene and a mesh to the problem that is solved.
#pragma once

#include "assembly/problem/problem.hpp"
#include "assembly/problem/scene.hpp"

namespace airybench {

// Transforms the mesh and poses the scene on it. Contact edges that cannot reach their wall become
// free. A crown needs faces with ends. Throws SceneError. Problem::later_steps has the load steps
// after the first.
Problem pose(const Scene& scene, Mesh mesh);

}  // namespace airybench
