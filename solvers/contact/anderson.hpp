// Gauss–Seidel with Anderson acceleration (Anderson 1965, doi:10.1145/321296.321305; Walker & Ni
// 2011, doi:10.1137/10078356X), safeguarded.
//
// With g(F) one sweep (gauss_seidel.hpp) and f_k = g(F_k) − F_k,
//
//   F_{k+1} = g(F_k) − Σ_j γ_j (g(F_{j+1}) − g(F_j)),   γ = argmin ‖f_k − Σ_j γ_j (f_{j+1} − f_j)‖
//
// over the last `memory` differences. The law is only piecewise smooth: where ‖f‖ has grown above
// twice the smallest so far, the memory is dropped and plain sweeps go on from the best F.
#pragma once

#include "solvers/contact/contact_result.hpp"

namespace airybench {

ContactResult solve_contact_by_anderson(const CondensedSystem& condensed,
                                        const ContactPoints& contact, const RunControl& control,
                                        const Eigen::VectorXd& start = {});

}  // namespace airybench
