#include "solvers/direct/sparse_lu.hpp"

#include <umfpack.h>

#include <array>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>

#include "solvers/base/solution.hpp"

namespace airybench {
namespace {

// Free what UMFPACK made, also where it failed half-way.
struct Symbolic {
  void* made = nullptr;
  ~Symbolic() { umfpack_di_free_symbolic(&made); }
};
struct Numeric {
  void* made = nullptr;
  ~Numeric() { umfpack_di_free_numeric(&made); }
};

void check(int status) {
  if (status == UMFPACK_ERROR_out_of_memory) throw std::bad_alloc();
  if (status < 0) throw std::logic_error("UMFPACK: status " + std::to_string(status));
}

}  // namespace

Eigen::VectorXd solve_by_sparse_lu(const SparseRows& A, const Eigen::VectorXd& b) {
  const OwnerScope scope(MemoryOwner::factor);
  SparseRows compressed;
  if (!A.isCompressed()) {
    compressed = A;
    compressed.makeCompressed();
  }
  const SparseRows& rows = A.isCompressed() ? A : compressed;
  std::array<double, UMFPACK_CONTROL> control{};
  umfpack_di_defaults(control.data());
  const auto n = static_cast<int>(rows.rows());
  // Of contacts in the plane, with few entries in a row, AMD takes half the time of METIS, which
  // follows where AMD fills much; of those in space METIS alone is faster.
  constexpr int few = 15;
  control[UMFPACK_ORDERING] =
      rows.nonZeros() < few * rows.rows() ? UMFPACK_ORDERING_CHOLMOD : UMFPACK_ORDERING_METIS;
  // UMFPACK takes columns: rows are those of the transpose.
  const int *start = rows.outerIndexPtr(), *column = rows.innerIndexPtr();
  Symbolic symbolic;
  check(umfpack_di_symbolic(n, n, start, column, rows.valuePtr(), &symbolic.made, control.data(),
                            nullptr));
  Numeric numeric;
  check(umfpack_di_numeric(start, column, rows.valuePtr(), symbolic.made, &numeric.made,
                           control.data(), nullptr));
  Eigen::VectorXd x(n);
  const int status = umfpack_di_solve(UMFPACK_At, start, column, rows.valuePtr(), x.data(),
                                      b.data(), numeric.made, control.data(), nullptr);
  check(status);
  if (status == UMFPACK_WARNING_singular_matrix)
    x.setConstant(std::numeric_limits<double>::quiet_NaN());
  return x;
}

}  // namespace airybench
