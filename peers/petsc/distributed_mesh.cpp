#include "peers/petsc/distributed_mesh.hpp"

#include <algorithm>
#include <unordered_map>

#include "support/errors.hpp"

namespace airybench {
namespace {

using namespace parallel;

struct Side {  // of a triangle; or an edge of the file, with triangle −1
  int low, high, triangle, side_or_edge;
};
struct Meeting {
  int triangle, side, edge, neighbour;
};

// Sorting puts sides that meet next to each other, after their edge.
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

std::vector<int> parts_of(const MeshSlices& slices) {
  const auto own = static_cast<PetscInt>(slices.own.size());
  std::vector<int> part(slices.own.size(), 0);
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

// input: in the order in which the owner numbers them. all: count in the file.
Numbering number_entities(std::vector<PetscInt> input, PetscInt all) {
  Numbering result;
  result.all = all;
  const PetscInt own_slice = slice_begin(all, rank_here() + 1) - slice_begin(all, rank_here());
  const OwnedSf to_slices = rows_of(own_slice, input);
  std::vector<int> owner(input.size(), rank_here()),
      of_slice(static_cast<std::size_t>(own_slice), rank_count());
  to_rows(to_slices, MPI_INT, owner.data(), of_slice.data(), MPI_MIN);
  to_values(to_slices, MPI_INT, of_slice.data(), owner.data());
  result.owned = static_cast<PetscInt>(std::ranges::count(owner, rank_here()));
  MPI_Exscan(&result.owned, &result.begin, 1, MPIU_INT, MPI_SUM, PETSC_COMM_WORLD);
  if (rank_here() == 0) result.begin = 0;
  PetscInt next = result.begin;
  for (const int rank : owner) result.global.push_back(rank == rank_here() ? next++ : -1);
  std::vector<PetscInt> number(of_slice.size(), -1);
  to_rows(to_slices, MPIU_INT, result.global.data(), number.data(), MPI_MAX);
  to_values(to_slices, MPIU_INT, number.data(), result.global.data());
  result.to_owned = rows_of(result.owned, result.global);
  result.input = std::move(input);
  return result;
}

}  // namespace

std::vector<Eigen::Vector2d> places_of(const std::vector<PetscInt>& vertices,
                                       const Eigen::MatrixXd& slice_mm) {
  const OwnedSf to_slices = rows_of(static_cast<PetscInt>(slice_mm.rows()), vertices);
  Eigen::MatrixX2d places(vertices.size(), 2);
  for (const int k : {0, 1})
    to_values(to_slices, MPI_DOUBLE, slice_mm.col(k).data(), places.col(k).data());
  return {places.rowwise().begin(), places.rowwise().end()};
}

MeshSlices read_slices(const NpzSlices& file) {
  MeshSlices slices;
  std::vector<Side> sides;
  std::vector<int> to;
  each_by_itself([&] {
    const auto total = [&](const char* name) { return static_cast<PetscInt>(file.rows(name)); };
    const auto first_row = [&](PetscInt rows) {
      return static_cast<int>(slice_begin(rows, rank_here()));
    };
    const auto slice_of = [&](const char* name, PetscInt rows) {
      return file.read<int>(name, first_row(rows), slice_begin(rows, rank_here() + 1));
    };
    slices.vertices = total("vertices_mm");
    slices.triangles = total("triangles");
    slices.edges = total("edges");
    slices.vertices_mm = file.read<double>("vertices_mm", first_row(slices.vertices),
                                           slice_begin(slices.vertices, rank_here() + 1));
    const Eigen::MatrixXi triangles = slice_of("triangles", slices.triangles),
                          edges = slice_of("edges", slices.edges),
                          body = slice_of("triangle_body", slices.triangles);
    const int first = first_row(slices.triangles), first_edge = first_row(slices.edges);
    const auto send = [&](int a, int b, int triangle, int side_or_edge) {
      for (const int vertex : {a, b})
        if (vertex < 0 || vertex >= slices.vertices)
          throw FileError("problem.npz: vertex " + std::to_string(vertex) + " (allowed: 0 to " +
                          std::to_string(slices.vertices - 1) + ")");
      sides.push_back({std::min(a, b), std::max(a, b), triangle, side_or_edge});
      to.push_back(slice_owner(slices.vertices, std::min(a, b)));
    };
    for (int t = 0; t < static_cast<int>(triangles.rows()); ++t) {
      const std::array<int, 3> v = {triangles(t, 0), triangles(t, 1), triangles(t, 2)};
      const int number = first + t;
      slices.own.push_back({number, body(t), v, {-1, -1, -1}, {-1, -1, -1}});
      for (int k = 0; k < 3; ++k) send(v[k], v[(k + 1) % 3], number, k);
    }
    for (int e = 0; e < static_cast<int>(edges.rows()); ++e)
      send(edges(e, 0), edges(e, 1), -1, first_edge + e);
  });
  sides = exchanged(sides, to);
  to.clear();
  std::vector<Meeting> meetings;
  each_by_itself([&] { meetings = meetings_of(std::move(sides), to, slices.triangles); });
  for (const Meeting& met : exchanged(meetings, to)) {
    SlicedTriangle& triangle = slices.own[met.triangle - slices.own.front().number];
    triangle.edges[met.side] = met.edge;
    triangle.neighbours[met.side] = met.neighbour;
  }
  return slices;
}

MeshPart distribute(MeshSlices slices) {
  const std::vector<SlicedTriangle> triangles = [&] {
    std::vector<SlicedTriangle> own = exchanged(slices.own, parts_of(slices));
    std::ranges::sort(own, {}, &SlicedTriangle::number);
    slices.own = {};
    return own;
  }();
  MeshPart part;
  std::vector<PetscInt> vertices, edges;
  for (const SlicedTriangle& triangle : triangles)
    vertices.insert(vertices.end(), triangle.vertices.begin(), triangle.vertices.end());
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  std::unordered_map<int, int> local_edge;
  local_edge.reserve(2 * triangles.size());
  for (const SlicedTriangle& triangle : triangles) {
    part.mesh.triangle_body.push_back(triangle.body);
    std::array<int, 3>& corner = part.mesh.triangles.emplace_back();
    for (int k = 0; k < 3; ++k)
      corner[k] = static_cast<int>(std::ranges::lower_bound(vertices, triangle.vertices[k]) -
                                   vertices.begin());
    std::array<int, 3>& side = part.edges.of_triangle.emplace_back();
    for (int k = 0; k < 3; ++k) {
      const auto [at, is_new] =
          local_edge.try_emplace(triangle.edges[k], static_cast<int>(edges.size()));
      side[k] = at->second;
      if (!is_new) continue;
      edges.push_back(triangle.edges[k]);
      const auto [low, high] = std::minmax(corner[k], corner[(k + 1) % 3]);
      part.edges.vertices.push_back({low, high});
    }
  }
  part.mesh.vertices = places_of(vertices, slices.vertices_mm);
  part.vertex_numbers = number_entities(std::move(vertices), slices.vertices);
  part.edge_numbers = number_entities(std::move(edges), slices.edges);
  part.vertex_slice_mm = std::move(slices.vertices_mm);
  return part;
}

}  // namespace airybench
