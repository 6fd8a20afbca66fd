// Dissection gives every vertex a stage, keeps the parts apart, and leaves few operations.
#include "solvers/direct/dissection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace airybench::dissection_test {
namespace {

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

// How many vertices have each stage.
std::vector<int> sizes(const std::vector<int>& stage) {
  std::vector<int> size(static_cast<std::size_t>(*std::ranges::max_element(stage)) + 1, 0);
  for (const int s : stage) ++size[static_cast<std::size_t>(s)];
  return size;
}

TEST(Dissection, CutsAGridAlongItsLines) {
  constexpr int side = 40;
  const Graph graph = grid(side);
  const std::vector<int> stage = dissect(graph.vertex_count, graph.vertices, graph.centres);
  ASSERT_EQ(static_cast<int>(stage.size()), graph.vertex_count);
  EXPECT_GE(*std::ranges::min_element(stage), 0);
  const std::vector<int> size = sizes(stage);
  EXPECT_EQ(size.back(), side + 1);  // the first cut's: one line of the grid
  // Eight parts of 200 squares and seven cuts between them.
  EXPECT_EQ(size.size(), 15u);
  EXPECT_LT(*std::ranges::max_element(size), 300);
}

// Numbers the stages of a full tree of so many levels of cuts, a cut after both its parts; returns
// the last. parent: of each stage, the cut that made its part.
int number_parts(int cuts, int& next, std::vector<int>& parent) {
  if (cuts == 0) {
    parent.push_back(-1);
    return next++;
  }
  const int front = number_parts(cuts - 1, next, parent);
  const int back = number_parts(cuts - 1, next, parent);
  parent[static_cast<std::size_t>(front)] = parent[static_cast<std::size_t>(back)] = next;
  parent.push_back(-1);
  return next++;
}

// Of two vertices of an element one is in the other's part or in a cut around it.
TEST(Dissection, PartsMeetInCutsOnly) {
  const Graph graph = grid(40);
  const std::vector<int> stage = dissect(graph.vertex_count, graph.vertices, graph.centres);
  std::vector<int> parent;
  int next = 0;
  number_parts(3, next, parent);
  ASSERT_EQ(parent.size(), sizes(stage).size());
  const auto is_around = [&](int outer, int inner) {
    while (inner != -1 && inner != outer) inner = parent[static_cast<std::size_t>(inner)];
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
  const std::vector<int> stage = dissect(graph.vertex_count, graph.vertices, graph.centres);
  EXPECT_GE(*std::ranges::min_element(stage), 0);
  EXPECT_GT(*std::ranges::max_element(stage), 2);
}

}  // namespace
}  // namespace airybench::dissection_test
