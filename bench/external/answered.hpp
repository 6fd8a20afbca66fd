// From what somebody else's solver returns, a program or a function, to a Solution.
#pragma once

#include "assembly/airy_system.hpp"
#include "solvers/base/method.hpp"

namespace airybench {

// φ and the stresses of the unknowns x of the Airy system.
void take_airy_unknowns(const AirySystem& system, const Eigen::VectorXd& x, Solution& solution);

// u at vertices and then at the middles of edges, mm, quadratic: rows x, y. Stresses, and contact
// forces at the control points.
void take_displacement(const Problem& problem, const Eigen::MatrixX2d& u,
                       const ProgramTolerances& tolerances, Solution& solution);

// Functions of this process as methods. They throw std::exception to give up.
using ContactLaw = std::function<Eigen::VectorXd(const contact::Problem&)>;     // F_C, N
using AiryUnknowns = std::function<Eigen::VectorXd(const AirySystem&)>;         // x
using QuadraticDisplacement = std::function<Eigen::MatrixX2d(const Problem&)>;  // as above
// In place of HYBRID's contact law, load step by load step; without a body alone.
Method contact_law_method(ContactLaw law, const std::string& name, const std::string& summary,
                          int degree = 1);
Method airy_method(AiryUnknowns solve, const std::string& name, const std::string& summary);
Method displacement_method(QuadraticDisplacement solve, const ProgramTolerances& tolerances,
                           const std::string& name, const std::string& summary);

}  // namespace airybench
