// Exact elastic solutions that are quadratic in the displacement, for patch tests.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "assembly/displacement_field.hpp"
#include "assembly/problem/problem.hpp"
#include "assembly/stress_field.hpp"

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

// The largest deviations from an exact field, relative to its largest value: of a stress at every
// corner of its parts; of w + ρ at every vertex and every edge's middle.
double stress_deviation(const Problem& problem, const StressField& stress, const ExactField& exact);
double displacement_deviation(const Problem& problem, const DisplacementField& w,
                              const ExactField& exact);

}  // namespace airybench::testing
