// Point supports against the free motions that they take out.
//
//   B a = d − u(p)   with rows N_m(p)·e_k of B, one for each component that is held
#pragma once

#include <vector>

#include "assembly/problem/scene.hpp"

namespace airybench {

struct HeldPoints {
  struct Row {
    Eigen::Vector2d at_mm;
    int component;
    double displacement_mm;  // d
    PlaceInMesh place;
  };
  std::vector<Row> rows;
  Eigen::MatrixXd of_motions;  // B, rows × Problem::free.motions
};
HeldPoints held_points(const Problem& problem);

// Of rows of B on some motions.
bool are_independent(const Eigen::MatrixXd& rows);

// Refuses points off the mesh or in several bodies, and those that hold nothing.
void check_point_supports(const Scene& scene, const Mesh& mesh);
// Refuses points that hold what displacement edges or other points hold, and bodies without contact
// edges that points leave free to move.
void check_point_supports(const Scene& scene, const std::string& prefix, const Problem& problem);

}  // namespace airybench
