// The levels of an adaptive loop as scenes of a plan.
//
// The loop runs in a separate process: a crash, a hang or a lack of memory ends the loop and not
// the run, which has the levels before. Each level's mesh is a file
//   OUT/meshes/SCENE/MESH+adaptK.msh      (refined everywhere: MESH+refinedK.msh)
// and the scene on it is OUT/meshes/SCENE/SCENE.json: the scene's file without what it did to the
// mesh. With these two a level is a mesh as any other.
#pragma once

#include "bench/plan/options.hpp"
#include "bench/plan/plan.hpp"

namespace airybench {

struct AdaptedScenes {
  std::vector<PosedScene> levels;  // those that options.levels asks for
  std::string why_not_reached;     // one line; empty: the goal is reached
};

// Adapts the mesh of a posed scene until options.adapt. Prints a line per level to standard error.
// Throws UsageError (the method that adapts), FileError, Interrupted.
AdaptedScenes adapted_scenes(const PosedScene& start, const Options& options);

// Level 0 refined once everywhere, as a mesh file next to it: MESH+refined1.msh.
PosedScene refined_scene(const PosedScene& level_0, const Options& options);

}  // namespace airybench
