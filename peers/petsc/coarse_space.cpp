#include "peers/petsc/coarse_space.hpp"

#include <algorithm>

#include "peers/petsc/matrices.hpp"

namespace airybench {
namespace {

using namespace parallel;

CoarseKind kind_for(const Problem& boundary) {
  const std::string name = option("-coarse_space").value_or("");
  if (name == "linear") return CoarseKind::linear;
  if (name == "per_edge") return CoarseKind::per_edge;
  if (name.empty()) return coarse_kind_for(boundary);
  throw std::runtime_error("-coarse_space " + name + " (allowed: linear, per_edge)");
}

std::vector<int> numbers_up_to(int count) {
  std::vector<int> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

std::vector<int> nodes_there(const BodyPart& part, CoarseKind kind) {
  if (kind == CoarseKind::linear) return part.boundary_vertex;
  std::vector<int> there(part.edges.input.size(), CoarseNodes::none);
  for (std::size_t row = 0; row < part.row_of_part.size(); ++row)
    there[part.problem.edges.of_boundary[row]] = part.row_of_part[row];
  return there;
}

std::array<bool, 4> held_by(const std::vector<PointLaw>& laws, int first_point) {
  const PointLaw &start = laws[first_point], &end = laws[first_point + 1];
  return {start.closed, start.sticks, end.closed, end.sticks};
}

}  // namespace

CoarseSpace::CoarseSpace(const BodyPart& part)
    : part_(part),
      whole_(part.boundary, kind_for(part.boundary), numbers_up_to(part.boundary.edges.count())),
      block_(numbers_up_to(part.problem.edges.count())),
      node_there_(nodes_there(part, kind())),
      own_(part.problem, whole_, node_there_, block_),
      prescribed_(static_cast<std::size_t>(whole_.count())),
      held_by_matrix_(prescribed_.size()) {
  for (const CoarseNodes::BoundaryBlock& of : whole_.boundary)
    whole_.visit_held(of, of.held, [&](int node, int k) { prescribed_[node][k] = true; });
  held_ = prescribed_;
  check(PetscOptionsGetReal(nullptr, nullptr, "-coarse_share_of_changes", &share_of_changes_,
                            nullptr));
  std::vector<Pair> pairs;
  if (kind() == CoarseKind::linear)
    for (const auto& [a, b] : part.problem.edges.vertices) pairs.push_back({a, b});
  else
    for (const auto& [a, b, c] : part.problem.edges.of_triangle)
      pairs.insert(pairs.end(), {{a, b}, {b, c}, {c, a}});
  matrix_ = square_matrix(nodes(), 2, pairs, MATAIJ, 2, "coarse_");
  create_prolongation();
}

PetscInt CoarseSpace::unknowns() const {
  PetscInt rows = 0;
  check(MatGetSize(matrix_, &rows, nullptr));
  return rows;
}

void CoarseSpace::create_prolongation() {
  const Numbering& edges = part_.edges;
  std::vector<int> inner;
  std::vector<PetscInt> in(static_cast<std::size_t>(4 * edges.owned), 0), out(in);
  for (const int edge : block_) {
    if (!edges.is_owned(edge)) continue;
    const auto& ends = own_.nodes_of(edge);
    const bool at_boundary = std::ranges::any_of(
        ends, [&](int node) { return node != CoarseNodes::none && node_there_[node] >= 0; });
    (at_boundary ? at_boundary_ : inner).push_back(edge);
    for (const int node : ends)
      for (int i = 0; node != CoarseNodes::none && i < 4; ++i)
        (nodes().is_owned(node) ? in : out)[4 * (edges.global[edge] - edges.begin) + i] +=
            at_boundary ? 2 : 1;
  }
  check(MatCreateAIJ(PETSC_COMM_WORLD, 4 * edges.owned, 2 * nodes().owned, PETSC_DETERMINE,
                     PETSC_DETERMINE, 0, in.data(), 0, out.data(), P_.put()));
  fill_prolongation(inner);
  fill_prolongation(at_boundary_);
  assemble(P_);
}

// Near the boundary also stores zeros, since held components change.
void CoarseSpace::fill_prolongation(const std::vector<int>& edges) {
  for (const int edge : edges) {
    const auto& ends = own_.nodes_of(edge);
    const int boundary = own_.boundary_of_block[edge];
    const Eigen::Matrix4d rows = own_.prolongation(edge);
    const PetscInt slot = 4 * part_.edges.global[edge];
    for (int n = 0; n < 2; ++n)
      for (int k = 0; ends[n] != CoarseNodes::none && k < 2; ++k)
        for (int i = 0; i < 4; ++i) {
          const bool held = is_held(ends[n], k) ||
                            (boundary != CoarseNodes::none && own_.boundary[boundary].held[i]);
          const double value = held ? 0 : rows(i, 2 * n + k);
          if (value != 0 || &edges == &at_boundary_)
            check(MatSetValue(P_, slot + i, 2 * nodes().global[ends[n]] + k, value, INSERT_VALUES));
        }
  }
}

void CoarseSpace::add(int triangle, const ElementMatrices::Matrix& K_e) {
  const std::array<int, 3>& own =
      (kind() == CoarseKind::linear ? part_.problem.mesh.triangles
                                    : part_.problem.edges.of_triangle)[triangle];
  const Eigen::Matrix<double, 12, 6> P =
      own_.prolongation(part_.problem, part_.system.unknown, block_, triangle, own);
  const Eigen::Matrix<double, 6, 6> of_element = P.transpose() * (K_e * P);
  std::array<PetscInt, 3> blocks;
  for (int n = 0; n < 3; ++n) blocks[n] = nodes().global[own[n]];
  check(MatSetValuesBlocked(matrix_, 3, blocks.data(), 3, blocks.data(), of_element.data(),
                            ADD_VALUES));
}

void CoarseSpace::end_assembly() {
  assemble(matrix_);
  check(MatDuplicate(matrix_, MAT_COPY_VALUES, held_matrix_.put()));
  check(MatSetOption(held_matrix_, MAT_SPD, PETSC_TRUE));
  std::vector<FramedPoint> points(static_cast<std::size_t>(nodes().owned));
  for (int node = 0; node < nodes().count(); ++node) {
    if (!nodes().is_owned(node)) continue;
    FramedPoint& point = points[nodes().global[node] - nodes().begin];
    const std::vector<Eigen::Vector2d>& x = part_.problem.mesh.vertices;
    if (kind() == CoarseKind::linear) {
      point.x = x[node];
    } else {
      const auto [a, b] = part_.problem.edges.vertices[node];
      point.x = (x[a] + x[b]) / 2;
    }
    point.frame = own_.frame_at(node);
  }
  set_rigid_modes(held_matrix_, points);
}

bool CoarseSpace::set_laws(const std::vector<PointLaw>& laws) {
  const ContactPoints& contact = part_.contact;
  held_ = prescribed_;
  for (int p = 0; p < contact.count; p += 2)
    whole_.visit_held(whole_.boundary[whole_.boundary_of_block[contact.boundary[p]]],
                      held_by(laws, p), [&](int node, int k) { held_[node][k] = true; });
  for (const auto& [edge, first_point] : part_.contact_edges)
    own_.boundary[own_.boundary_of_block[edge]].held = held_by(laws, first_point);
  fill_prolongation(at_boundary_);
  assemble(P_);

  // A few nodes held too many or too few cost an iteration, a new setup several.
  std::size_t changes = 0;
  for (std::size_t node = 0; node < held_.size(); ++node)
    for (int k = 0; k < 2; ++k) changes += held_[node][k] != held_by_matrix_[node][k];
  const auto few = static_cast<std::size_t>(share_of_changes_ * contact.size());
  if (matrix_is_held_ && changes <= few) return false;
  matrix_is_held_ = true;
  held_by_matrix_ = held_;
  std::vector<PetscInt> rows;
  for (int node = 0; node < nodes().count(); ++node)
    for (int k = 0; k < 2; ++k)
      if (nodes().is_owned(node) && is_held(node, k)) rows.push_back(2 * nodes().global[node] + k);
  check(MatCopy(matrix_, held_matrix_, SAME_NONZERO_PATTERN));
  OwnedVec diagonal;
  check(MatCreateVecs(matrix_, nullptr, diagonal.put()));
  check(MatGetDiagonal(matrix_, diagonal));
  PetscScalar scale = 0;
  check(VecMax(diagonal, nullptr, &scale));
  check(MatZeroRowsColumns(held_matrix_, static_cast<PetscInt>(rows.size()), rows.data(), scale,
                           nullptr, nullptr));
  return true;
}

}  // namespace airybench
