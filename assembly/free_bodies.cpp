#include "assembly/free_bodies.hpp"

#include "assembly/rigid_contact.hpp"

namespace airybench {

void add_free_bodies(
    const Problem& problem, int degree,
    const std::function<Eigen::Vector2d(const RigidMotion& motion, int point)>& in_frame,
    ContactPoints& contact) {
  if (!problem.free.are_unknown()) return;
  const auto& [motions, pins, piece_of_vertex, amounts] = problem.free;
  FreeBodies& free = contact.free;
  free.rigid = std::make_shared<const RigidContact>(rigid_contact(problem, degree));
  free.motions = Eigen::MatrixXd::Zero(contact.size(), std::ssize(motions));
  for (Eigen::Index m = 0; m < free.motions.cols(); ++m) {
    const auto& [piece, of_one_mm, area_mm2] = motions[m];
    for (int p = 0; p < contact.count; ++p) {
      const int start = problem.mesh.boundary[contact.boundary[p]].vertices[0];
      if (piece_of_vertex[start] == piece)
        free.motions.col(m).segment(contact.components * p, contact.components) =
            in_frame(of_one_mm, p).head(contact.components);
    }
  }
}

}  // namespace airybench
