// The mesh of an exported body, spread over the ranks: each has only its own triangles.
//
//   slices    every rank reads an equal share of triangles, edges and vertices; the rank with an
//             edge's low vertex in its slice finds the triangles that meet at the edge
//   parts     MatPartitioning (-mat_partitioning_type) partitions the dual graph; triangles move to
//             their parts
//   numbers   an edge or vertex belongs to the lowest rank that has it; a rank's numbers are
//             consecutive, edges in the order in which triangles meet them
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

struct Numbering {
  std::vector<PetscInt> input;    // local → number in the file
  std::vector<PetscInt> global;   // local → number among all ranks
  PetscInt all = 0;               // count on all ranks
  PetscInt owned = 0, begin = 0;  // this rank owns global numbers [begin, begin + owned)
  parallel::OwnedSf to_owned;     // local → row among the owned ones of all ranks

  int count() const { return static_cast<int>(input.size()); }
  bool is_owned(int local) const { return global[local] >= begin && global[local] < begin + owned; }
};

struct MeshPart {
  Mesh mesh;  // vertices and triangles in file order; no boundary
  MeshEdges edges;
  Numbering vertex_numbers, edge_numbers;
  Eigen::MatrixXd vertex_slice_mm;  // vertices of the file
};
MeshPart distribute(MeshSlices slices);
// Coordinates of vertices of the file, from the ranks with their slices.
std::vector<Eigen::Vector2d> places_of(const std::vector<PetscInt>& vertices,
                                       const Eigen::MatrixXd& slice_mm);

}  // namespace airybench
