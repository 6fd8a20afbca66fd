// Scene files: JSON with the keys of the struct Scene; missing keys take its defaults.
//
//   { "teeth": 1, "root_half_height_mm": 5, "length_mm": 10, "tip_half_height_mm": 3,
//     "young_MPa": 210000, "poisson": 0.3, "plane": "strain", "friction": 0.2,
//     "crown_radius_mm": 400, "clearance_mm": 0,
//     "displacement_mm": [0.02, 0.006], "body_force_N_per_mm3": [0, 0],
//     "boundary": { "force": { "pressure_MPa": 3 } },
//     "load_steps": [ { "displacement_mm": [0.02, 0] }, { "clearance_mm": 0.001 } ],
//     "materials": { "a body's name": { "young_MPa": 70000, "poisson": 0.33 } },
//     "mesh": { "refine": 1, "grade": { "at_mm": [10, 0], "ratio": 100 },
//               "slivers": { "aspect": 1000, "count": 5 }, "scale": 1, "stretch": [1, 1],
//               "move_mm": [0, 0], "keep_contact_edges": 4, "keep_displacement_edges": 2,
//               "keep_force_edges": 0 },
//     "layers": { "normal": [1, 0], "count": 4, "materials": [ {}, { "young_MPa": 21 } ] },
//     "group": "layered", "about": "any one sentence" }
//
// "crown_radius_mm": null is a flat wall; "plane" is "strain" or "stress"; layers may have
// "interfaces_mm": [ ... ] instead of "count"; load_steps may be a number. "boundary":
// scene_boundary.hpp; "wall" and "face", instead of a crown: scene_wall.hpp.
#pragma once

#include <filesystem>

#include "assembly/scene.hpp"

namespace airybench {

// definition: its JSON on one line, with what it has from other files in it.
struct SceneFile {
  Scene scene;
  std::string definition = "{}";
};
// Throws SceneError, one line: file, key, value, what is allowed. Scene::name is the file's stem.
SceneFile read_scene_file(const std::filesystem::path& file);
Scene read_scene(const std::filesystem::path& file);
// The crown is the catalogue's: on another body a scene that says nothing of it has a flat wall.
SceneFile on_other_bodies(SceneFile file);
// The same of a scene file's text; place is what messages name.
Scene scene_of(const std::string& text, const std::string& place);

}  // namespace airybench
