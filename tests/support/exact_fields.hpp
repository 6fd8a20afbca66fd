// Exact elastic solutions that are quadratic in the displacement, for patch tests.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "assembly/problem.hpp"

namespace airybench::testing {

struct ExactField {
  std::string name;
  Eigen::Vector2d body_force;
  std::function<Eigen::Vector3d(const Eigen::Vector2d&)> stress;        // xx, yy, xy
  std::function<Eigen::Vector2d(const Eigen::Vector2d&)> displacement;  // mm
};

// For plane stress with the given E and ν: constant stress with a rotation, bending in either
// direction, a shear that varies, a bar under its own weight.
std::vector<ExactField> exact_fields(double young, double poisson);

// The boundary data that make `field` the solution.
Loads loads_of(const ExactField& field);

}  // namespace airybench::testing
