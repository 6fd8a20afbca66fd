// What is free at each contact point under the law that an active set takes it to follow
// (active_set.hpp): the unknowns of its linear system.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "assembly/contact_problem.hpp"

namespace airybench {

// An unknown z of the linear system, at one point: F changes by z · force; in return
// r_component + diagonal · z = −rest there, or, across a slip, force · r in place of a component.
struct Freedom {
  int first;  // row of the point
  int component;
  Eigen::Vector3d force;
  double diagonal = 0, rest = 0;
};
constexpr int across_slip = -1;

// Under the laws of the trial F − ρ r; F takes the forces that they prescribe.
std::vector<Freedom> freedoms_of(const ContactPoints& contact, const Eigen::VectorXd& D_diagonal,
                                 const Eigen::VectorXd& trial, Eigen::VectorXd& F);

// Of displacements: what a freedom's equation is about.
inline double relation(const Freedom& of, int components, const Eigen::VectorXd& at) {
  return of.component == across_slip
             ? of.force.head(components).dot(at.segment(of.first, components))
             : at(of.first + of.component);
}

}  // namespace airybench
