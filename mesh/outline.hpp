// Does a closed polygon meet itself?
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

namespace airybench {

// Two edges, by the corner that each starts at, that cross or touch although they are no
// neighbours, or neighbours that fold back on each other; none: the polygon is simple. By a tree of
// boxes over the edges in their order: O(n log n) unless many edges are near to many others.
std::optional<std::array<int, 2>> where_it_meets_itself(
    const std::vector<Eigen::Vector2d>& polygon);

}  // namespace airybench
