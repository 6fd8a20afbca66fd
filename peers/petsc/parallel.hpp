// Operations of all ranks: exchange records, sum small arrays, agree on failures.
#pragma once

#include <petscksp.h>
#include <petscsf.h>

#include <Eigen/Core>
#include <array>
#include <iostream>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace airybench::parallel {

inline std::string& said_by_petsc() {
  static std::string said;
  return said;
}
inline PetscErrorCode keep_what_is_said(MPI_Comm, int, const char* function, const char*,
                                        PetscErrorCode code, PetscErrorType type,
                                        const char* message, void*) {
  if (type == PETSC_ERROR_INITIAL || said_by_petsc().empty())
    said_by_petsc() = std::string(function) + ": " + message;
  return code;
}

// After an error PETSc is unusable, even for destroying objects: print one line and abort.
inline void check(PetscErrorCode error) {
  if (error == 0) return;
  std::cerr << "hybrid-petsc: PETSc: " << said_by_petsc() << '\n' << std::flush;
  MPI_Abort(PETSC_COMM_WORLD, 3);
}

template <typename Handle, PetscErrorCode (*destroy)(Handle*)>
class Owned {
 public:
  Owned() = default;
  ~Owned() { destroy(&handle_); }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  Owned(Owned&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
  Owned& operator=(Owned&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  operator Handle() const { return handle_; }
  Handle* put() { return &handle_; }

 private:
  Handle handle_ = nullptr;
};
using OwnedMat = Owned<Mat, MatDestroy>;
using OwnedVec = Owned<Vec, VecDestroy>;
using OwnedKsp = Owned<KSP, KSPDestroy>;
using OwnedSf = Owned<PetscSF, PetscSFDestroy>;

inline std::optional<std::string> option(const std::string& name) {
  std::array<char, 256> value{};
  PetscBool given = PETSC_FALSE;
  check(PetscOptionsGetString(nullptr, nullptr, name.c_str(), value.data(), value.size(), &given));
  if (given == PETSC_FALSE) return std::nullopt;
  return value.data();
}

// Shares the memory of `values`.
inline OwnedVec as_vec(const Eigen::VectorXd& values) {
  OwnedVec vec;
  check(VecCreateMPIWithArray(PETSC_COMM_WORLD, 1, static_cast<PetscInt>(values.size()),
                              PETSC_DETERMINE, values.data(), vec.put()));
  return vec;
}

inline int rank_here() {
  int rank = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  return rank;
}
inline int rank_count() {
  int count = 1;
  MPI_Comm_size(PETSC_COMM_WORLD, &count);
  return count;
}

// Rank r has the rows from ⌊total r / ranks⌋ on.
inline PetscInt slice_begin(PetscInt total, int rank) {
  return static_cast<PetscInt>(static_cast<std::int64_t>(total) * rank / rank_count());
}
inline int slice_owner(PetscInt total, PetscInt row) {
  return static_cast<int>(((static_cast<std::int64_t>(row) + 1) * rank_count() - 1) / total);
}

// Sends record k to rank to[k]. Results are ordered by sender, then as sent.
template <typename Record>
std::vector<Record> exchanged(const std::vector<Record>& records, const std::vector<int>& to) {
  const auto ranks = static_cast<std::size_t>(rank_count());
  std::vector<int> out(ranks, 0), in(ranks), out_at(ranks + 1, 0), in_at(ranks + 1, 0);
  for (const int rank : to) ++out[rank];
  MPI_Alltoall(out.data(), 1, MPI_INT, in.data(), 1, MPI_INT, PETSC_COMM_WORLD);
  std::partial_sum(out.begin(), out.end(), out_at.begin() + 1);
  std::partial_sum(in.begin(), in.end(), in_at.begin() + 1);
  std::vector<Record> sorted(records.size()), result(static_cast<std::size_t>(in_at.back()));
  std::vector<int> next = out_at;
  for (std::size_t k = 0; k < records.size(); ++k) sorted[next[to[k]]++] = records[k];
  MPI_Datatype type;
  MPI_Type_contiguous(sizeof(Record), MPI_BYTE, &type);
  MPI_Type_commit(&type);
  MPI_Alltoallv(sorted.data(), out.data(), out_at.data(), type, result.data(), in.data(),
                in_at.data(), type, PETSC_COMM_WORLD);
  MPI_Type_free(&type);
  return result;
}

inline void assemble(Mat matrix) {
  check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
}

// Maps every local value to its row of a distributed array with `own` rows on this rank.
inline OwnedSf rows_of(PetscInt own, const std::vector<PetscInt>& row_of_value) {
  OwnedSf forest;
  PetscLayout layout = nullptr;
  check(PetscLayoutCreateFromSizes(PETSC_COMM_WORLD, own, PETSC_DETERMINE, 1, &layout));
  check(PetscSFCreate(PETSC_COMM_WORLD, forest.put()));
  check(PetscSFSetGraphLayout(forest, layout, static_cast<PetscInt>(row_of_value.size()), nullptr,
                              PETSC_COPY_VALUES, row_of_value.data()));
  check(PetscLayoutDestroy(&layout));
  return forest;
}
struct FourNumbers {
  MPI_Datatype type;
  FourNumbers() {
    MPI_Type_contiguous(4, MPI_DOUBLE, &type);
    MPI_Type_commit(&type);
  }
  ~FourNumbers() { MPI_Type_free(&type); }
};

// Rows to their values; values reduced to their rows.
inline void to_values(PetscSF forest, MPI_Datatype type, const void* rows, void* values) {
  check(PetscSFBcastBegin(forest, type, rows, values, MPI_REPLACE));
  check(PetscSFBcastEnd(forest, type, rows, values, MPI_REPLACE));
}
inline void to_rows(PetscSF forest, MPI_Datatype type, const void* values, void* rows, MPI_Op op) {
  check(PetscSFReduceBegin(forest, type, values, rows, op));
  check(PetscSFReduceEnd(forest, type, values, rows, op));
}

inline Eigen::VectorXd sum(Eigen::VectorXd values) {
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM,
                PETSC_COMM_WORLD);
  return values;
}
inline double sum(double value) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  return value;
}
inline double largest(double value) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD);
  return value;
}

// Runs work that does not communicate. If it fails on a rank, all ranks throw that error.
template <typename Work>
void each_by_itself(Work work) {
  std::string wrong;
  try {
    work();
  } catch (const std::exception& failure) {
    wrong = failure.what();
  }
  int who = wrong.empty() ? rank_count() : rank_here();
  MPI_Allreduce(MPI_IN_PLACE, &who, 1, MPI_INT, MPI_MIN, PETSC_COMM_WORLD);
  if (who == rank_count()) return;
  wrong.resize(500, '\0');
  MPI_Bcast(wrong.data(), static_cast<int>(wrong.size()), MPI_CHAR, who, PETSC_COMM_WORLD);
  throw std::runtime_error(wrong.c_str());
}

}  // namespace airybench::parallel
