// Elimination element by element, and the dissection that orders it.
#include "solvers/direct/multifrontal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "solvers/direct/dissection.hpp"
#include "tests/support/dense_algebra.hpp"

namespace airybench::multifrontal_test {
namespace {

// Elements on a grid of squares: four unknowns on three of a square's sides, as on a triangle's;
// those of the grid's left border are prescribed.
ElementMatrices grid_elements(int side, bool blocks_of_unlike_size = false) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  ElementMatrices K;
  const int columns = side + 1;
  const auto unknown = [&](int kind, int x, int y, int k) {
    if (x == 0) return -1;
    const int edge = (kind * columns + y) * side + x - 1;
    return blocks_of_unlike_size && k == 3 && (edge % 3 == 0) ? -1 : 4 * edge + k;
  };
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      ElementMatrices::Unknowns own;
      for (int k = 0; k < 4; ++k) {
        own[k] = unknown(0, x, y, k);
        own[4 + k] = unknown(0, x + 1, y, k);
        own[8 + k] = unknown(1, x, y + 1, k);
      }
      const ElementMatrices::Matrix root =
          ElementMatrices::Matrix::NullaryExpr([&] { return number(random); });
      K.add(own, {x + 0.5, y + 0.5}, ElementMatrices::Matrix(root * root.transpose()));
    }
  K.order = 4 * 2 * columns * side;
  for (int u = 0; u < K.order; u += 4) {
    ElementMatrices::Unknowns edge;
    edge.fill(-1);
    std::iota(edge.begin(), edge.begin() + 4, u);
    const ElementMatrices::Point at = {u / 4 % side + 1.0, u / 4 / side % columns + 0.0};
    K.add(edge, at, ElementMatrices::Matrix(ElementMatrices::Matrix::Identity()));
    if (blocks_of_unlike_size) K.add_diagonal(u, at, 1);
  }
  return K;
}

Eigen::MatrixXd dense(const ElementMatrices& K) {
  const Eigen::MatrixXd lower = lower_triangle(K);
  return lower.selfadjointView<Eigen::Lower>();
}

MultifrontalFactor factored(const ElementMatrices& K, int trailing = 0) {
  MultifrontalFactor factor;
  factor.analyse(K, trailing);
  factor.factor(K);
  return factor;
}

TEST(ElementMatrices, TheirProductIsThatOfTheirSum) {
  const ElementMatrices K = grid_elements(3, true);
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(K.order, -1, 2);
  Eigen::VectorXd y = Eigen::VectorXd::Ones(K.order);
  add_product(K, x, y);
  EXPECT_LT((y - dense(K) * x - Eigen::VectorXd::Ones(K.order)).norm(), 1e-13 * y.norm());
}

TEST(Elimination, UnknownsOfAnEdgeStayTogetherAndTrailingOnesLast) {
  const ElementMatrices K = grid_elements(5);
  for (const int trailing : {0, 6, K.order}) {
    const Elimination e = analyse_elimination(K, trailing);
    std::vector<int> places = e.place;
    std::ranges::sort(places);
    for (int i = 0; i < K.order; ++i) EXPECT_EQ(places[i], i);
    for (int u = K.order - trailing; u < K.order; ++u) EXPECT_EQ(e.place[u], u);
    int pivots = 0;
    for (const Front& front : e.fronts) pivots += front.pivots;
    EXPECT_EQ(pivots, K.order);
    std::vector<int> elements = e.elements.entry;
    std::ranges::sort(elements);
    for (int k = 0; k < K.count(); ++k) EXPECT_EQ(elements[k], k);
    EXPECT_EQ(static_cast<int>(elements.size()), K.count());
    EXPECT_EQ(e.order.size(), e.fronts.size());
    if (trailing == 0) {
      for (int u = 0; u < K.order; u += 4)
        for (int k = 1; k < 4; ++k) EXPECT_EQ(e.place[u + k], e.place[u] + k);
    }
  }
}

// The fill is that of the elimination, no less: the zeros that merged fronts store are few.
TEST(Elimination, CountsTheFactor) {
  const ElementMatrices K = grid_elements(6);
  const Elimination e = analyse_elimination(K, 0);
  Eigen::MatrixXd A(K.order, K.order);
  const Eigen::MatrixXd K_dense = dense(K);
  for (int i = 0; i < K.order; ++i)
    for (int j = 0; j < K.order; ++j) A(e.place[i], e.place[j]) = K_dense(i, j);
  const Eigen::MatrixXd L = testing::cholesky_factor(A);
  const auto filled = static_cast<std::int64_t>((L.array() != 0).count());
  EXPECT_GE(e.entries(), filled);
  EXPECT_LT(e.entries(), 2 * filled);
  EXPECT_GE(e.flops(), static_cast<double>(e.entries()));
}

TEST(Multifrontal, SolvesWithAnyTrailingUnknowns) {
  for (const int side : {1, 4, 9})
    for (const bool unlike : {false, true}) {
      const ElementMatrices K = grid_elements(side, unlike);
      const Eigen::MatrixXd A = dense(K);
      const int n = K.order;
      for (const int trailing : {0, 1, 4, side * 8, n}) {
        const int inner = n - trailing;
        MultifrontalFactor cholesky = factored(K, trailing);
        const Eigen::MatrixXd L = cholesky.trailing_factor();
        ASSERT_EQ(L.rows(), trailing);
        if (trailing > 0) {
          Eigen::MatrixXd schur = A.bottomRightCorner(trailing, trailing);
          if (inner > 0)
            schur -=
                A.bottomLeftCorner(trailing, inner) *
                testing::solved(A.topLeftCorner(inner, inner), A.topRightCorner(inner, trailing));
          EXPECT_LE(testing::residual(L, L.transpose(), schur), 1e-13 * A.norm())
              << side << " " << trailing;
        }
        const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(n, -1, 2);
        Eigen::MatrixXd x(n, 2);
        x << b, -2 * b;
        cholesky.solve_in_place(x);
        EXPECT_LT(testing::residual(A, x.col(0), b), 1e-12 * b.norm());
        EXPECT_LT((A * x.col(1) + 2 * b).norm(), 1e-12 * b.norm());
        EXPECT_GE(cholesky.bytes(), static_cast<std::size_t>(cholesky.entries()) * sizeof(double));
      }
    }
}

TEST(Multifrontal, TheTrailingPartOfAForwardSolveIsInItsPlace) {
  const ElementMatrices K = grid_elements(4);
  MultifrontalFactor cholesky = factored(K, 5);
  // Given the last unknowns, the inner ones follow from the backward sweep alone.
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(K.order);
  const Eigen::VectorXd last = Eigen::VectorXd::LinSpaced(5, 1, 2);
  Eigen::VectorXd z = cholesky.forward(b);
  z.tail(5) = cholesky.trailing_factor().transpose() * last;
  const Eigen::VectorXd x = cholesky.backward(z);
  EXPECT_LT(testing::distance(x.tail(5), last), 1e-13);
  const int inner = K.order - 5;
  EXPECT_LT(testing::residual(dense(K).topRows(inner), x, b.head(inner)), 1e-12 * x.norm());
}

TEST(Multifrontal, ByInnerColumnsTheLastUnknownsAreTheSchurComplements) {
  const ElementMatrices K = grid_elements(4);
  for (const int trailing : {1, 5, 33}) {
    using Columns = MultifrontalFactor::Columns;
    MultifrontalFactor cholesky = factored(K, trailing);
    const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(K.order, -1, 2);
    Eigen::VectorXd y = cholesky.forward(b, Columns::inner);
    const Eigen::MatrixXd L = cholesky.trailing_factor();
    y.tail(trailing) = testing::solved(L * L.transpose(), y.tail(trailing));
    const Eigen::VectorXd x = cholesky.backward(y, Columns::inner);
    EXPECT_LT(testing::residual(dense(K), x, b), 1e-12 * b.norm()) << trailing;
  }
}

TEST(Multifrontal, AnotherMatrixOnTheSameElements) {
  ElementMatrices K = grid_elements(5);
  MultifrontalFactor cholesky = factored(K);
  for (double& entry : K.lower.entries()) entry *= 4;
  cholesky.factor(K);
  Eigen::MatrixXd x = Eigen::VectorXd::Ones(K.order);
  cholesky.solve_in_place(x);
  EXPECT_LT(testing::residual(dense(K), x.col(0), Eigen::VectorXd::Ones(K.order)), 1e-12);
}

// Solves with a rounded factor are those of a symmetric matrix near K.
TEST(Multifrontal, RoundedHalfTheMemoryAndSymmetric) {
  const ElementMatrices K = grid_elements(12);
  const Eigen::MatrixXd A = dense(K);
  MultifrontalFactor cholesky, rounded;
  for (MultifrontalFactor* factor : {&cholesky, &rounded}) factor->analyse(K, 7);
  cholesky.factor(K);
  rounded.factor_rounded(K);
  ASSERT_TRUE(rounded.rounded());
  EXPECT_FALSE(cholesky.rounded());
  EXPECT_EQ(rounded.entries(), cholesky.entries());
  EXPECT_LE(rounded.bytes() + static_cast<std::size_t>(rounded.entries()) * sizeof(float),
            cholesky.bytes());
  EXPECT_LT(testing::distance(rounded.trailing_factor(), cholesky.trailing_factor()),
            1e-7 * cholesky.trailing_factor().norm());
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Identity(K.order, K.order);
  rounded.solve_in_place(inverse);
  EXPECT_LT(testing::distance(inverse, inverse.transpose()), 1e-13 * inverse.norm());
  const double error = testing::residual(A, inverse, Eigen::MatrixXd::Identity(K.order, K.order));
  EXPECT_GT(error, 1e-8);  // it is rounded
  EXPECT_LT(error, 1e-3);
}

// Unknowns tied together far more stiffly than they are held: what holds them is lost in rounding.
TEST(Multifrontal, NotRoundedWhereSoftModesWouldSuffer) {
  for (const auto& [stiffness, rounds] : {std::pair{1e2, true}, {1e15, false}}) {
    ElementMatrices K = grid_elements(4);
    for (int u = 0; u + 1 < K.order; ++u) {
      ElementMatrices::Unknowns pair;
      pair.fill(-1);
      pair[0] = u;
      pair[1] = u + 1;
      ElementMatrices::Matrix spring = ElementMatrices::Matrix::Zero();
      const double k = stiffness * (1 + 0.1 * std::sin(u));
      spring.topLeftCorner<2, 2>() << k, -k, -k, k;
      K.add(pair, {0, 0}, spring);
    }
    MultifrontalFactor cholesky;
    cholesky.analyse(K);
    cholesky.factor_rounded(K);
    EXPECT_EQ(cholesky.rounded(), rounds) << stiffness;
    Eigen::MatrixXd x = Eigen::VectorXd::Ones(K.order);
    cholesky.solve_in_place(x);
    EXPECT_NEAR(x.sum() / testing::solved(dense(K), Eigen::VectorXd::Ones(K.order)).sum(), 1, 0.1)
        << stiffness;
  }
}

TEST(Multifrontal, IndefiniteNaNAndTimeAreSaid) {
  for (const double poison : {-1e3, std::nan("")}) {
    ElementMatrices K = grid_elements(4);
    K.lower[7][0] = poison;
    MultifrontalFactor cholesky;
    cholesky.analyse(K, 3);
    EXPECT_THROW(cholesky.factor(K), Breakdown);
  }
  const ElementMatrices K = grid_elements(4);
  MultifrontalFactor cholesky = factored(K);
  Eigen::MatrixXd x = Eigen::VectorXd::Ones(K.order);
  EXPECT_THROW(cholesky.solve_in_place(x, Deadline::after(-1)), TimeoutReached);
}

struct Graph {
  int vertex_count = 0;
  IndexLists vertices;  // per element
  std::vector<std::array<double, 2>> centres;
};

// Squares with four corners, side × side; x is stretched beyond recognition.
Graph grid(int side) {
  Graph graph;
  graph.vertex_count = (side + 1) * (side + 1);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      for (const int corner : {0, 1, side + 1, side + 2})
        graph.vertices.entry.push_back(y * (side + 1) + x + corner);
      graph.vertices.end_list();
      graph.centres.push_back({std::exp(x / 4.0), static_cast<double>(y)});
    }
  return graph;
}

std::vector<int> stages_of(const Graph& graph) {
  return dissect(graph.vertex_count, graph.vertices, graph.centres);
}

// How many vertices have each stage.
std::vector<int> sizes(const std::vector<int>& stage) {
  std::vector<int> size(static_cast<std::size_t>(*std::ranges::max_element(stage)) + 1, 0);
  for (const int s : stage) ++size[s];
  return size;
}

// Eight parts of 200 squares and seven cuts between them, which parts alone meet in: of two
// vertices of an element one is in the other's part or in a cut around it.
TEST(Dissection, CutsAGridAlongItsLines) {
  constexpr int side = 40;
  const Graph graph = grid(side);
  const std::vector<int> stage = stages_of(graph);
  ASSERT_EQ(stage.size(), std::size_t{(side + 1) * (side + 1)});
  ASSERT_GE(*std::ranges::min_element(stage), 0);
  const std::vector<int> size = sizes(stage);
  EXPECT_EQ(size.back(), side + 1);  // the first cut's: one line of the grid
  EXPECT_LT(*std::ranges::max_element(size), 300);
  // Of each stage the cut that made its part; a cut comes after both its parts.
  constexpr std::array parent = {2, 2, 6, 5, 5, 6, 14, 9, 9, 13, 12, 12, 13, 14, -1};
  ASSERT_EQ(size.size(), parent.size());
  const auto is_around = [&](int outer, int inner) {
    while (inner != -1 && inner != outer) inner = parent[inner];
    return inner == outer;
  };
  for (int e = 0; e < graph.vertices.count(); ++e)
    for (const int v : graph.vertices[e])
      for (const int w : graph.vertices[e])
        EXPECT_TRUE(is_around(stage[v], stage[w]) || is_around(stage[w], stage[v]))
            << stage[v] << " and " << stage[w];
}

TEST(Dissection, WithoutAnyPlaceStillEnds) {
  Graph graph = grid(30);
  for (auto& centre : graph.centres) centre = {1, 1};
  const std::vector<int> stage = stages_of(graph);
  EXPECT_GE(*std::ranges::min_element(stage), 0);
  EXPECT_GT(*std::ranges::max_element(stage), 2);
}

}  // namespace
}  // namespace airybench::multifrontal_test
