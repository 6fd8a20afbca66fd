// The order of the rows of C_F and C_C: by role, edges along the boundary, ends, components.
#pragma once

#include <array>

#include "mesh/mesh.hpp"

namespace airybench {

inline constexpr std::array<BoundaryRole, 3> row_order = {
    BoundaryRole::force, BoundaryRole::contact, BoundaryRole::displacement};

template <typename Visit>
void for_each_boundary_row(const Mesh& mesh, const Visit& visit) {
  for (const BoundaryRole role : row_order)
    for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row)
      if (mesh.boundary[row].role == role) visit(row);
}

}  // namespace airybench
