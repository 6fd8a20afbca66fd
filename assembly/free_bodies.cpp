#include "assembly/free_bodies.hpp"

#include "assembly/displacement_field.hpp"

namespace airybench {
namespace {

// l_m = ∫ b·N_m + ∫_{Γ_F} f·N_m, N.
Eigen::VectorXd loads_on_motions(const Problem& problem) {
  const auto count = static_cast<Eigen::Index>(problem.free.motions.size());
  Eigen::VectorXd loads(count);
  FreeMotions moved = problem.free;
  for (Eigen::Index m = 0; m < count; ++m) {
    moved.amounts_mm = Eigen::VectorXd::Unit(count, m);
    loads(m) = work_on_free_motion(problem, moved);
  }
  return loads;
}

}  // namespace

void add_free_bodies(
    const Problem& problem,
    const std::function<Eigen::Vector2d(const RigidMotion& motion, int point)>& in_frame,
    ContactPoints& contact) {
  if (!problem.free.are_unknown()) return;
  const auto& [motions, pins, piece_of_vertex, amounts] = problem.free;
  FreeBodies& free = contact.free;
  free.loads_N = loads_on_motions(problem);
  free.motions = Eigen::MatrixXd::Zero(contact.size(), free.loads_N.size());
  for (Eigen::Index m = 0; m < free.loads_N.size(); ++m) {
    const auto& [piece, of_one_mm] = motions[m];
    for (int p = 0; p < contact.count; ++p) {
      const int start = problem.mesh.boundary[contact.boundary[p]].vertices[0];
      if (piece_of_vertex[start] == piece)
        free.motions.col(m).segment(contact.components * p, contact.components) =
            in_frame(of_one_mm, p).head(contact.components);
    }
    free.bodies.push_back(name_of_piece(problem.mesh, piece_of_vertex, piece));
    free.along.push_back(of_one_mm.translation_mm);
  }
}

}  // namespace airybench
