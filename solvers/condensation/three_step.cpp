#include "solvers/condensation/three_step.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "solvers/direct/dense_factors.hpp"

namespace airybench {

SparseRows::InnerIterator constraint_row(const AirySystem& system, int k) {
  return k < system.n_f() ? SparseRows::InnerIterator(system.C_F, k)
                          : SparseRows::InnerIterator(system.C_C, k - system.n_f());
}

namespace {

// Rows of [C_F; C_C] in the order of their first unknown, so that neighbouring right-hand sides
// share their leading zeros.
std::vector<int> rows_by_first_unknown(const AirySystem& system) {
  std::vector<int> rows(static_cast<std::size_t>(system.n_f() + system.n_c()));
  std::iota(rows.begin(), rows.end(), 0);
  std::vector<int> first(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto entry = constraint_row(system, static_cast<int>(k));
    first[k] = entry ? static_cast<int>(entry.col()) : 0;
  }
  std::stable_sort(rows.begin(), rows.end(), [&](int a, int b) { return first[a] < first[b]; });
  return rows;
}

// Step 1: X where it is kept, and K in the order of [C_F; C_C].
Eigen::MatrixXd solve_for_multipliers(const AirySystem& system, const SolveInPlace& solve,
                                      const KeepX& keep, ThreeStep& steps) {
  const int n_f = system.n_f(), n_c = system.n_c(), columns = n_f + n_c;
  const bool kept = keep.where != KeepX::Where::nowhere;
  const int batch = kept ? columns : std::min(keep.batch, columns);
  ColumnStore store(
      system.n(), batch,
      keep.where == KeepX::Where::file ? ColumnStore::Place::file : ColumnStore::Place::memory);
  Eigen::MatrixXd K(columns, columns);
  for (int begin = 0; begin < columns; begin += batch) {
    auto X = store.matrix().leftCols(std::min(batch, columns - begin));
    if (begin > 0) X.setZero();
    for (int k = 0; k < X.cols(); ++k)
      for (auto entry = constraint_row(system, steps.row_of_column[begin + k]); entry; ++entry)
        X(entry.col(), k) = entry.value();
    solve(X);
    for (int k = 0; k < X.cols(); ++k) {
      auto column = K.col(steps.row_of_column[begin + k]);
      column.head(n_f) = system.C_F * X.col(k);
      column.tail(n_c) = system.C_C * X.col(k);
    }
  }
  if (kept) steps.X = std::move(store);
  return K;
}

// C v, or zero where v is empty.
Eigen::VectorXd times_or_zero(const SparseRows& C, const Eigen::VectorXd& v) {
  return v.size() > 0 ? Eigen::VectorXd(C * v) : Eigen::VectorXd::Zero(C.rows());
}

}  // namespace

std::size_t ThreeStep::bytes() const {
  return X.heap_bytes() + row_of_column.size() * sizeof(int) +
         static_cast<std::size_t>(x.size() + lambda_0.size() + K_FF_inverse_K_FC.size() +
                                  K_FF_factor.size()) *
             sizeof(double);
}

ThreeStep condense_in_three_steps(const AirySystem& system, const SolveInPlace& solve,
                                  const KeepX& keep) {
  const OwnerScope scope(MemoryOwner::intermediate);
  const int n_f = system.n_f(), n_c = system.n_c();
  ThreeStep steps;

  // Step 1.
  steps.row_of_column = rows_by_first_unknown(system);
  const Eigen::MatrixXd K = solve_for_multipliers(system, solve, keep, steps);
  if (system.q.size() > 0) {
    steps.x = system.q;
    solve(steps.x);
  }

  // Step 2.
  if (n_f > 0) {
    const auto K_FF = K.topLeftCorner(n_f, n_f);
    steps.K_FF_factor = cholesky((K_FF + K_FF.transpose()) / 2, "three-step condensation: K_FF");
    if (n_c > 0) {
      steps.K_FF_inverse_K_FC = K.topRightCorner(n_f, n_c);
      solve_by_cholesky(steps.K_FF_factor, steps.K_FF_inverse_K_FC);
    }
    if (system.q.size() > 0 || system.F.size() > 0) {
      steps.lambda_0 = times_or_zero(system.C_F, steps.x);
      if (system.F.size() > 0) steps.lambda_0 -= system.F;
      solve_by_cholesky(steps.K_FF_factor, steps.lambda_0);
    }
  }

  // Step 3.
  if (n_c > 0) {
    const auto K_CF = K.bottomLeftCorner(n_c, n_f);
    Eigen::MatrixXd W = K.bottomRightCorner(n_c, n_c);
    Eigen::VectorXd g = times_or_zero(system.C_C, steps.x);
    if (system.F0.size() > 0) g += system.F0;
    if (n_f > 0) add_product(-1, K_CF, steps.K_FF_inverse_K_FC, W);
    if (steps.lambda_0.size() > 0) add_product(-1, K_CF, steps.lambda_0, g);
    const OwnerScope scope_of_D(MemoryOwner::condensed);
    Eigen::MatrixXd L = cholesky((W + W.transpose()) / 2, "three-step condensation: W");
    solve_by_cholesky(L, g);
    steps.condensed.points = system.contact;
    steps.condensed.G = std::move(g);
    steps.condensed.D = inverse_from_factor(std::move(L));
  }
  return steps;
}

namespace {

// x −= S⁻¹ Cᵀ λ, where x = S⁻¹ load.
void subtract_multipliers(const ThreeStep& steps, const AirySystem& system,
                          const SolveInPlace& solve, SaddleVector& v) {
  const int n_f = system.n_f();
  if (steps.X.bytes() > 0) {
    Eigen::VectorXd by_column(n_f + system.n_c());
    for (Eigen::Index k = 0; k < by_column.size(); ++k) {
      const int row = steps.row_of_column[static_cast<std::size_t>(k)];
      by_column(k) = row < n_f ? v.lambda_F(row) : v.lambda_C(row - n_f);
    }
    add_product(-1, steps.X.matrix(), by_column, v.x);
    return;
  }
  Eigen::VectorXd forces = system.C_F.transpose() * v.lambda_F;
  forces.noalias() += system.C_C.transpose() * v.lambda_C;
  solve(forces);
  v.x -= forces;
}

}  // namespace

SaddleVector recover_airy_unknowns(const ThreeStep& steps, const AirySystem& system,
                                   const Eigen::VectorXd& F_C, const SolveInPlace& solve) {
  const int n_f = system.n_f(), n_c = system.n_c();
  SaddleVector v{Eigen::VectorXd::Zero(system.n()), Eigen::VectorXd::Zero(n_f),
                 Eigen::VectorXd::Zero(n_c)};
  if (steps.x.size() > 0) v.x = steps.x;
  if (steps.lambda_0.size() > 0) v.lambda_F = steps.lambda_0;
  if (n_c > 0) v.lambda_C = steps.condensed.G - times(steps.condensed.D, F_C);
  if (n_c > 0 && n_f > 0) add_product(-1, steps.K_FF_inverse_K_FC, v.lambda_C, v.lambda_F);
  subtract_multipliers(steps, system, solve, v);
  return v;
}

void solve_saddle(const ThreeStep& steps, const AirySystem& system, const SolveInPlace& solve,
                  SaddleVector& v) {
  solve(v.x);
  // K (λ, λ') = C S⁻¹ r − (r_F, r_C)
  v.lambda_F = system.C_F * v.x - v.lambda_F;
  v.lambda_C = system.C_C * v.x - v.lambda_C;
  if (system.n_c() > 0) {
    if (system.n_f() > 0) add_transposed_times(-1, steps.K_FF_inverse_K_FC, v.lambda_F, v.lambda_C);
    v.lambda_C = times(steps.condensed.D, v.lambda_C);
  }
  if (system.n_f() > 0) {
    solve_by_cholesky(steps.K_FF_factor, v.lambda_F);
    if (system.n_c() > 0) add_product(-1, steps.K_FF_inverse_K_FC, v.lambda_C, v.lambda_F);
  }
  subtract_multipliers(steps, system, solve, v);
}

void solve_in_three_steps(const AirySystem& system, const RunControl& control,
                          const SolveInPlace& solve_S, const KeepX& keep, Refine refine,
                          Solution& solution, const std::shared_ptr<const void>& owner) {
  struct Condensed {
    ThreeStep steps;
    SolveInPlace solve_S;
    std::shared_ptr<const void> owner;  // of what solve_S refers to
  };
  const auto kept = std::make_shared<Condensed>();
  kept->steps = run_stage(solution.times, Stage::condense, MemoryOwner::intermediate,
                          [&] { return condense_in_three_steps(system, solve_S, keep); });
  kept->solve_S = solve_S;
  kept->owner = owner;
  const ThreeStep& steps = kept->steps;
  solution.storage[MemoryOwner::intermediate] = steps.bytes();
  solution.file_bytes = steps.X.bytes() - steps.X.heap_bytes();
  finish_in_airy_function(
      system, control, kept->steps.condensed,
      [&](const Eigen::VectorXd& F_C) {
        return recover_airy_unknowns(steps, system, F_C, solve_S);
      },
      [own = kept.get()](const AirySystem& body, SaddleVector& v) {
        solve_saddle(own->steps, body, own->solve_S, v);
      },
      refine, solution, owner ? kept : nullptr);
}

}  // namespace airybench
