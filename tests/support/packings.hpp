// Contact problems of rigid bodies, as granular codes make them, from a seed: M v = H r + f, u = Hᵀ
// v + w (solvers/condensation/global_problem.hpp), with an answer that is chosen first.
//
//   brick wall    boxes in rows, each on two of the row below, at the corners of what they share:
//                 two contacts a pair in the plane, four in space; far more than hold a box
//   periodic box  disks or balls of different sizes near the points of a lattice, which goes on
//                 at the other side; some contacts are left out
//   flow          the same on a wall, contacts as velocities without contact would close them: no
//                 answer is known, and none but the contact law's can be
#pragma once

#include <Eigen/SparseCore>

#include "assembly/contact_problem.hpp"

namespace airybench::testing {

enum class Packed { brick_wall, periodic_box, flow };

struct Packing {
  Eigen::SparseMatrix<double> M, H;  // n × n, diagonal; n × n_c
  Eigen::VectorXd f, w;
  ContactPoints points;
  Eigen::VectorXd F;  // −r; one answer of many where W is singular; empty: flow

  Eigen::Index bodies() const { return M.rows() / (points.components == 2 ? 3 : 6); }
  // W = Hᵀ M⁻¹ H and q, stored sparse.
  contact::Problem problem() const;
};

// At least so many contacts.
Packing packing(Packed shape, int components, int contacts, unsigned seed);

// A long elastic strip of P1 triangles, cells × 5 squares, in a time step: M, one block, is its
// mass and its stiffness, and contacts are at all nodes of both long sides. With few of M's entries
// and many contacts, W is full and far larger than M and H. The answer is chosen; W is regular,
// which makes it the only one. problem() does not apply.
Packing elastic_strip(int cells, unsigned seed);

}  // namespace airybench::testing
