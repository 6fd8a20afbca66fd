// The true shape of a model's contact faces, and what they just touch: what `bench new-scene`
// proposes and a run notes where it is missing.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "assembly/problem/scene.hpp"
#include "mesh/circle.hpp"
#include "mesh/mesh.hpp"

namespace airybench {

// Vertices in mm, with the body on the left; a closed curve ends where it begins.
using Walk = std::vector<Eigen::Vector2d>;

struct FaceCurve {
  std::vector<Walk> walks;
  std::optional<Circle> circle;  // circle_of(walks)
};

// The circle on which all vertices lie, within a millionth of its radius, as those of a meshed arc
// do. None for fewer than four vertices and sides longer than 0.9 radii, which prove nothing, and
// for what is straight.
std::optional<Circle> circle_of(const std::vector<Walk>& walks);

// The circle of all these curves, if they have one in common.
std::optional<Circle> common_circle(const std::vector<FaceCurve>& curves);

// A scene's "face".
CircularWall face_on(const Circle& circle);

// A scene's "wall" that the curves just touch: a pin in a hole, a socket around a disc, else a flat
// wall against their mean outward normal.
Wall wall_at(const std::vector<FaceCurve>& curves);

// Whether a third of the edges of one have an edge of the other in front of or behind them, facing
// them, no farther than the longer of both edges.
bool face_each_other(const std::vector<FaceCurve>& one, const std::vector<FaceCurve>& other);

// Groups of contact edges that meet a wall as the polygon of a meshed curve: the turns at their
// corners in degrees, three at least. Their peaks of stress are the polygon's, not the curve's, and
// refinement finds them.
std::map<std::string, std::vector<double>> corners_of_curves(const Mesh& mesh, const Scene& scene);

}  // namespace airybench
