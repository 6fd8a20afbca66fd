#include "solvers/two_level/edge_matrix.hpp"

#include <algorithm>

#include "solvers/base/parallel.hpp"

namespace airybench {
namespace {

void number_blocks(const Problem& problem, EdgeMatrix& K) {
  constexpr std::size_t smallest = 4000, most = 16;
  constexpr int nowhere = -1, between = -2;
  const auto& of_triangle = problem.edges.of_triangle;
  const std::size_t triangles = of_triangle.size(),
                    pieces = std::clamp(triangles / smallest, std::size_t{1}, most);
  std::vector<int> piece_of(static_cast<std::size_t>(problem.edges.count()), nowhere);
  for (std::size_t t = 0; t < triangles; ++t)
    for (const int edge : of_triangle[t]) {
      const auto own = static_cast<int>(t * pieces / triangles);
      piece_of[edge] = piece_of[edge] == nowhere || piece_of[edge] == own ? own : between;
    }
  K.block_of_edge.assign(piece_of.size(), -1);
  K.piece = {0};
  int next = 0;
  const auto number = [&](int edge) {
    if (K.block_of_edge[edge] < 0) K.block_of_edge[edge] = next++;
  };
  for (std::size_t t = 0; t < triangles; ++t) {
    for (const int edge : of_triangle[t])
      if (piece_of[edge] != between) number(edge);
    if ((t + 1) * pieces / triangles > t * pieces / triangles) K.piece.push_back(next);
  }
  for (const auto& edges : of_triangle) std::ranges::for_each(edges, number);
}

}  // namespace

EdgeMatrix make_edge_matrix(const Problem& problem, const HybridizedSystem& system, int threads) {
  EdgeMatrix K;
  K.threads = threads;
  number_blocks(problem, K);
  const auto edges = K.block_of_edge.size();
  const auto& of_triangle = problem.edges.of_triangle;
  K.start.assign(edges + 1, 0);
  const auto visit_pairs = [&](std::size_t t, auto visit) {
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l) {
        const int row = K.block_of_edge[of_triangle[t][k]],
                  column = K.block_of_edge[of_triangle[t][l]];
        if (column < row) visit(k, l, row, column);
      }
  };
  for (std::size_t t = 0; t < of_triangle.size(); ++t)
    visit_pairs(t, [&](int, int, int row, int) { ++K.start[row + 1]; });
  for (std::size_t row = 0; row < edges; ++row) K.start[row + 1] += K.start[row];
  K.column.resize(static_cast<std::size_t>(K.start.back()));
  K.left.resize(K.column.size());
  K.diagonal.assign(edges, Eigen::Matrix4d::Zero());
  std::vector<int> next(K.start.begin(), K.start.end() - 1);
  for (std::size_t t = 0; t < of_triangle.size(); ++t) {
    const Eigen::Matrix<double, 12, 12> K_e = from_lower(system.K.lower[t].data());
    for (int k = 0; k < 3; ++k)
      K.diagonal[K.block_of_edge[of_triangle[t][k]]] += K_e.block<4, 4>(4 * k, 4 * k);
    visit_pairs(t, [&](int k, int l, int row, int column) {
      K.column[next[row]] = column;
      K.left[next[row]++] = K_e.block<4, 4>(4 * k, 4 * l);
    });
  }
  return K;
}

void EdgeMatrix::visit_pieces(const std::function<void(int begin, int end)>& work) const {
  in_parallel(threads, pieces(), [&](int begin, int end) {
    for (int p = begin; p < end; ++p) work(piece[p], piece[p + 1]);
  });
}

void EdgeMatrix::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  y.resize(slots());
  const auto add_rows = [&](int begin, int end) {
    y.segment(4 * static_cast<Eigen::Index>(begin), 4 * static_cast<Eigen::Index>(end - begin))
        .setZero();
    for (int i = begin; i < end; ++i) {
      const Eigen::Vector4d own = x.segment<4>(4 * static_cast<Eigen::Index>(i));
      Eigen::Vector4d sum = diagonal[i] * own;
      for (int k = start[i]; k < start[i + 1]; ++k) {
        const Eigen::Index j = 4 * static_cast<Eigen::Index>(column[k]);
        sum.noalias() += left[k] * x.segment<4>(j);
        y.segment<4>(j).noalias() += left[k].transpose() * own;
      }
      y.segment<4>(4 * static_cast<Eigen::Index>(i)) += sum;
    }
  };
  visit_pieces(add_rows);
  add_rows(piece.back(), blocks());
}

std::vector<Eigen::Index> prescribed_slots(const EdgeMatrix& K, const EdgeUnknowns& unknown) {
  std::vector<Eigen::Index> prescribed;
  for (std::size_t edge = 0; edge < unknown.size(); ++edge)
    for (int i = 0; i < 4; ++i)
      if (unknown[edge][i] == prescribed_unknown)
        prescribed.push_back(4 * static_cast<Eigen::Index>(K.block_of_edge[edge]) + i);
  return prescribed;
}

Eigen::VectorXd prescribed_in_slots(const EdgeMatrix& K, const HybridizedSystem& system) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(K.slots());
  for (Eigen::Index edge = 0; edge < system.displacement.cols(); ++edge)
    x.segment<4>(4 * static_cast<Eigen::Index>(K.block_of_edge[edge])) =
        system.displacement.col(edge);
  return x;
}

Eigen::VectorXd to_slots(const EdgeMatrix& K, const EdgeUnknowns& unknown,
                         const Eigen::VectorXd& u) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(K.slots());
  for (std::size_t edge = 0; edge < unknown.size(); ++edge)
    for (int i = 0; i < 4; ++i)
      if (unknown[edge][i] != prescribed_unknown)
        x(4 * static_cast<Eigen::Index>(K.block_of_edge[edge]) + i) = u(unknown[edge][i]);
  return x;
}

Eigen::VectorXd from_slots(const EdgeMatrix& K, const EdgeUnknowns& unknown,
                           const Eigen::VectorXd& x, Eigen::Index unknowns) {
  Eigen::VectorXd u(unknowns);
  for (std::size_t edge = 0; edge < unknown.size(); ++edge)
    for (int i = 0; i < 4; ++i)
      if (unknown[edge][i] != prescribed_unknown)
        u(unknown[edge][i]) = x(4 * static_cast<Eigen::Index>(K.block_of_edge[edge]) + i);
  return u;
}

}  // namespace airybench
