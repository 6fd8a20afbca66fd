#include "peers/petsc/distributed_mesh.hpp"

#include <algorithm>
#include <unordered_map>

#include "support/errors.hpp"

namespace airybench {
namespace {

using namespace parallel;

struct Side {  // of a triangle, asked for its edge; or an edge of the file, triangle −1
  int low, high, triangle, side_or_edge;
};
struct Meeting {
  int triangle, side, edge, neighbour;
};

// Sides that meet are next to one another once they are sorted, their edge before them.
std::vector<Meeting> meetings_of(std::vector<Side> sides, std::vector<int>& to,
                                 PetscInt triangles) {
  std::ranges::sort(sides, {}, [](const Side& s) { return std::array{s.low, s.high, s.triangle}; });
  std::vector<Meeting> found;
  for (std::size_t k = 0; k < sides.size();) {
    const Side& edge = sides[k];
    std::size_t end = k + 1;
    while (end < sides.size() && sides[end].low == edge.low && sides[end].high == edge.high) ++end;
    if (edge.triangle >= 0 || end - k < 2 || end - k > 3)
      throw FileError("problem.npz: edges: " + std::to_string(edge.low) + " " +
                      std::to_string(edge.high) + " (allowed: every side of a triangle once)");
    for (std::size_t s = k + 1; s < end; ++s) {
      const int other = end - k == 3 ? sides[s == k + 1 ? k + 2 : k + 1].triangle : -1;
      found.push_back({sides[s].triangle, sides[s].side_or_edge, edge.side_or_edge, other});
      to.push_back(slice_owner(triangles, sides[s].triangle));
    }
    k = end;
  }
  return found;
}

// Rank of every own triangle.
std::vector<PetscInt> parts_of(const MeshSlices& slices) {
  const auto own = static_cast<PetscInt>(slices.own.size());
  std::vector<PetscInt> part(static_cast<std::size_t>(own), 0);
  if (rank_count() == 1) return part;
  PetscInt *start = nullptr, *neighbour = nullptr;  // the matrix frees them
  check(PetscMalloc1(own + 1, &start));
  check(PetscMalloc1(3 * own + 1, &neighbour));
  start[0] = 0;
  for (PetscInt t = 0; t < own; ++t) {
    start[t + 1] = start[t];
    for (const int other : slices.own[t].neighbours)
      if (other >= 0) neighbour[start[t + 1]++] = other;
    std::sort(neighbour + start[t], neighbour + start[t + 1]);
  }
  OwnedMat graph;
  check(MatCreateMPIAdj(PETSC_COMM_WORLD, own, slices.triangles, start, neighbour, nullptr,
                        graph.put()));
  MatPartitioning partitioning = nullptr;
  check(MatPartitioningCreate(PETSC_COMM_WORLD, &partitioning));
  check(MatPartitioningSetAdjacency(partitioning, graph));
  check(MatPartitioningSetFromOptions(partitioning));
  IS parts = nullptr;
  check(MatPartitioningApply(partitioning, &parts));
  const PetscInt* values = nullptr;
  check(ISGetIndices(parts, &values));
  std::copy_n(values, own, part.begin());
  check(ISRestoreIndices(parts, &values));
  check(ISDestroy(&parts));
  check(MatPartitioningDestroy(&partitioning));
  return part;
}

struct Claim {
  int entity, rank;
};
struct Numbered {
  int entity;
  PetscInt number;
};

// Of entities in the order in which their owner is to number them.
Numbering number_entities(std::vector<int> input, PetscInt total) {
  Numbering result;
  const int here = rank_here();
  std::vector<Claim> claims;
  std::vector<int> to;
  for (const int entity : input) {
    claims.push_back({entity, here});
    to.push_back(slice_owner(total, entity));
  }
  const std::vector<Claim> asked = exchanged(claims, to);
  const PetscInt begin = slice_begin(total, here), end = slice_begin(total, here + 1);
  std::vector<int> owner(static_cast<std::size_t>(end - begin), -1), times(owner.size(), 0);
  for (const Claim& claim : asked) {
    int& of = owner[claim.entity - begin];
    if (of < 0 || claim.rank < of) of = claim.rank;
    ++times[claim.entity - begin];
  }
  std::vector<Claim> reply;
  std::vector<int> back;
  for (const Claim& claim : asked) {
    const auto at = static_cast<std::size_t>(claim.entity - begin);
    reply.push_back({claim.entity, times[at] > 1 ? -1 - owner[at] : owner[at]});
    back.push_back(claim.rank);
  }
  // Replies come in the order of the claims of each slice's rank.
  const std::vector<Claim> known = exchanged(reply, back);
  std::unordered_map<int, int> owner_of;
  std::vector<int> order(input.size());
  owner_of.reserve(known.size());
  for (const Claim& claim : known) owner_of[claim.entity] = claim.rank;
  std::vector<Numbered> own;
  to.clear();
  result.global.assign(input.size(), -1);
  result.shared.assign(input.size(), false);
  for (std::size_t k = 0; k < input.size(); ++k) {
    const int code = owner_of[input[k]], rank = code < 0 ? -1 - code : code;
    result.shared[k] = code < 0;
    if (rank == here) result.global[k] = result.owned++;
  }
  MPI_Exscan(&result.owned, &result.begin, 1, MPIU_INT, MPI_SUM, PETSC_COMM_WORLD);
  if (here == 0) result.begin = 0;
  for (std::size_t k = 0; k < input.size(); ++k) {
    if (result.global[k] < 0) continue;
    result.global[k] += result.begin;
    if (!result.shared[k]) continue;
    own.push_back({input[k], result.global[k]});
    to.push_back(slice_owner(total, input[k]));
  }
  std::vector<PetscInt> number(owner.size(), -1);
  for (const Numbered& n : exchanged(own, to)) number[n.entity - begin] = n.number;
  std::vector<Numbered> answers;
  back.clear();
  for (const Claim& claim : asked) {
    const auto at = static_cast<std::size_t>(claim.entity - begin);
    if (times[at] < 2 || owner[at] == claim.rank) continue;
    answers.push_back({claim.entity, number[at]});
    back.push_back(claim.rank);
  }
  std::unordered_map<int, PetscInt> of_others;
  for (const Numbered& n : exchanged(answers, back)) of_others[n.entity] = n.number;
  for (std::size_t k = 0; k < input.size(); ++k)
    if (result.global[k] < 0) result.global[k] = of_others.at(input[k]);
  result.input = std::move(input);
  return result;
}

struct Place {
  int vertex;
  double x, y;
};
// Coordinates of vertices from the ranks that have their slices.
std::vector<Eigen::Vector2d> places_of(const std::vector<int>& vertices, const MeshSlices& slices) {
  std::vector<Claim> asking;
  std::vector<int> to;
  for (const int vertex : vertices) {
    asking.push_back({vertex, rank_here()});
    to.push_back(slice_owner(slices.vertices, vertex));
  }
  const PetscInt begin = slice_begin(slices.vertices, rank_here());
  std::vector<Place> answers;
  std::vector<int> back;
  for (const Claim& asked : exchanged(asking, to)) {
    const auto row = slices.vertices_mm.row(asked.entity - begin);
    answers.push_back({asked.entity, row(0), row(1)});
    back.push_back(asked.rank);
  }
  std::vector<Eigen::Vector2d> places(vertices.size());
  for (const Place& place : exchanged(answers, back))  // vertices are sorted
    places[std::ranges::lower_bound(vertices, place.vertex) - vertices.begin()] = {place.x,
                                                                                   place.y};
  return places;
}

struct Travelling {
  int number, body;
  std::array<int, 3> vertices, edges;
};

}  // namespace

MeshSlices read_slices(NpzSlices& file) {
  MeshSlices slices;
  slices.triangles = static_cast<PetscInt>(file.rows("triangles"));
  slices.edges = static_cast<PetscInt>(file.rows("edges"));
  slices.vertices = static_cast<PetscInt>(file.rows("vertices_mm"));
  std::vector<Side> sides;
  std::vector<int> to;
  each_by_itself([&] {
    const int here = rank_here();
    const auto rows_of = [&](const char* name, PetscInt total) {
      return file.integers(name, slice_begin(total, here), slice_begin(total, here + 1));
    };
    const Eigen::MatrixXi triangles = rows_of("triangles", slices.triangles),
                          edges = rows_of("edges", slices.edges),
                          body = rows_of("triangle_body", slices.triangles);
    slices.vertices_mm = file.numbers("vertices_mm", slice_begin(slices.vertices, here),
                                      slice_begin(slices.vertices, here + 1));
    const auto send = [&](int a, int b, int triangle, int side_or_edge) {
      for (const int vertex : {a, b})
        if (vertex < 0 || vertex >= slices.vertices)
          throw FileError("problem.npz: vertex " + std::to_string(vertex) + " (allowed: 0 to " +
                          std::to_string(slices.vertices - 1) + ")");
      sides.push_back({std::min(a, b), std::max(a, b), triangle, side_or_edge});
      to.push_back(slice_owner(slices.vertices, std::min(a, b)));
    };
    const auto first = static_cast<int>(slice_begin(slices.triangles, here));
    for (int t = 0; t < static_cast<int>(triangles.rows()); ++t) {
      const std::array<int, 3> v = {triangles(t, 0), triangles(t, 1), triangles(t, 2)};
      slices.own.push_back({first + t, v, {-1, -1, -1}, {-1, -1, -1}});
      slices.body.push_back(body(t));
      for (int k = 0; k < 3; ++k) send(v[k], v[(k + 1) % 3], first + t, k);
    }
    const auto first_edge = static_cast<int>(slice_begin(slices.edges, here));
    for (int e = 0; e < static_cast<int>(edges.rows()); ++e)
      send(edges(e, 0), edges(e, 1), -1, first_edge + e);
  });
  sides = exchanged(sides, to);
  to.clear();
  std::vector<Meeting> meetings;
  each_by_itself([&] { meetings = meetings_of(std::move(sides), to, slices.triangles); });
  const PetscInt begin = slice_begin(slices.triangles, rank_here());
  for (const Meeting& met : exchanged(meetings, to)) {
    SlicedTriangle& triangle = slices.own[met.triangle - begin];
    triangle.edges[met.side] = met.edge;
    triangle.neighbours[met.side] = met.neighbour;
  }
  return slices;
}

MeshPart distribute(MeshSlices slices) {
  const std::vector<PetscInt> part = parts_of(slices);
  std::vector<Travelling> travelling;
  for (std::size_t t = 0; t < slices.own.size(); ++t) {
    const SlicedTriangle& of = slices.own[t];
    travelling.push_back({of.number, slices.body[t], of.vertices, of.edges});
  }
  slices.own = {};
  travelling = exchanged(travelling, std::vector<int>(part.begin(), part.end()));
  std::ranges::sort(travelling, {}, &Travelling::number);

  MeshPart mesh;
  mesh.edge_count = slices.edges;
  mesh.vertex_count = slices.vertices;
  std::vector<int> vertices, edges;
  std::unordered_map<int, int> local_edge;
  local_edge.reserve(2 * travelling.size());
  for (const Travelling& triangle : travelling) {
    std::array<int, 3> own;
    for (int k = 0; k < 3; ++k) {
      const auto [at, is_new] =
          local_edge.try_emplace(triangle.edges[k], static_cast<int>(edges.size()));
      if (is_new) edges.push_back(triangle.edges[k]);
      own[k] = at->second;
    }
    mesh.edges_of_triangle.push_back(own);
    mesh.body.push_back(triangle.body);
    vertices.insert(vertices.end(), triangle.vertices.begin(), triangle.vertices.end());
  }
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  for (const Travelling& triangle : travelling) {
    std::array<int, 3> own;
    for (int k = 0; k < 3; ++k)
      own[k] = static_cast<int>(std::ranges::lower_bound(vertices, triangle.vertices[k]) -
                                vertices.begin());
    mesh.triangles.push_back(own);
  }
  mesh.vertices_mm = places_of(vertices, slices);
  mesh.vertices = number_entities(std::move(vertices), slices.vertices);
  mesh.edges = number_entities(std::move(edges), slices.edges);
  return mesh;
}

}  // namespace airybench
