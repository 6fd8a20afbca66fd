// Rigid motions of pieces of a mesh that no displacement edge holds: contact does, or their loads
// balance and point supports (point_supports.hpp) take the motion out.
//
//   u = w + ρ + Σ_m a_m N_m   on such a piece, a_m in mm
//
// w vanishes at pins, as many freedoms as the piece has motions. So all matrices are those of held
// bodies. Where contact balances the loads on every N_m, N_mᵀ F + l_m = 0, pins have no reactions,
// and w has the stresses of u. free_bodies.hpp (solvers/contact) finds a.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assembly/problem/point_supports.hpp"
#include "assembly/problem/rigid_motion.hpp"
#include "mesh/mesh.hpp"

namespace airybench {

// What the displacement edges of a piece leave free: nothing, the motion along parallel rollers, or
// without such edges all motions.
struct PieceSupport {
  bool is_free = true, in_contact = false, has_points = false;
  std::optional<Eigen::Vector2d> along;  // of parallel rollers
};
// Per piece. rollers: per row of Mesh::boundary; empty: none.
std::vector<PieceSupport> supports_of(const Mesh& mesh, const std::vector<bool>& rollers,
                                      const std::vector<PointSupport>& points,
                                      const MeshPieces& pieces);

// Motions of a piece do not accelerate one another: translations, and the turn about its centroid,
// of 1 mm at the radius of gyration √(∫|x − c|²/A). The mass of each is the area A.
struct FreeMotion {
  int piece;  // of MeshPieces
  RigidMotion of_one_mm;
  double area_mm2;
};

// w has no such component on a force edge, a row of Mesh::boundary: of moments the edge's first, of
// displacements the first coefficient within the edge, which no other edge shares.
struct Pin {
  int row, component;
};

struct FreeMotions {
  std::vector<FreeMotion> motions;
  std::vector<Pin> pins;             // as many; fewer: a piece has no place for them
  std::vector<int> piece_of_vertex;  // empty where there is no motion
  Eigen::VectorXd amounts_mm;        // a; empty: not known

  bool are_unknown() const { return !motions.empty() && amounts_mm.size() == 0; }
  // Of the piece that this vertex belongs to; without amounts zero.
  Eigen::Vector2d at(const Eigen::Vector2d& x, int vertex) const;
  // At an end of a boundary edge, from its start on.
  bool pins_down(int row, int end, int component) const;
};

// Of pieces with contact edges or point supports: all three, or the one that parallel rollers
// leave.
FreeMotions free_motions(const Mesh& mesh, const std::vector<bool>& rollers,
                         const std::vector<PointSupport>& points, const MeshPieces& pieces);

// "the piece at the vertex [0, 0]".
std::string place_of_piece(const Mesh& mesh, const std::vector<int>& piece_of_vertex, int piece);
// As users know it: the name of its body if it has one of its own, else its place.
std::string name_of_piece(const Mesh& mesh, const std::vector<int>& piece_of_vertex, int piece);

}  // namespace airybench
