#include "peers/petsc/coarse_space.hpp"

#include <algorithm>
#include <cmath>

#include "peers/petsc/rigid_modes.hpp"
#include "peers/petsc/square_matrix.hpp"

namespace airybench {
namespace {

using namespace parallel;

// The slots of an edge's end k from its own node and from the other one.
constexpr std::array<std::array<double, 2>, 2> weights_of(CoarseKind kind) {
  if (kind == CoarseKind::per_edge) return {{{1, 0}, {1, 0}}};
  return {{{2. / 3, 1. / 3}, {1. / 3, 2. / 3}}};
}

// A component that a direction has a part in.
template <typename Visit>
void visit_components(const Eigen::Matrix2d& frame, const Eigen::Vector2d& direction, Visit visit) {
  constexpr double part = 0.3;  // neighbours on a round wall differ by less
  const Eigen::Vector2d own = frame.transpose() * direction;
  for (int k = 0; k < 2; ++k)
    if (std::abs(own(k)) > part) visit(k);
}

void zero_rows(Vec x, const std::vector<PetscInt>& rows) {
  PetscScalar* values = nullptr;
  check(VecGetArray(x, &values));
  for (const PetscInt row : rows) values[row] = 0;
  check(VecRestoreArray(x, &values));
}

}  // namespace

CoarseKind coarse_kind_for(const BodyPart& part) {
  std::array<char, 32> given{};
  PetscBool is_given = PETSC_FALSE;
  check(PetscOptionsGetString(nullptr, nullptr, "-coarse_space", given.data(), given.size(),
                              &is_given));
  if (is_given == PETSC_TRUE) {
    const std::string name = given.data();
    if (name == "linear") return CoarseKind::linear;
    if (name == "per_edge") return CoarseKind::per_edge;
    throw OptionError("-coarse_space " + name + " (allowed: linear, per_edge)");
  }
  constexpr double nearly = 0.03;  // 1 − 2ν in plane strain: ν = 0.485
  for (const Eigen::Matrix3d& C : part.problem.compliance) {
    const double volume = C(0, 0) + C(1, 1) + 2 * C(0, 1), shear = C(0, 0) + C(1, 1) - 2 * C(0, 1);
    if (volume < nearly * shear) return CoarseKind::per_edge;
  }
  return CoarseKind::linear;
}

CoarseSpace::CoarseSpace(const BodyPart& part, CoarseKind kind) : part_(part), kind_(kind) {
  row_of_edge_.assign(part.mesh.edges.input.size(), -1);
  for (std::size_t row = 0; row < part.problem.edges.of_boundary.size(); ++row)
    row_of_edge_[part.problem.edges.of_boundary[row]] = static_cast<int>(row);
  boundary_node_of_.assign(nodes().input.size(), -1);
  if (kind == CoarseKind::linear)
    boundary_node_of_ = part.boundary_vertex;
  else
    for (std::size_t edge = 0; edge < row_of_edge_.size(); ++edge)
      if (row_of_edge_[edge] >= 0) boundary_node_of_[edge] = part.row_of_part[row_of_edge_[edge]];
  find_boundary_nodes();

  std::vector<Pair> pairs;
  if (kind == CoarseKind::linear)
    for (const auto& [a, b] : part.problem.edges.vertices) pairs.push_back({a, b});
  else
    for (const auto& [a, b, c] : part.mesh.edges_of_triangle)
      pairs.insert(pairs.end(), {{a, b}, {b, c}, {c, a}});
  create_square_matrix(nodes(), 2, pairs, MATAIJ, 2, "coarse_", matrix_);
  check(MatSetOption(matrix_, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  create_prolongation();
}

PetscInt CoarseSpace::unknowns() const {
  PetscInt rows = 0;
  check(MatGetSize(matrix_, &rows, nullptr));
  return rows;
}

const CoarseSpace::Node* CoarseSpace::node_at(int local) const {
  const int at = boundary_node_of_[local];
  return at < 0 ? nullptr : &boundary_nodes_[at];
}

std::array<int, 2> CoarseSpace::nodes_of_row(int row) const {
  return kind_ == CoarseKind::linear ? part_.boundary.mesh.boundary[row].vertices
                                     : std::array{row, row};
}

// Directions of a row's slots that are held (four flags), and its nodes.
template <typename Visit>
void CoarseSpace::visit_slots(int row, const std::vector<bool>& held, Visit visit) const {
  const Problem& boundary = part_.boundary;
  const bool in_frame = boundary.condition(row).in_frame;
  for (int i = 0; i < 4; ++i) {
    if (!held[i]) continue;
    const EdgeFrame frame = boundary.frame_of_moment(row, i / 2);
    const Direction direction = in_frame     ? (i % 2 == 0 ? frame.normal : frame.tangent)
                                : i % 2 == 0 ? Direction(Direction::UnitX())
                                             : Direction(Direction::UnitY());
    for (const int node : nodes_of_row(row)) visit(node, direction);
  }
}

void CoarseSpace::find_boundary_nodes() {
  const Problem& boundary = part_.boundary;
  const auto rows = static_cast<int>(boundary.mesh.boundary.size());
  boundary_nodes_.resize(kind_ == CoarseKind::linear ? boundary.mesh.vertices.size()
                                                     : static_cast<std::size_t>(rows));
  for (int row = 0; row < rows; ++row) {
    if (!boundary.condition(row).in_frame) continue;
    const EdgeFrame frame = boundary.frame_of_moment(row, 0);
    for (const int at : nodes_of_row(row)) {
      Node& node = boundary_nodes_[at];
      if (node.has_frame) continue;
      node.has_frame = true;
      node.frame << frame.normal, frame.tangent;
    }
  }
  for (int row = 0; row < rows; ++row) {
    const EdgeCondition condition = boundary.condition(row);
    std::vector<bool> held(4);
    for (int i = 0; i < 4; ++i) held[i] = condition.component[i % 2] == Known::displacement;
    visit_slots(row, held, [&](int at, const Direction& direction) {
      Node& node = boundary_nodes_[at];
      visit_components(node.frame, direction, [&](int k) { node.prescribed[k] = true; });
    });
  }
  for (Node& node : boundary_nodes_) node.held = node.prescribed;
  held_by_matrix_.resize(boundary_nodes_.size());
  check(PetscOptionsGetReal(nullptr, nullptr, "-coarse_share_of_changes", &share_of_changes_,
                            nullptr));
}

// An edge's slots by the components of its nodes; local nodes in ends, the second −1 of one alone.
Eigen::Matrix4d CoarseSpace::edge_rows(int edge, std::array<int, 2>& ends) const {
  const Problem& problem = part_.problem;
  const int row = row_of_edge_[edge];
  const bool in_frame = row >= 0 && problem.condition(row).in_frame;
  if (kind_ == CoarseKind::per_edge)
    ends = {edge, -1};
  else
    ends = in_frame ? problem.mesh.boundary[row].vertices : problem.edges.vertices[edge];
  const auto weights = weights_of(kind_);
  Eigen::Matrix4d rows = Eigen::Matrix4d::Zero();
  for (int n = 0; n < 2; ++n) {
    if (ends[n] < 0) continue;
    const Node* node = node_at(ends[n]);
    for (int end = 0; end < 2; ++end) {
      Eigen::Matrix2d directions = Eigen::Matrix2d::Identity();  // rows
      if (in_frame) {
        const EdgeFrame frame = problem.frame_of_moment(row, end);
        directions << frame.normal.transpose(), frame.tangent.transpose();
      }
      rows.block<2, 2>(2 * end, 2 * n) =
          weights[end][n] *
          (node == nullptr ? directions : Eigen::Matrix2d(directions * node->frame));
    }
  }
  if (row >= 0) {
    const EdgeCondition condition = problem.condition(row);
    for (int i = 0; i < 4; ++i)
      if (condition.component[i % 2] == Known::displacement) rows.row(i).setZero();
  }
  return rows;
}

void CoarseSpace::create_prolongation() {
  const Numbering &edges = part_.mesh.edges, &coarse = nodes();
  const auto visit = [&](auto use) {
    for (int edge = 0; edge < static_cast<int>(edges.input.size()); ++edge) {
      if (!edges.is_owned(edge)) continue;
      std::array<int, 2> ends{};
      const Eigen::Matrix4d rows = edge_rows(edge, ends);
      for (int i = 0; i < 4; ++i)
        for (int n = 0; n < 2; ++n)
          for (int k = 0; k < 2; ++k)
            if (rows(i, 2 * n + k) != 0)
              use(4 * edges.global[edge] + i, ends[n], k, rows(i, 2 * n + k));
    }
  };
  std::vector<PetscInt> in(static_cast<std::size_t>(4 * edges.owned), 0), out(in);
  visit([&](PetscInt row, int node, int, double) {
    ++(coarse.is_owned(node) ? in : out)[row - 4 * edges.begin];
  });
  check(MatCreate(PETSC_COMM_WORLD, P_.put()));
  check(MatSetSizes(P_, 4 * edges.owned, 2 * coarse.owned, PETSC_DETERMINE, PETSC_DETERMINE));
  check(MatSetType(P_, MATAIJ));
  check(MatSeqAIJSetPreallocation(P_, 0, in.data()));
  check(MatMPIAIJSetPreallocation(P_, 0, in.data(), 0, out.data()));
  visit([&](PetscInt row, int node, int k, double value) {
    check(MatSetValue(P_, row, 2 * coarse.global[node] + k, value, INSERT_VALUES));
  });
  check(MatAssemblyBegin(P_, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(P_, MAT_FINAL_ASSEMBLY));

  check(MatCreateVecs(P_, held_.coarse_work.put(), held_.fine_work.put()));
  held_.P = P_;
  check(MatCreateShell(PETSC_COMM_WORLD, 4 * edges.owned, 2 * coarse.owned, PETSC_DETERMINE,
                       PETSC_DETERMINE, &held_, shell_.put()));
  const auto set = [&](MatOperation operation, auto function) {
    check(MatShellSetOperation(shell_, operation, reinterpret_cast<void (*)()>(function)));
  };
  set(MATOP_MULT, &CoarseSpace::prolong);
  set(MATOP_MULT_ADD, &CoarseSpace::prolong_add);
  set(MATOP_MULT_TRANSPOSE, &CoarseSpace::restrict_to);
}

PetscErrorCode CoarseSpace::prolong(Mat shell, Vec v, Vec x) {
  Held* held = nullptr;
  PetscCall(MatShellGetContext(shell, &held));
  PetscCall(VecCopy(v, held->coarse_work));
  zero_rows(held->coarse_work, held->coarse);
  PetscCall(MatMult(held->P, held->coarse_work, x));
  zero_rows(x, held->fine);
  return 0;
}
PetscErrorCode CoarseSpace::prolong_add(Mat shell, Vec v, Vec add, Vec x) {
  Held* held = nullptr;
  PetscCall(MatShellGetContext(shell, &held));
  PetscCall(prolong(shell, v, held->fine_work));
  if (x != add) PetscCall(VecCopy(add, x));
  PetscCall(VecAXPY(x, 1, held->fine_work));
  return 0;
}
PetscErrorCode CoarseSpace::restrict_to(Mat shell, Vec r, Vec f) {
  Held* held = nullptr;
  PetscCall(MatShellGetContext(shell, &held));
  PetscCall(VecCopy(r, held->fine_work));
  zero_rows(held->fine_work, held->fine);
  PetscCall(MatMultTranspose(held->P, held->fine_work, f));
  zero_rows(f, held->coarse);
  return 0;
}

void CoarseSpace::add(int triangle, const ElementStiffness& K_e) {
  const auto& edges = part_.mesh.edges_of_triangle[triangle];
  const std::array<int, 3> own =
      kind_ == CoarseKind::linear ? part_.mesh.triangles[triangle] : edges;
  Eigen::Matrix<double, 12, 6> P = Eigen::Matrix<double, 12, 6>::Zero();
  for (int k = 0; k < 3; ++k) {
    std::array<int, 2> ends{};
    const Eigen::Matrix4d rows = edge_rows(edges[k], ends);
    for (int n = 0; n < 2; ++n)
      if (ends[n] >= 0)
        P.block<4, 2>(4 * k, 2 * (std::ranges::find(own, ends[n]) - own.begin())) =
            rows.middleCols<2>(2 * n);
  }
  const Eigen::Matrix<double, 6, 6> of_element = P.transpose() * (K_e * P);
  std::array<PetscInt, 3> blocks;
  for (int n = 0; n < 3; ++n) blocks[n] = nodes().global[own[n]];
  check(MatSetValuesBlocked(matrix_, 3, blocks.data(), 3, blocks.data(), of_element.data(),
                            ADD_VALUES));
}

void CoarseSpace::end_assembly() {
  check(MatAssemblyBegin(matrix_, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(matrix_, MAT_FINAL_ASSEMBLY));
  check(MatDuplicate(matrix_, MAT_COPY_VALUES, held_matrix_.put()));
  check(MatSetOption(held_matrix_, MAT_SPD, PETSC_TRUE));
  add_near_nullspace();
}

void CoarseSpace::add_near_nullspace() {
  const Numbering& coarse = nodes();
  std::vector<FramedPoint> points(static_cast<std::size_t>(coarse.owned));
  for (int node = 0; node < static_cast<int>(coarse.input.size()); ++node) {
    if (!coarse.is_owned(node)) continue;
    FramedPoint& point = points[coarse.global[node] - coarse.begin];
    if (kind_ == CoarseKind::linear) {
      point.x = part_.mesh.vertices_mm[node];
    } else {
      const auto [a, b] = part_.problem.edges.vertices[node];
      point.x = (part_.mesh.vertices_mm[a] + part_.mesh.vertices_mm[b]) / 2;
    }
    if (const Node* of = node_at(node)) point.frame = of->frame;
  }
  set_rigid_modes(held_matrix_, points);
}

bool CoarseSpace::set_laws(const std::vector<PointLaw>& laws) {
  for (Node& node : boundary_nodes_) node.held = node.prescribed;
  const ContactPoints& contact = part_.contact;
  for (int p = 0; p < contact.count; p += 2)
    visit_slots(contact.boundary[p],
                {laws[p].closed, laws[p].sticks, laws[p + 1].closed, laws[p + 1].sticks},
                [&](int at, const Direction& direction) {
                  Node& node = boundary_nodes_[at];
                  visit_components(node.frame, direction, [&](int k) { node.held[k] = true; });
                });
  held_.fine.clear();
  held_.coarse.clear();
  const Numbering &edges = part_.mesh.edges, &coarse = nodes();
  std::vector<int> first_point(part_.boundary.mesh.boundary.size(), -1);
  for (int p = 0; p < contact.count; p += 2) first_point[contact.boundary[p]] = p;
  for (std::size_t row = 0; row < part_.row_of_part.size(); ++row) {
    const int p = first_point[part_.row_of_part[row]];
    if (p < 0) continue;
    const PetscInt slot = 4 * (edges.global[part_.problem.edges.of_boundary[row]] - edges.begin);
    for (int end = 0; end < 2; ++end) {
      if (laws[p + end].closed) held_.fine.push_back(slot + 2 * end);
      if (laws[p + end].sticks) held_.fine.push_back(slot + 2 * end + 1);
    }
  }
  std::vector<PetscInt> rows;
  for (int node = 0; node < static_cast<int>(coarse.input.size()); ++node) {
    if (boundary_node_of_[node] < 0 || !coarse.is_owned(node)) continue;
    for (int k = 0; k < 2; ++k)
      if (node_at(node)->held[k]) {
        rows.push_back(2 * coarse.global[node] + k);
        held_.coarse.push_back(rows.back() - 2 * coarse.begin);
      }
  }
  // The matrix may hold a few nodes too many or too few: that costs an iteration, it anew several.
  std::size_t changes = 0;
  for (std::size_t k = 0; k < boundary_nodes_.size(); ++k)
    for (int i = 0; i < 2; ++i) changes += boundary_nodes_[k].held[i] != held_by_matrix_[k][i];
  const auto few = static_cast<std::size_t>(share_of_changes_ * part_.contact.size());
  if (matrix_is_held_ && changes <= few) return false;
  matrix_is_held_ = true;
  for (std::size_t k = 0; k < boundary_nodes_.size(); ++k)
    held_by_matrix_[k] = boundary_nodes_[k].held;
  check(MatCopy(matrix_, held_matrix_, SAME_NONZERO_PATTERN));
  OwnedVec diagonal;
  check(MatCreateVecs(matrix_, nullptr, diagonal.put()));
  check(MatGetDiagonal(matrix_, diagonal));
  check(MatZeroRowsColumns(held_matrix_, static_cast<PetscInt>(rows.size()), rows.data(), 1,
                           nullptr, nullptr));
  // A prescribed node on its own has no stiffness left.
  const PetscScalar* own = nullptr;
  PetscScalar scale = 0;
  check(VecMax(diagonal, nullptr, &scale));
  check(VecGetArrayRead(diagonal, &own));
  for (const PetscInt row : rows) {
    const PetscScalar value = own[row - 2 * coarse.begin];
    check(MatSetValue(held_matrix_, row, row, value > 0 ? value : scale, INSERT_VALUES));
  }
  check(VecRestoreArrayRead(diagonal, &own));
  check(MatAssemblyBegin(held_matrix_, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(held_matrix_, MAT_FINAL_ASSEMBLY));
  return true;
}

}  // namespace airybench
