// The curve that a contact face of straight edges stands for.
#pragma once

#include <optional>
#include <string>

#include "assembly/problem/scene.hpp"

namespace airybench {

// What a contact edge stands for: the curve that the scene gives its group, or else the circle
// through the ends and the middle of the mesh's own curve; none: itself.
std::optional<Wall> curve_of(const Mesh& mesh, int boundary_row, const Scene& scene);

// At x on an edge of normal m that stands for the curve; m where the curve has none.
Eigen::Vector2d normal_of_curve(const Wall& curve, const Eigen::Vector2d& x,
                                const Eigen::Vector2d& m);

// Throws TransformError if the curve that a contact edge stands for is farther from it.
void check_face(const Mesh& mesh, int row, const std::string& label, const Wall& face,
                double allowed_mm);
inline constexpr double max_of_face = 0.05;  // of the mesh's size

}  // namespace airybench
