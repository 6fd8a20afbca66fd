#include "bench/check/no_solution.hpp"

#include "bench/problems/problem_arrays.hpp"

namespace airybench {
namespace {

// r_n = ± a (F_1 − F_2) − offset at its two ends: their sum does not depend on F, and is > 0.
contact::Problem wedged_beam() {
  constexpr double a = 0x1p-17;  // mm/N; a power of 2: D is singular to the last bit
  constexpr double too_near_mm = 0.01;
  contact::Problem beam;
  beam.D = Eigen::Vector4d::Constant(a).asDiagonal();
  beam.D(0, 2) = beam.D(2, 0) = -a;
  beam.G = -too_near_mm * Eigen::Vector4d(1, 0, 1, 0);
  beam.points.count = 2;
  beam.points.friction = {0.3, 0.3};
  beam.points.gap = Eigen::Vector4d::Zero();
  beam.name = "wedged";
  return beam;
}

AirySystem with_contradiction(AirySystem system) {
  Eigen::MatrixXd rows = system.C_F;
  rows.row(1) = rows.row(0);
  system.C_F = rows.sparseView();
  system.F = written_out(system.F, system.n_f());
  system.F(1) = system.F(0) + 1;
  return system;
}

std::shared_ptr<const Problem> pulled_off(const Problem& held) {
  const auto free = std::make_shared<Problem>(held);
  for (BoundaryEdge& edge : free->mesh.boundary)
    if (edge.role == BoundaryRole::displacement) edge.role = BoundaryRole::force;
  free->loads.displacement_mm = {};
  free->loads.traction_MPa = {};
  free->loads.body_force_N_per_mm3 = {-1, 2};
  return free;
}

}  // namespace

Solution answer_without_solution(const Method& program, const PosedScene& scene,
                                 const RunControl& control) {
  if (program.solve_contact) return run(program.solve_contact, wedged_beam(), control);
  if (program.unknowns == Unknowns::airy_function)
    return run(program, with_contradiction(airy_system(scene.body())), control);
  return run(program, contact_system(pulled_off(*scene.body())), control);
}

}  // namespace airybench
