// The flexibility matrix S_ij = ∫ σ(φ_i):C:σ(φ_j) over the body.
#pragma once

#include <Eigen/SparseCore>

#include "assembly/dof_numbering.hpp"

namespace airybench {

// The lower triangle of S, n×n in the given numbering, columns sorted. The node graph gives the
// pattern; element matrices are added in place. node_position: as given to number_dofs().
Eigen::SparseMatrix<double> assemble_flexibility(const Problem& problem, const DofNumbering& dofs,
                                                 const NodeGraph& graph,
                                                 const std::vector<int>& node_position);

// Scales a lower triangle to unit diagonal, S ← diag(d) S diag(d); returns d = 1/√S_ii. Throws
// std::domain_error when a diagonal entry is not positive and finite.
Eigen::VectorXd equilibrate(Eigen::SparseMatrix<double>& S);

}  // namespace airybench
