// The triangles of the open Gmsh model, in the plane, and the curves around them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <string>
#include <vector>

#include "mesh/edge_curve.hpp"
#include "support/errors.hpp"

namespace airybench {

using Nodes = std::array<std::size_t, 2>;  // Gmsh's node numbers of an edge

struct ModelCurve {
  int number = 0;                  // Gmsh's; higher ones: sides that no curve has
  std::vector<std::string> names;  // of its physical curves, "7" of an unnamed one
  std::vector<Nodes> sides;        // on the boundary, the body on their left
  std::vector<Nodes> inner;        // its other edges
  std::string label;               // "force:top", see give_roles
  bool is_unnamed_role = false;    // the label is that of the rest, or of what is free
  bool is_named() const { return !names.empty(); }
};

struct ModelTriangle {
  std::array<std::size_t, 3> nodes;  // counter-clockwise
  int body, surface;                 // row of body_names; Gmsh's number
};

struct PlaneModel {
  double mm_per_unit = 1;                           // of the model's coordinates
  std::map<std::size_t, Eigen::Vector2d> position;  // mm, of the triangles' nodes
  std::vector<ModelTriangle> triangles;
  std::vector<std::string> body_names;
  std::vector<ModelCurve> curves;         // those of Gmsh with an edge, by number, then the others
  std::map<Nodes, EdgeCurve> bent_sides;  // mm, of the boundary, the body on their left
};

struct FlatTriangleError : InputError {
  using InputError::InputError;
};

// Of the physical surfaces, or of all where there is none. Quadrilaterals are split by the shorter
// diagonal, the planes y = constant and x = constant turned; a note tells of each. A side of the
// boundary is bent as the curve of the geometry that it is on, without one as the nodes inside it.
// Inner sides become chords. Sides of the boundary that no curve has become curves from
// corner to corner. Throws InputError, FlatTriangleError.
PlaneModel read_plane_model(double mm_per_unit, std::vector<std::string>& notes);

// A curve's sides as connected walks of nodes; a closed one ends where it begins.
std::vector<std::vector<std::size_t>> walks_of(const ModelCurve& curve);

}  // namespace airybench
