#include "solvers/condensation/global_problem.hpp"

#include <algorithm>
#include <numeric>

#include "solvers/direct/cholmod.hpp"

namespace airybench {
namespace {

using SparseColumns = Eigen::SparseMatrix<double>;

// The block of M that each row is in: the smallest row that it is connected with.
std::vector<int> blocks_of(const SparseColumns& M) {
  std::vector<int> block(static_cast<std::size_t>(M.rows()));
  std::iota(block.begin(), block.end(), 0);
  const auto root = [&](int row) {
    while (block[row] != row) row = block[row] = block[block[row]];
    return row;
  };
  for (int j = 0; j < M.outerSize(); ++j)
    for (SparseColumns::InnerIterator entry(M, j); entry; ++entry) {
      const int a = root(static_cast<int>(entry.row())), b = root(j);
      block[std::max(a, b)] = std::min(a, b);
    }
  for (int row = 0; row < static_cast<int>(block.size()); ++row) block[row] = root(row);
  return block;
}

// By block (its smallest row) the columns of H that touch it, sorted.
std::vector<std::vector<int>> columns_at(const std::vector<int>& block, const SparseColumns& H) {
  std::vector<std::vector<int>> columns(block.size());
  for (int j = 0; j < H.outerSize(); ++j)
    for (SparseColumns::InnerIterator entry(H, j); entry; ++entry) {
      std::vector<int>& of_block = columns[block[entry.row()]];
      if (of_block.empty() || of_block.back() != j) of_block.push_back(j);
    }
  return columns;
}

// Rows of W that may differ from zero in column j, sorted.
std::vector<int> pattern(int j, const std::vector<int>& block,
                         const std::vector<std::vector<int>>& columns, const SparseColumns& H) {
  std::vector<int> rows, blocks;
  for (SparseColumns::InnerIterator entry(H, j); entry; ++entry)
    blocks.push_back(block[entry.row()]);
  std::ranges::sort(blocks);
  blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
  for (const int b : blocks) rows.insert(rows.end(), columns[b].begin(), columns[b].end());
  std::ranges::sort(rows);
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

template <typename Take>  // take(first, Hᵀ M⁻¹ H of some columns from the first on)
void for_columns(CholmodFactor& factor, const SparseColumns& H, Take take) {
  constexpr Eigen::Index columns_at_once = 32;
  const Eigen::SparseMatrix<double, Eigen::RowMajor> transposed = H.transpose();
  Eigen::MatrixXd v;
  for (Eigen::Index first = 0; first < H.cols(); first += columns_at_once) {
    const Eigen::Index count = std::min(columns_at_once, H.cols() - first);
    v = H.middleCols(first, count);
    factor.solve_in_place(v);
    take(first, Eigen::MatrixXd(transposed * v));
  }
}

SparseRows sparse_W(CholmodFactor& factor, const SparseColumns& H, std::int64_t entries,
                    const std::vector<int>& block, const std::vector<std::vector<int>>& columns) {
  SparseColumns W(H.cols(), H.cols());
  W.reserve(entries);
  for_columns(factor, H, [&](Eigen::Index first, const Eigen::MatrixXd& some) {
    for (Eigen::Index k = 0; k < some.cols(); ++k) {
      const int j = static_cast<int>(first + k);
      W.startVec(j);
      for (const int i : pattern(j, block, columns, H)) W.insertBack(i, j) = some(i, k);
    }
  });
  W.finalize();
  return SparseRows(SparseColumns(W + SparseColumns(W.transpose())) / 2);
}

std::shared_ptr<const contact::Bodies> bodies_of(SparseColumns M, SparseColumns H,
                                                 std::shared_ptr<CholmodFactor> factor) {
  auto bodies = std::make_shared<contact::Bodies>();
  const SparseColumns rough = M.diagonal().cwiseInverse().asDiagonal() * H;
  bodies->D_diagonal = Eigen::VectorXd(H.cols());
  for (Eigen::Index j = 0; j < H.cols(); ++j) bodies->D_diagonal(j) = H.col(j).dot(rough.col(j));
  bodies->M = std::move(M);
  bodies->H = std::move(H);
  bodies->solve = [factor = std::move(factor)](const Eigen::VectorXd& b) {
    Eigen::VectorXd x = b;
    factor->solve_in_place(x);
    return x;
  };
  return bodies;
}

}  // namespace

bool held_sparse(std::int64_t size, std::int64_t entries) {
  constexpr std::int64_t small = 300, many = 8;
  return size > small && entries * many < size * size;
}

contact::Problem condense_global(SparseColumns M, SparseColumns H, const Eigen::VectorXd& f,
                                 const Eigen::VectorXd& w, const CondensationLimit& limit) {
  const auto factor = std::make_shared<CholmodFactor>();
  {
    const SparseColumns lower = M.triangularView<Eigen::Lower>();
    factor->analyse(lower);
    factor->factor(lower);
  }
  contact::Problem problem;
  Eigen::VectorXd v = f;
  factor->solve_in_place(v);
  problem.G = w + H.transpose() * v;

  const std::vector<int> block = blocks_of(M);
  const std::vector<std::vector<int>> columns = columns_at(block, H);
  const std::int64_t most =
      std::max<std::int64_t>(limit.entries, limit.times * (M.nonZeros() + H.nonZeros()));
  std::int64_t entries = 0;
  for (int j = 0; j < H.cols() && entries <= most; ++j)
    entries += static_cast<std::int64_t>(pattern(j, block, columns, H).size());
  if (entries > most) {
    problem.bodies = bodies_of(std::move(M), std::move(H), factor);
    problem.how = "not formed";
  } else if (held_sparse(H.cols(), entries)) {
    problem.rows = sparse_W(*factor, H, entries, block, columns);
    problem.how = "condensed, sparse";
  } else {
    problem.D.resize(H.cols(), H.cols());
    for_columns(*factor, H, [&](Eigen::Index first, const Eigen::MatrixXd& some) {
      problem.D.middleCols(first, some.cols()) = some;
    });
    problem.D = ((problem.D + problem.D.transpose()) / 2).eval();
    problem.how = "condensed, dense";
  }
  return problem;
}

}  // namespace airybench
