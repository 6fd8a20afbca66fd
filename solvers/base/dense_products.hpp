// Products of dense matrices, and solves with triangular ones, by BLAS: its kernels are those of
// the processor that the program runs on, Eigen's those of the one that it was compiled for. One
// column is a vector to BLAS. Nothing is copied or allocated but the results that are returned.
#pragma once

#include <Eigen/Core>

namespace airybench {

using DenseBlock = Eigen::Ref<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
using ConstDenseBlock = Eigen::Ref<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

Eigen::VectorXd times(const ConstDenseBlock& A, const Eigen::VectorXd& x);             // A x
Eigen::VectorXd transposed_times(const ConstDenseBlock& A, const Eigen::VectorXd& x);  // Aᵀ x

// C ← C + factor A B, with A Bᵀ, with Aᵀ B.
void add_product(double factor, const ConstDenseBlock& A, const ConstDenseBlock& B, DenseBlock C);
void add_times_transposed(double factor, const ConstDenseBlock& A, const ConstDenseBlock& B,
                          DenseBlock C);
void add_transposed_times(double factor, const ConstDenseBlock& A, const ConstDenseBlock& B,
                          DenseBlock C);

constexpr int few_rows = 64;  // up to these twice the work of dgemm takes less time than dsyrk

// C ← C + factor A Aᵀ in the lower triangle. What is above is not read, and lost.
void add_square(double factor, const ConstDenseBlock& A, DenseBlock C);

// L is the lower triangle of a matrix; unit: its diagonal counts as ones, whatever is there.
enum class Diagonal { given, unit };

void solve_lower(const ConstDenseBlock& L, DenseBlock X, Diagonal = Diagonal::given);  // L⁻¹ X
void solve_lower_transposed(const ConstDenseBlock& L, DenseBlock X,                    // L⁻ᵀ X
                            Diagonal = Diagonal::given);
void solve_lower_transposed_right(const ConstDenseBlock& L, DenseBlock X,  // X L⁻ᵀ
                                  Diagonal = Diagonal::given);

}  // namespace airybench
