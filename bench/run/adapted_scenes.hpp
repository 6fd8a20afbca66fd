// The levels of an adaptive loop as scenes of a plan. The loop runs in a separate process, so that
// a crash, a hang or a lack of memory does not end the run, which keeps the levels made so far.
// Each level is an ordinary mesh with a scene file:
//   OUT/meshes/SCENE/MESH+adaptK.msh   (MESH+refinedK.msh after uniform refinement;
//   for stresses of degree 2 MESH+adaptKk2.msh)
//   OUT/meshes/SCENE/MESH/SCENE.json   the scene without its changes to the mesh
#pragma once

#include "bench/plan/options.hpp"
#include "bench/plan/plan.hpp"
#include "bench/plan/scene_file.hpp"

namespace airybench {

struct AdaptedScenes {
  std::vector<PosedScene> levels;  // all, or only those that reach a goal (Adaptation::goals_only)
  std::string why_not_reached;     // one line; empty if all goals are reached
};

Method adapting_method(const std::string& name);  // throws UsageError
// The scene on the mesh that it was posed on (layers are bodies there, bonded faces inner edges):
// without what would change that mesh again.
SceneFile scene_of_level_0(const PosedScene& start);
// Prints progress to standard error. Throws UsageError, FileError, Interrupted.
AdaptedScenes adapted_scenes(const PosedScene& start, const Options& options);

// Refines level 0 uniformly once; writes the mesh next to it, MESH+refine1.msh.
PosedScene refined_scene(const PosedScene& level_0, const Options& options);

}  // namespace airybench
