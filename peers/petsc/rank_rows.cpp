#include "peers/petsc/rank_rows.hpp"

#include <algorithm>
#include <cmath>

#include "peers/petsc/matrices.hpp"
#include "solvers/condensation/contact_compliance.hpp"
#include "solvers/condensation/hybridized_templates.hpp"

namespace airybench {
namespace {

using namespace parallel;
using ElementVector = Eigen::Matrix<double, 12, 1>;

// About √cond(M⁻¹K) of two levels (solvers/two_level/two_levels.hpp), with a margin for an
// inexact coarse solve.
constexpr double preconditioned_condition = 4;

PC preconditioner_of(KSP ksp) {
  PC pc = nullptr;
  check(KSPGetPC(ksp, &pc));
  return pc;
}

// An affine displacement's moments are its values at an edge's third points.
std::vector<FramedPoint> points_of_slots(const BodyPart& part) {
  const Numbering& edges = part.edges;
  const Problem& problem = part.problem;
  const std::vector<int> row_of_edge = rows_in_frame(problem);
  std::vector<FramedPoint> points(static_cast<std::size_t>(2 * edges.owned));
  for (int edge = 0; edge < edges.count(); ++edge) {
    if (!edges.is_owned(edge)) continue;
    const int row = row_of_edge[edge];
    const std::array<int, 2>& ends =
        row == no_frame ? problem.edges.vertices[edge] : problem.mesh.boundary[row].vertices;
    for (int end = 0; end < 2; ++end) {
      FramedPoint& point = points[2 * (edges.global[edge] - edges.begin) + end];
      point.x =
          (2 * part.problem.mesh.vertices[ends[end]] + part.problem.mesh.vertices[ends[1 - end]]) /
          3;
      if (row == no_frame) continue;
      const EdgeFrame frame = problem.frame_of_moment(row, 1, end);
      point.frame << frame.normal, frame.tangent;
    }
  }
  return points;
}

}  // namespace

RankRows::RankRows(const BodyPart& part, CoarseSpace* coarse)
    : ContactRows(part.contact, part.compliance, preconditioned_condition),
      part_(part),
      coarse_(coarse) {
  create_matrix();
  find_contact_triangles();
  assemble_system();
  create_solvers();
}

void RankRows::assemble_system() {
  const Problem& problem = part_.problem;
  const EdgeUnknowns& unknown = part_.system.unknown;
  ContactCompliance near_contact(problem);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(part_.system.b.size()), of_prescribed = b;
  std::vector<int> slots;
  ElementVector u0;
  each_by_itself([&] {
    auto at_contact = contact_triangles_.begin();
    visit_stiffness<double>(problem, 1, [&](int t, const StiffnessOfTriangle<double>& element) {
      ElementMatrices::Matrix K = from_lower(element.lower);
      if (near_contact.asks_for(t)) near_contact.add(t, K);
      element_unknowns(problem, unknown, t, slots);
      element_displacement<double>(problem, part_.system, {}, t, u0);
      const ElementVector force = K * u0;
      prescribed_energy_ += u0.dot(force);
      for (int i = 0; i < 12; ++i) {
        if (slots[i] != prescribed_unknown) {
          b(slots[i]) -= element.load[i];
          of_prescribed(slots[i]) += force(i);
          continue;
        }
        const double diagonal = K(i, i);
        K.row(i).setZero();
        K.col(i).setZero();
        K(i, i) = diagonal;
      }
      if (coarse_ != nullptr) coarse_->add(t, K);
      add_element(t, K);
      if (at_contact != contact_triangles_.end() && at_contact->triangle == t) {
        at_contact->K = at_contact->A = K;
        ++at_contact;
      }
    });
  });
  assemble(A_);
  if (coarse_ != nullptr) coarse_->end_assembly();
  compliance_from_below_ = at_contact_points(of_whole_boundary(part_, near_contact.from_below()),
                                             part_.boundary, contact);
  b -= of_prescribed;
  add_tractions(problem, unknown, b);
  b_ = from_local(b);
  prescribed_force_ = from_local(of_prescribed);
  prescribed_energy_ = sum(prescribed_energy_);
}

void RankRows::create_matrix() {
  std::vector<Pair> pairs;
  for (const auto& [a, b, c] : part_.problem.edges.of_triangle)
    pairs.insert(pairs.end(), {{a, b}, {b, c}, {c, a}});
  check(PetscOptionsGetInt(nullptr, nullptr, "-stiffness_block_size", &block_size_, nullptr));
  if (block_size_ != 4 && block_size_ != 2 && block_size_ != 1)
    throw std::runtime_error("-stiffness_block_size " + std::to_string(block_size_) +
                             " (allowed: 1, 2, 4)");
  A_ = square_matrix(part_.edges, 4, pairs, MATBAIJ, static_cast<int>(block_size_), "stiffness_");
  if (block_size_ == 2) set_rigid_modes(A_, points_of_slots(part_));
}

void RankRows::add_element(int triangle, const ElementMatrices::Matrix& K_e) {
  const PetscInt per_edge = 4 / block_size_;
  std::array<PetscInt, 12> blocks;
  PetscInt count = 0;
  for (const int edge : part_.problem.edges.of_triangle[triangle])
    for (PetscInt k = 0; k < per_edge; ++k)
      blocks[count++] = per_edge * part_.edges.global[edge] + k;
  check(MatSetValuesBlocked(A_, count, blocks.data(), count, blocks.data(), K_e.data(),
                            ADD_VALUES));  // symmetric, so storage order does not matter
}

void RankRows::find_contact_triangles() {
  std::vector<int> first_point(part_.edges.input.size(), -1);
  for (const ContactEdge& of : part_.contact_edges) first_point[of.edge] = of.first_point;
  for (int t = 0; t < static_cast<int>(part_.problem.mesh.triangles.size()); ++t) {
    const auto& [a, b, c] = part_.problem.edges.of_triangle[t];
    const std::array<int, 3> points = {first_point[a], first_point[b], first_point[c]};
    if (std::ranges::max(points) >= 0)
      contact_triangles_.push_back(
          {t, points, ElementMatrices::Matrix::Zero(), ElementMatrices::Matrix::Zero()});
  }
}

void RankRows::create_solvers() {
  // Laws that settle at a linear error may change at a smaller one; a loose target shows it early.
  next_target = 0.01;
  for (OwnedKsp* ksp : {&symmetric_, &slipping_}) {
    check(KSPCreate(PETSC_COMM_WORLD, ksp->put()));
    check(KSPSetOperators(*ksp, A_, A_));
  }
  check(KSPSetType(symmetric_, KSPCG));
  check(KSPSetNormType(symmetric_, KSP_NORM_NATURAL));
  check(KSPSetOptionsPrefix(slipping_, "slip_"));
  check(KSPSetType(slipping_, KSPGMRES));
  if (coarse_ == nullptr || coarse_->kind() != CoarseKind::per_edge) return;
  for (const std::string name : {"mg_coarse_pc_type", "mg_coarse_pc_factor_mat_solver_type"})
    if (const auto value = option("-per_edge_" + name))
      check(PetscOptionsSetValue(nullptr, ("-" + name).c_str(), value->c_str()));
}

std::vector<PointLaw> RankRows::first_laws(int&) {
  std::vector<PointLaw> laws(static_cast<std::size_t>(contact.count));
  for (int p = 0; p < contact.count; ++p) {
    laws[p].closed = contact.gap.size() > 0 && contact.gap(contact.components * p) < 0;
    laws[p].sticks = laws[p].closed && contact.components == 2 && contact.friction_at(p) > 0;
  }
  return laws;
}

void RankRows::set(const std::vector<PointLaw>& laws) {
  if (is_set_up_ && laws == laws_) return;
  laws_ = laws;
  put_laws_into_A();
  const bool coarse_changed = coarse_ != nullptr && coarse_->set_laws(laws);
  const PC pc = preconditioner_of(symmetric_);
  if (!is_set_up_ && coarse_ != nullptr) {
    check(PCSetType(pc, PCMG));
    check(PCMGSetLevels(pc, 2, nullptr));
    check(PCMGSetDistinctSmoothUp(pc));
    check(PCMGSetInterpolation(pc, 1, coarse_->prolongation()));
  }
  if (coarse_changed) {
    KSP of_coarse = nullptr;
    check(PCMGGetCoarseSolve(pc, &of_coarse));
    check(KSPSetOperators(of_coarse, coarse_->matrix(), coarse_->matrix()));
  }
  if (!is_set_up_) {
    check(KSPSetFromOptions(symmetric_));
    check(KSPSetPC(slipping_, pc));
    check(KSPSetFromOptions(slipping_));
    for (const KSP ksp : {KSP(symmetric_), KSP(slipping_)})
      check(KSPSetResidualHistory(ksp, nullptr, PETSC_DECIDE, PETSC_TRUE));
    is_set_up_ = true;
  }
  check(KSPSetUp(symmetric_));
  check(KSPSetUp(slipping_));
}

void RankRows::move_to_gap(Eigen::VectorXd& u) const {
  visit_contact([&](int row, PetscInt slot) {
    const PointLaw& law = laws_[row / contact.components];
    const bool is_normal = row % contact.components == 0;
    if (is_normal ? law.closed : law.sticks)
      u(slot) = contact.gap.size() > 0 ? contact.gap(row) : 0;
  });
}

double RankRows::measure(const Eigen::VectorXd& u, Eigen::VectorXd& unbalanced) {
  multiply(u, unbalanced);
  const double energy = dot(u, unbalanced) + 2 * dot(u, prescribed_force_) + prescribed_energy_;
  unbalanced = b_ - unbalanced;
  return energy;
}

GmresResult RankRows::solve(Eigen::VectorXd r, const GmresOptions& options, Eigen::VectorXd& x) {
  reduce(r);
  x.setZero(r.size());
  GmresResult result;
  result.norm = norm(r);
  if (!(result.norm > 0) || !std::isfinite(result.norm)) return result;
  const bool slips = std::ranges::any_of(laws_, [](auto& law) { return law.ratio != 0; });
  const KSP ksp = slips ? slipping_ : symmetric_;
  const double tolerance = options.enough > 0
                               ? std::clamp(options.enough / result.norm, options.tolerance, 0.5)
                               : options.tolerance;
  PetscInt most = 0, iterations = 0, length = 0;
  check(KSPGetTolerances(ksp, nullptr, nullptr, nullptr, &most));
  check(KSPSetTolerances(ksp, tolerance, 0, PETSC_DEFAULT, most));
  check(KSPSolve(ksp, as_vec(r), as_vec(x)));
  check(KSPGetIterationNumber(ksp, &iterations));
  result.iterations = static_cast<int>(iterations);
  KSPConvergedReason reason;
  check(KSPGetConvergedReason(ksp, &reason));
  if (reason < 0 && reason != KSP_DIVERGED_ITS) {
    x.setZero();
    return result;
  }
  PetscReal last = 0;
  const PetscReal* history = nullptr;
  check(KSPGetResidualNorm(ksp, &last));
  check(KSPGetResidualHistory(ksp, &history, &length));
  if (length > 0 && history[0] > 0) result.reduction = last / history[0];
  return result;
}

double RankRows::error_left(const GmresResult& solve, const Eigen::VectorXd& r, bool measured) {
  if (!measured) return condition * solve.reduction * solve.norm;
  Eigen::VectorXd reduced = r;
  reduce(reduced);
  return condition * norm(reduced);
}

double RankRows::norm_from_below(const Eigen::VectorXd& F_C) {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(slots());
  visit_contact([&](int row, PetscInt slot) { forces(slot) = F_C(row); });
  return norm(forces);
}

double RankRows::norm(const Eigen::VectorXd& r) const {
  Eigen::VectorXd z = Eigen::VectorXd::Zero(r.size());
  check(PCApply(preconditioner_of(symmetric_), as_vec(r), as_vec(z)));
  return std::sqrt(std::abs(dot(r, z)));
}

void RankRows::put_laws_into_A() {
  for (ContactTriangle& of : contact_triangles_) {
    std::vector<int> held;
    of.A = of.K;
    for (int n = 0; n < 12; n += 2) {  // a point's normal slot
      if (of.first_point[n / 4] < 0) continue;
      const PointLaw& law = laws_[of.first_point[n / 4] + n / 2 % 2];
      if (law.closed) held.push_back(n);
      if (law.sticks) held.push_back(n + 1);
    }
    for (const int i : held) of.A.col(i).setZero();
    for (int n = 0; n < 12; n += 2)
      if (of.first_point[n / 4] >= 0)
        of.A.row(n + 1) -= laws_[of.first_point[n / 4] + n / 2 % 2].ratio * of.A.row(n);
    for (const int i : held) {
      of.A.row(i).setZero();
      of.A(i, i) = of.K(i, i);
    }
    const std::array<int, 3>& edges = part_.problem.edges.of_triangle[of.triangle];
    const auto slots = [&](int k) {
      const PetscInt first = 4 * part_.edges.global[edges[k]];
      return std::array{first, first + 1, first + 2, first + 3};
    };
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l) {
        if (of.first_point[k] < 0 && of.first_point[l] < 0) continue;
        const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> block = of.A.block<4, 4>(4 * k, 4 * l);
        check(
            MatSetValues(A_, 4, slots(k).data(), 4, slots(l).data(), block.data(), INSERT_VALUES));
      }
  }
  assemble(A_);
}

void RankRows::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  y.resize(x.size());
  check(MatMult(A_, as_vec(x), as_vec(y)));
  const Eigen::VectorXd local = to_local(x);
  Eigen::VectorXd rest = Eigen::VectorXd::Zero(local.size());
  for (const ContactTriangle& of : contact_triangles_) {
    const std::array<int, 3>& edges = part_.problem.edges.of_triangle[of.triangle];
    ElementVector own;
    for (int k = 0; k < 3; ++k) own.segment<4>(4 * k) = local.segment<4>(4 * edges[k]);
    const ElementVector force = (of.K - of.A) * own;
    for (int k = 0; k < 3; ++k) rest.segment<4>(4 * edges[k]) += force.segment<4>(4 * k);
  }
  y += from_local(rest);
}

void RankRows::reduce(Eigen::VectorXd& r) const {
  for (const auto& [edge, first_point] : part_.contact_edges)
    for (int end = 0; end < 2; ++end) {
      const PointLaw& law = laws_[first_point + end];
      auto own = r.segment<2>(own_slot(edge) + 2 * end);
      own(1) -= law.ratio * own(0);
      if (law.closed) own(0) = 0;
      if (law.sticks) own(1) = 0;
    }
  for (const int edge : part_.problem.edges.of_boundary)
    for (int i = 0; i < 4; ++i)
      if (part_.system.unknown[edge][i] == prescribed_unknown) r(own_slot(edge) + i) = 0;
}

Eigen::VectorXd RankRows::of_contact(const Eigen::VectorXd& x) const {
  Eigen::VectorXd rows = Eigen::VectorXd::Zero(contact.size());
  visit_contact([&](int row, PetscInt slot) { rows(row) = x(slot); });
  return sum(std::move(rows));
}

Eigen::VectorXd RankRows::to_local(const Eigen::VectorXd& x) const {
  Eigen::VectorXd local(4 * part_.edges.count());
  to_values(part_.edges.to_owned, FourNumbers().type, x.data(), local.data());
  return local;
}

Eigen::VectorXd RankRows::from_local(const Eigen::VectorXd& local) const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(4 * part_.edges.owned);
  to_rows(part_.edges.to_owned, FourNumbers().type, local.data(), x.data(), MPI_SUM);
  return x;
}

}  // namespace airybench
