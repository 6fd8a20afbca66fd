#include "solvers/direct/mumps.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <new>
#include <numeric>
#include <string>

namespace airybench {
namespace {

constexpr int max_extra_workspace = 5000;  // per cent

enum Symmetric { positive_definite = 1, indefinite = 2 };
enum Job { start = -1, finish = -2, analysis = 1, factorisation = 2, solution = 3 };

// MUMPS's arrays count from 1.
constexpr std::size_t no(int number) { return static_cast<std::size_t>(number - 1); }

// ICNTL(26): the whole system, or its halves around the Schur complement.
enum SolveKind { whole = 0, reduction = 1, expansion = 2 };

// Workspace that is too small because pivots were delayed: more of it helps.
bool wants_more_workspace(int info) {
  constexpr std::array codes = {-8, -9, -11, -14, -15, -17, -20};
  return std::find(codes.begin(), codes.end(), info) != codes.end();
}

bool is_out_of_memory(int info) { return info == -5 || info == -7 || info == -13; }

// MUMPS 5.5 reads outside its arrays when it is given what is not finite.
void require_finite(const Eigen::SparseMatrix<double>& matrix) {
  if (!Eigen::Map<const Eigen::ArrayXd>(matrix.valuePtr(), matrix.nonZeros()).allFinite())
    throw Breakdown("MUMPS: the matrix is not finite");
}

// Large numbers of INFO and INFOG: in millions where negative.
std::size_t large(int value) {
  return value < 0 ? static_cast<std::size_t>(-std::int64_t{value}) * 1000000
                   : static_cast<std::size_t>(value);
}

}  // namespace

MumpsFactor::MumpsFactor(Definite definite) {
  mumps_.sym = definite == Definite::yes ? positive_definite : indefinite;
  mumps_.par = 1;
  mumps_.comm_fortran = -987654;  // MPI_COMM_WORLD of the sequential stub
  call(start, "the start");
  for (const int output : {1, 2, 3, 4}) mumps_.icntl[no(output)] = 0;  // silent
  // Approximate minimum fill: as little fill as Scotch's nested dissection here, in less time, and
  // without a library that may not survive a refused allocation. With a Schur complement MUMPS
  // takes another minimum degree instead.
  mumps_.icntl[no(7)] = 2;
  // By default, where indefinite: scaling (8) and 2×2 pivots prepared in the analysis (6, 12) as
  // MUMPS sees fit, pivots from 0.01 of their column on (CNTL(1)), no iterative refinement (10). A
  // row that elimination leaves below CNTL(3) of the matrix's norm is counted as a null pivot.
  mumps_.icntl[no(24)] = 1;
  mumps_.cntl[no(3)] = 1e-15;
  mumps_.icntl[no(27)] = columns_at_once;
}

MumpsFactor::~MumpsFactor() {
  mumps_.job = finish;
  dmumps_c(&mumps_);
}

void MumpsFactor::call(int job, const char* doing) {
  const OwnerScope scope(MemoryOwner::factor);
  for (int& extra = mumps_.icntl[no(14)];; extra *= 2) {  // workspace beyond the estimate, per cent
    mumps_.job = job;
    dmumps_c(&mumps_);
    if (!wants_more_workspace(mumps_.infog[no(1)]) || extra > max_extra_workspace) break;
  }
  const int info = mumps_.infog[no(1)], detail = mumps_.infog[no(2)];
  if (info >= 0) return;
  if (is_out_of_memory(info)) throw std::bad_alloc();
  if (info == -10)
    throw Breakdown("MUMPS: the matrix is singular to rounding after " + std::to_string(detail) +
                    " pivots");
  throw Breakdown(std::string("MUMPS: ") + doing + " ended with INFOG(1) = " +
                  std::to_string(info) + ", INFOG(2) = " + std::to_string(detail));
}

void MumpsFactor::analyse(const Eigen::SparseMatrix<double>& lower, int trailing) {
  const int n = static_cast<int>(lower.rows());
  if (n == 0) return;  // nothing to solve
  require_finite(lower);
  const OwnerScope scope(MemoryOwner::factor);
  const auto entries = static_cast<std::size_t>(lower.nonZeros());
  rows_.reserve(entries);
  columns_.reserve(entries);
  for (int column = 0; column < n; ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(lower, column); entry; ++entry) {
      rows_.push_back(static_cast<int>(entry.row()) + 1);
      columns_.push_back(column + 1);
    }
  mumps_.n = n;
  mumps_.nnz = static_cast<MUMPS_INT8>(entries);
  mumps_.irn = rows_.data();
  mumps_.jcn = columns_.data();
  mumps_.a = const_cast<double*>(lower.valuePtr());  // is only read
  std::vector<int> last(static_cast<std::size_t>(trailing));
  std::iota(last.begin(), last.end(), n - trailing + 1);
  if (trailing > 0) {
    mumps_.icntl[no(19)] = 2;  // its lower triangle by columns, on a grid of one process
    mumps_.nprow = mumps_.npcol = 1;
    mumps_.mblock = mumps_.nblock = 100;
    mumps_.size_schur = trailing;
    mumps_.listvar_schur = last.data();
  }
  schur_.setZero(trailing, trailing);
  call(analysis, "the analysis");
  mumps_.listvar_schur = nullptr;
}

void MumpsFactor::factor(const Eigen::SparseMatrix<double>& lower) {
  if (mumps_.n == 0) return;
  require_finite(lower);
  mumps_.a = const_cast<double*>(lower.valuePtr());
  mumps_.schur = schur_.data();
  mumps_.schur_lld = static_cast<int>(schur_.rows());
  call(factorisation, "the factorisation");
  if (const int null_pivots = mumps_.infog[no(28)]; null_pivots > 0)
    throw Breakdown("MUMPS: the matrix is singular to rounding, with " +
                    std::to_string(null_pivots) + " null pivots");
  if (mumps_.sym == positive_definite && negative_pivots() > 0)
    throw Breakdown("MUMPS: the matrix is not positive definite, with " +
                    std::to_string(negative_pivots()) + " negative pivots");
  schur_.triangularView<Eigen::StrictlyUpper>() = schur_.transpose();
}

void MumpsFactor::solve_in_place(Eigen::Ref<Eigen::MatrixXd> X, const Deadline& deadline) {
  for (Eigen::Index j = 0; j < X.cols(); j += columns_at_once) {
    solve(whole, X.middleCols(j, std::min(Eigen::Index{columns_at_once}, X.cols() - j)));
    deadline.check("the solves with MUMPS's factor");
  }
}

Eigen::VectorXd MumpsFactor::reduce(const Eigen::VectorXd& b) {
  Eigen::VectorXd work = b, reduced(mumps_.size_schur);
  mumps_.redrhs = reduced.data();
  mumps_.lredrhs = static_cast<int>(reduced.size());
  solve(reduction, work);
  return reduced;
}

Eigen::VectorXd MumpsFactor::expand(const Eigen::VectorXd& x_C) {
  Eigen::VectorXd x(mumps_.n), given = x_C;
  mumps_.redrhs = given.data();
  mumps_.lredrhs = static_cast<int>(given.size());
  solve(expansion, x);
  return x;
}

int MumpsFactor::negative_pivots() const { return mumps_.infog[no(12)]; }

std::size_t MumpsFactor::bytes() const {
  // Trees, orderings and scaling that the analysis leaves: 23 to 29 integers per unknown.
  constexpr std::size_t of_analysis = 24;
  // INFO(7): integer workspace by the analysis, before ICNTL(14) is added; INFO(39): real one.
  const std::size_t integers =
      large(mumps_.info[no(7)]) * static_cast<std::size_t>(100 + mumps_.icntl[no(14)]) / 100 +
      of_analysis * static_cast<std::size_t>(mumps_.n) + rows_.size() + columns_.size();
  const std::size_t doubles = large(mumps_.info[no(39)]) + static_cast<std::size_t>(schur_.size());
  return doubles * sizeof(double) + integers * sizeof(int);
}

std::int64_t MumpsFactor::entries() const {
  return static_cast<std::int64_t>(large(mumps_.infog[no(29)]));
}

double MumpsFactor::flops() const { return mumps_.rinfog[no(3)]; }

void MumpsFactor::solve(int kind, Eigen::Ref<Eigen::MatrixXd> X) {
  if (mumps_.n == 0) return;
  mumps_.icntl[no(26)] = kind;
  mumps_.rhs = X.data();
  mumps_.nrhs = static_cast<int>(X.cols());
  mumps_.lrhs = static_cast<int>(X.outerStride());
  call(solution, "a solve");
}

}  // namespace airybench
