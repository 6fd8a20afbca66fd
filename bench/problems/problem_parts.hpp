// From the arrays of a file, FCLIB or text, to a contact problem: what every format checks alike.
#pragma once

#include <functional>
#include <string>

#include "assembly/contact_problem.hpp"

namespace airybench {

// Throws FileError: the file, place, what is there, what is allowed.
using Refuse = std::function<void(const std::string& place, const std::string& what,
                                  const std::string& allowed)>;

inline constexpr int max_contact_rows = 1'000'000;  // of W, columns of H
inline constexpr int max_unknowns = 1'000'000;      // rows of M

// d rows of W, columns of H, per contact.
void check_rows(int rows, int dimension, const std::string& place, const Refuse& refuse);

// μ: 0 to 1e6.
ContactPoints points_of(int dimension, const Eigen::VectorXd& mu, const std::string& place,
                        const Refuse& refuse);

// u = W r + q. W must have positive diagonal entries, and be symmetric to 1 % of the largest; what
// differs is kept. The diagonal and the largest of q (unless it is 0) must be 1e-50 to 1e50, other
// entries of W up to 1e50. place: of W.
contact::Problem local_problem(SparseRows W, Eigen::VectorXd q, ContactPoints points,
                               const std::string& place, const Refuse& refuse);

// M v = H r + f, u = Hᵀ v + w: condensed (solvers/condensation/global_problem.hpp). M, which counts
// as symmetric where W does, must be positive definite, and every column of H move something. W
// and q have the range of local problems.
struct GlobalArrays {
  Eigen::SparseMatrix<double> M, H;
  Eigen::VectorXd f, w;
};
contact::Problem global_problem(GlobalArrays arrays, ContactPoints points,
                                const std::string& place_of_M, const std::string& place_of_H,
                                const Refuse& refuse);

}  // namespace airybench
