// Sparse LU with threshold pivoting by UMFPACK (Davis 2004, doi:10.1145/992200.992206), in
// METIS' order of nested dissection, or AMD's where rows are short, and refined.
#pragma once

#include "assembly/contact_problem.hpp"

namespace airybench {

// A⁻¹ b; not finite where A is singular to the last bit. A has sorted columns in its rows. Throws
// std::bad_alloc.
Eigen::VectorXd solve_by_sparse_lu(const SparseRows& A, const Eigen::VectorXd& b);

}  // namespace airybench
