// The mesh of an exported body, spread over the ranks: each has its own triangles only.
//
//   slices    every rank reads as many rows of triangles, edges and vertices; who meets whom at an
//             edge is found at the rank that has the edge's low vertex in its slice
//   parts     the dual graph is partitioned (MatPartitioning: -mat_partitioning_type), triangles go
//             where they belong
//   numbers   edges and vertices of the parts: an entity belongs to the lowest rank that has it,
//             and the numbers of a rank follow one another, edges in the order in which triangles
//             meet them
#pragma once

#include "mesh/mesh.hpp"
#include "peers/petsc/npz_slices.hpp"
#include "peers/petsc/parallel.hpp"

namespace airybench {

struct SlicedTriangle {
  int number, body;
  std::array<int, 3> vertices, edges, neighbours;  // edge k joins vertices k, k + 1; −1: none
};
struct MeshSlices {
  PetscInt triangles = 0, edges = 0, vertices = 0;  // of all ranks
  std::vector<SlicedTriangle> own;
  Eigen::MatrixXd vertices_mm;
};
MeshSlices read_slices(const NpzSlices& file);

// Entities (vertices, edges) of a part.
struct Numbering {
  std::vector<PetscInt> input;    // local → the number that it has in the file
  std::vector<PetscInt> global;   // local → its number among all ranks
  PetscInt all = 0;               // of all ranks
  PetscInt owned = 0, begin = 0;  // global numbers [begin, begin + owned) are of this rank
  parallel::OwnedSf to_owned;     // local → its row among the owned ones of all ranks

  int count() const { return static_cast<int>(input.size()); }
  bool is_owned(int local) const { return global[local] >= begin && global[local] < begin + owned; }
};

struct MeshPart {
  Mesh mesh;  // vertices and triangles in the order of their input numbers; without boundary
  MeshEdges edges;
  Numbering vertex_numbers, edge_numbers;
  Eigen::MatrixXd vertex_slice_mm;  // of the vertices of the file
};
MeshPart distribute(MeshSlices slices);
// Coordinates of vertices of the file from the ranks that have them in their slices.
std::vector<Eigen::Vector2d> places_of(const std::vector<PetscInt>& vertices,
                                       const Eigen::MatrixXd& slice_mm);

}  // namespace airybench
