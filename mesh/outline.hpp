// Do closed polygons meet themselves or one another?
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

namespace airybench {

// Of a closed polygon of a list: from this corner to its next one.
struct PolygonEdge {
  int polygon = 0, corner = 0;
  bool operator==(const PolygonEdge&) const = default;
};

// Two edges that cross or touch although they are no neighbours, or neighbours that fold back on
// each other; none: the polygons are simple and apart. By a tree of boxes over the edges in their
// order: O(n log n) unless many edges are near to many others.
std::optional<std::array<PolygonEdge, 2>> where_they_meet(
    const std::vector<std::vector<Eigen::Vector2d>>& polygons);

}  // namespace airybench
