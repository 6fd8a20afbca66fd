#include "mesh/mesh.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/mesh_checks.hpp"

namespace airybench::mesh_test {
namespace {

using testing::complaint;
constexpr auto displacement = BoundaryRole::displacement, force = BoundaryRole::force,
               contact = BoundaryRole::contact;

// Unit squares side by side, each with a middle vertex and four triangles around it.
//
//   3 ---- 4 ---- 5      square k: middle vertex 6+k
//   | \/   |  \/  |
//   | /\   |  /\  |
//   0 ---- 1 ---- 2      left: displacement, right: contact, bottom and top: force
Mesh two_squares() {
  Mesh mesh;
  mesh.name = "squares";
  mesh.vertices = {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}, {0.5, 0.5}, {1.5, 0.5}};
  mesh.triangles = {{0, 1, 6}, {1, 4, 6}, {4, 3, 6}, {3, 0, 6},
                    {1, 2, 7}, {2, 5, 7}, {5, 4, 7}, {4, 1, 7}};
  mesh.triangle_body.assign(8, 0);
  mesh.body_names = {"body"};
  mesh.boundary = {{{0, 1}, force}, {{1, 2}, force}, {{2, 5}, contact},
                   {{5, 4}, force}, {{4, 3}, force}, {{3, 0}, displacement}};
  return mesh;
}

// A grid of n × n squares of two triangles each; all of its boundary is displacement.
Mesh grid_without(std::set<int> missing_squares, int n = 3) {
  Mesh mesh;
  mesh.name = "grid";
  mesh.body_names = {"body"};
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) mesh.vertices.emplace_back(i, j);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      if (missing_squares.contains(n * j + i)) continue;
      const int a = (n + 1) * j + i;
      mesh.triangles.push_back({a, a + 1, a + n + 2});
      mesh.triangles.push_back({a, a + n + 2, a + n + 1});
    }
  }
  testing::hold_all_around(mesh);
  return mesh;
}

TEST(MeshValidate, AcceptsValidMeshesAndCountsTheirHoles) {
  EXPECT_EQ(complaint(two_squares()), "no complaint");
  Mesh thin = two_squares();
  thin.vertices[6].y() = 1e-6;  // but not flat
  EXPECT_EQ(complaint(thin), "no complaint");
  for (const auto& [missing, n, holes] :
       std::vector<std::tuple<std::set<int>, int, int>>{{{}, 3, 0},
                                                        {{1}, 3, 0},  // a notch
                                                        {{4}, 3, 1},
                                                        {{6, 8, 17}, 5, 3},
                                                        {{6, 7, 12, 17}, 5, 1}}) {
    const Mesh mesh = grid_without(missing, n);
    EXPECT_EQ(complaint(mesh), "no complaint") << missing.size() << " of " << n << " missing";
    EXPECT_EQ(hole_count(mesh), holes) << missing.size() << " of " << n << " missing";
  }
}

void add_edge(Mesh& mesh, int a, int b, BoundaryRole role) {
  mesh.boundary.push_back({{a, b}, role});
}

// With a ninth vertex.
void add_triangle(Mesh& mesh, double x, double y, int a, int b, int c) {
  mesh.vertices.emplace_back(x, y);
  mesh.triangles.push_back({a, b, c});
  mesh.triangle_body.push_back(0);
}

void add_another(Mesh& mesh) {
  const Mesh other = two_squares();
  for (const auto& vertex : other.vertices) mesh.vertices.emplace_back(vertex.x() + 5, vertex.y());
  for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({a + 8, b + 8, c + 8});
  mesh.triangle_body.assign(16, 0);
  for (const BoundaryEdge& edge : other.boundary)
    add_edge(mesh, edge.vertices[0] + 8, edge.vertices[1] + 8, edge.role);
}

struct Wrong {
  void (*change)(Mesh&);
  std::vector<std::string> named;
};

TEST(MeshValidate, NamesWhatIsWrong) {
  const std::vector<Wrong> cases = {
      {[](Mesh& m) { m.triangles.clear(), m.triangle_body.clear(); }, {"no triangles"}},
      {[](Mesh& m) { m.triangle_body.pop_back(); }, {"7 bodies for 8 triangles"}},
      {[](Mesh& m) { m.vertices[6].y() = std::nan(""); }, {"vertex 7: ", "finite"}},
      {[](Mesh& m) { m.vertices[6].y() = INFINITY; }, {"vertex 7: ", "finite"}},
      {[](Mesh& m) { m.triangles[2][1] = 8; }, {"triangle 3: vertex 9 ", "(1..8)"}},
      {[](Mesh& m) { m.triangles[2][1] = -1; }, {"triangle 3: vertex 0 ", "(1..8)"}},
      {[](Mesh& m) { m.triangle_body[7] = 1; }, {"triangle 8: body 2 ", "(1..1)"}},
      {[](Mesh& m) { m.vertices[6].y() = 0; }, {"triangle 1 at [0.5, 0]: zero area"}},
      {[](Mesh& m) { m.vertices[6].y() = 1e-14; }, {"triangle 1 at [0.5, ", "zero area"}},
      {[](Mesh& m) { std::fill(m.vertices.begin(), m.vertices.end(), Eigen::Vector2d(1, 1)); },
       {"triangle 1 at [1, 1]: ", "in one place"}},
      {[](Mesh& m) { std::swap(m.triangles[3][0], m.triangles[3][1]); },
       {"triangle 4 at [0.166667, 0.5]: inverted"}},
      {[](Mesh& m) { m.vertices.emplace_back(0.2, 0.1); }, {"vertex 9 at [0.2, 0.1]: dangling"}},
      {[](Mesh& m) { add_triangle(m, 0.7, 0.6, 4, 8, 1); },
       {"edge 2-5 at [1, 0.5]: shared by 3 triangles"}},
      {[](Mesh& m) { add_triangle(m, 0.5, 2, 0, 1, 8); },
       {"edge 1-2 at [0.5, 0]: ", "triangles overlap"}},
      {[](Mesh& m) { m.boundary[0].vertices[1] = 8; }, {"boundary edge 1-9: ", "(1..8)"}},
      {[](Mesh& m) { std::swap(m.boundary[2].vertices[0], m.boundary[2].vertices[1]); },
       {"boundary edge 6-3 at [2, 0.5]: walked clockwise"}},
      {[](Mesh& m) { add_edge(m, 1, 4, force); },
       {"boundary edge 2-5 at [1, 0.5]: not on the boundary"}},
      {[](Mesh& m) { add_edge(m, 1, 2, contact); }, {"boundary edge 2-3 at [1.5, 0]: given twice"}},
      {[](Mesh& m) { m.boundary.erase(m.boundary.begin() + 4); },
       {"edge 5-4 at [0.5, 1]: ", "without a role"}},
  };
  for (const auto& [change, named] : cases) {
    Mesh mesh = two_squares();
    change(mesh);
    testing::expect_named(complaint(mesh), named);
  }
}

TEST(MeshPieces, AreNumberedByTheirVertices) {
  Mesh mesh = two_squares();
  EXPECT_EQ(pieces_of(mesh).count, 1);
  add_another(mesh);
  EXPECT_NO_THROW(validate(mesh));
  const MeshPieces pieces = pieces_of(mesh);
  EXPECT_EQ(pieces.count, 2);
  EXPECT_EQ(std::ranges::count(pieces.of_vertex, 1), 8);
  EXPECT_EQ(hole_count(mesh), 0);
  const Mesh island = grid_without({6, 7, 8, 11, 13, 16, 17, 18}, 5);
  EXPECT_EQ(pieces_of(island).count, 2);
  EXPECT_EQ(hole_count(island), 1);
}

TEST(MeshValidate, NamesWhereABoundaryTouchesItself) {
  for (const auto& [missing, n, vertex] : std::vector<std::tuple<std::set<int>, int, const char*>>{
           {{3, 7}, 3, "10 at [1, 2]"}, {{6, 12}, 5, "15 at [2, 2]"}, {{6, 2}, 5, "9 at [2, 1]"}})
    testing::expect_named(complaint(grid_without(missing, n)),
                          {"vertex " + std::string(vertex) + ": the boundary touches itself"});
}

// Places, since a model's user does not know the numbers; and what has probably gone wrong.
TEST(MeshValidate, NamesTheProbableCause) {
  struct Case {
    std::vector<Eigen::Vector2d> vertices;
    std::vector<std::array<int, 3>> triangles;
    std::vector<int> bodies;
    std::vector<std::string> named;
  };
  const std::string touches = "vertex 1 at [0, 0]: the boundary touches itself there: ",
                    hangs = "vertex 5 at [1, 0] hangs on edge 1-2 at [1, 0]";
  for (const auto& [vertices, triangles, bodies, named] : std::vector<Case>{
           {{{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}},
            {{0, 1, 2}, {0, 3, 4}},
            {0, 1},
            {touches + "the bodies one and two"}},
           {{{0, 0}, {2, 0}, {1, 2}, {1, -1}, {1, 0}},
            {{0, 1, 2}, {0, 3, 4}, {3, 1, 4}},
            {0, 0, 0},
            {touches + hangs}},
           {{{0, 0}, {2, 0}, {1, 2}, {1, -1}, {1, 0}, {-1, 0}, {3, 0}},
            {{0, 1, 2}, {0, 3, 4}, {3, 1, 4}, {0, 2, 5}, {5, 3, 0}, {2, 1, 6}, {3, 6, 1}},
            {0, 0, 0, 0, 0, 0, 0},
            {"boundary edge 1-2 at [1, 0]: crosses or touches boundary edge 2-5", hangs}},
           {{{0, 0}, {1, 0}, {1, 1}, {2, 0}, {1, 1}},
            {{0, 1, 2}, {1, 3, 4}},
            {0, 0},
            {"vertex 2 at [1, 0]: the boundary", "vertices 3 and 5 are two in one place, [1, 1]"}},
       }) {
    Mesh mesh;
    mesh.name = "wrong";
    mesh.vertices = vertices;
    mesh.triangles = triangles;
    testing::hold_all_around(mesh);
    mesh.triangle_body = bodies;
    mesh.body_names = {"one", "two"};
    testing::expect_named(complaint(mesh), named);
  }
}

TEST(NumberEdges, EveryEdgeOnceFromLowToHigh) {
  const Mesh mesh = two_squares();
  const MeshEdges edges = number_edges(mesh);
  const std::set<std::array<int, 2>> distinct(edges.vertices.begin(), edges.vertices.end());
  EXPECT_EQ(edges.count(), 8 + 8 - 1);  // Euler: E = V + T − 1
  EXPECT_EQ(distinct.size(), edges.vertices.size());
  for (const auto& [low, high] : edges.vertices) EXPECT_LT(low, high);

  const auto expect_edge = [&](int edge, int a, int b) {
    EXPECT_EQ(edges.vertices[edge], (std::array{std::min(a, b), std::max(a, b)}));
  };
  ASSERT_EQ(edges.of_triangle.size(), mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      expect_edge(edges.of_triangle[t][k], mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
  ASSERT_EQ(edges.of_boundary.size(), mesh.boundary.size());
  for (std::size_t row = 0; row < mesh.boundary.size(); ++row)
    expect_edge(edges.of_boundary[row], mesh.boundary[row].vertices[0],
                mesh.boundary[row].vertices[1]);
}

using Chains = std::vector<std::vector<int>>;

TEST(BoundaryChains, TwoChainsFollowTheBoundaryCounterClockwise) {
  EXPECT_EQ(boundary_chains(two_squares(), force), (Chains{{0, 1}, {3, 4}}));
  EXPECT_EQ(boundary_chains(two_squares(), contact), (Chains{{2}}));
  EXPECT_EQ(boundary_chains(two_squares(), displacement), (Chains{{5}}));
  EXPECT_TRUE(boundary_chains(grid_without({}), contact).empty());
}

TEST(BoundaryChains, RowsInAnyOrderAndAClosedChainStartsAtTheLowest) {
  Mesh mesh = two_squares();
  std::reverse(mesh.boundary.begin(), mesh.boundary.end());
  // The rows are now 5: 0→1, 4: 1→2, 2: 5→4, 1: 4→3.
  EXPECT_EQ(boundary_chains(mesh, force), (Chains{{2, 1}, {5, 4}}));
  mesh = two_squares();
  for (auto& edge : mesh.boundary) edge.role = displacement;
  std::swap(mesh.boundary[0], mesh.boundary[4]);
  EXPECT_EQ(boundary_chains(mesh, displacement), (Chains{{0, 5, 4, 1, 2, 3}}));
}

TEST(BoundaryChains, AHoleIsAChainOfItsOwn) {
  const Mesh mesh = grid_without({4});
  const Chains chains = boundary_chains(mesh, displacement);
  ASSERT_EQ(chains.size(), 2u);
  EXPECT_EQ(chains[0].size(), 12u);
  ASSERT_EQ(chains[1].size(), 4u);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_EQ(mesh.boundary[chains[1][k]].vertices[1],
              mesh.boundary[chains[1][(k + 1) % 4]].vertices[0]);
}

TEST(MeshSizes, CountAsThePaperDoes) {
  const Mesh mesh = two_squares();
  const MeshSizes sizes = mesh_sizes(mesh);
  EXPECT_EQ(sizes.n_phi, 3 * 8 + number_edges(mesh).count());
  EXPECT_EQ(sizes.n_phi, 6 * 8 - 6 - 3);  // 6V − B − 3
  EXPECT_EQ(sizes.n_f, 4 * 4);
  EXPECT_EQ(sizes.n_c, 4 * 1);
  EXPECT_EQ(sizes.displacement_edges, 1);
  EXPECT_EQ(sizes.force_edges, 4);
  EXPECT_EQ(sizes.contact_edges, 1);
  const Mesh with_holes = grid_without({6, 8}, 5);
  EXPECT_EQ(mesh_sizes(with_holes).n_phi, 3 * 36 + number_edges(with_holes).count());
}

}  // namespace
}  // namespace airybench::mesh_test
