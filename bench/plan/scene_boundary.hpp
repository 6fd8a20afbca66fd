// "boundary" of a scene file: what is prescribed on groups of boundary edges.
//
//   { "force:top":          { "pressure_MPa": 50 },
//     "force:left":         { "traction_MPa": { "at_mm": [[0, 0], [0, 40]],
//                                               "values": [[150, 0], [100, 0]] } },
//     "displacement:right": { "support": "normal", "displacement_mm": [0.01, 0] },
//     "contact:flank":      { "friction": 0.1, "wall": { … } } }  (scene_wall.hpp)
#pragma once

#include "bench/plan/scene_reader.hpp"

namespace airybench {

BoundaryConditions read_boundary(const SceneReader& reader, const std::string& key,
                                 const Json& json);

}  // namespace airybench
