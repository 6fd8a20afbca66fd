#include "peers/petsc/edge_system.hpp"

#include <algorithm>

#include "peers/petsc/square_matrix.hpp"
#include "solvers/condensation/contact_compliance.hpp"
#include "solvers/condensation/hybridized_templates.hpp"

namespace airybench {
namespace {

using namespace parallel;

OwnedVec sequential(Eigen::Index size) {
  OwnedVec vector;
  check(VecCreateSeq(PETSC_COMM_SELF, size, vector.put()));
  return vector;
}

OwnedScatter scatter_from(Vec from, const std::vector<PetscInt>& slots, Vec to) {
  OwnedScatter scatter;
  IS which = nullptr;
  check(ISCreateGeneral(PETSC_COMM_SELF, static_cast<PetscInt>(slots.size()), slots.data(),
                        PETSC_COPY_VALUES, &which));
  check(VecScatterCreate(from, which, to, nullptr, scatter.put()));
  check(ISDestroy(&which));
  return scatter;
}

Eigen::VectorXd scattered(VecScatter scatter, Vec from, Vec to) {
  check(VecScatterBegin(scatter, from, to, INSERT_VALUES, SCATTER_FORWARD));
  check(VecScatterEnd(scatter, from, to, INSERT_VALUES, SCATTER_FORWARD));
  PetscInt size = 0;
  check(VecGetLocalSize(to, &size));
  const PetscScalar* values = nullptr;
  check(VecGetArrayRead(to, &values));
  const Eigen::VectorXd result = Eigen::Map<const Eigen::VectorXd>(values, size);
  check(VecRestoreArrayRead(to, &values));
  return result;
}

// Every slot its own unknown, but for those that are prescribed.
EdgeUnknowns slots_as_unknowns(const Problem& problem) {
  EdgeUnknowns unknown(static_cast<std::size_t>(problem.edges.count()));
  for (std::size_t edge = 0; edge < unknown.size(); ++edge)
    for (int i = 0; i < 4; ++i) unknown[edge][i] = static_cast<int>(4 * edge) + i;
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row) {
    const EdgeCondition condition = problem.condition(row);
    for (int k = 0; k < 2; ++k)
      if (condition.component[k] == Known::displacement)
        for (const int i : {k, 2 + k})
          unknown[problem.edges.of_boundary[row]][i] = prescribed_unknown;
  }
  return unknown;
}

}  // namespace

EdgeSystem::EdgeSystem(const BodyPart& part, const Visit& visit) : part_(part) {
  const Problem& problem = part.problem;
  local_.unknown = slots_as_unknowns(problem);
  local_.displacement = prescribed_displacements(problem);
  local_.b = Eigen::VectorXd::Zero(4 * static_cast<Eigen::Index>(problem.edges.count()));
  create_matrix();
  check(MatCreateVecs(A_, b_.put(), nullptr));
  check(VecSet(b_, 0));
  prescribed_force_ = new_vector();
  find_contact();

  ContactCompliance near_contact(problem);
  Eigen::VectorXd of_prescribed = Eigen::VectorXd::Zero(local_.b.size());
  each_by_itself([&] {
    visit_stiffness<double>(problem, [&](int t, const HybridStiffness<double>& element) {
      ElementStiffness K = from_lower(element.lower);
      if (near_contact.asks_for(t)) near_contact.add(t, K);
      const std::array<int, 12> unknown = element_unknowns(problem, local_.unknown, t);
      const Eigen::Matrix<double, 12, 1> u0 = element_displacement(problem, local_, {}, t);
      const Eigen::Matrix<double, 12, 1> force = K * u0;
      prescribed_energy_ += u0.dot(force);
      for (int i = 0; i < 12; ++i) {
        if (unknown[i] != prescribed_unknown) {
          local_.b(unknown[i]) -= element.load[i];
          of_prescribed(unknown[i]) += force(i);
          continue;
        }
        const double diagonal = K(i, i);
        K.row(i).setZero();
        K.col(i).setZero();
        K(i, i) = diagonal;
      }
      visit(t, K);
      const std::array<PetscInt, 12> slots = slots_of(t);
      PetscInt block_size = 0;
      check(MatGetBlockSize(A_, &block_size));
      std::array<PetscInt, 12> blocks;
      const auto count = static_cast<PetscInt>(12 / block_size);
      for (PetscInt k = 0; k < count; ++k) blocks[k] = slots[k * block_size] / block_size;
      check(MatSetValuesBlocked(A_, count, blocks.data(), count, blocks.data(), K.data(),
                                ADD_VALUES));  // symmetric: rows or columns first
      if (const int of = contact_triangle_of_[t]; of >= 0) contact_triangles_[of].K = K;
    });
  });
  check(MatAssemblyBegin(A_, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(A_, MAT_FINAL_ASSEMBLY));
  contact_triangle_of_ = {};
  sum_compliance(near_contact.from_below());
  local_.b -= of_prescribed;
  add_tractions(problem, local_.unknown, local_.b);
  add_from_local(local_.b, b_);
  add_from_local(of_prescribed, prescribed_force_);
  prescribed_energy_ = sum(prescribed_energy_);
}

// of_part: of the part's rows of the boundary.
void EdgeSystem::sum_compliance(const Eigen::Matrix4Xd& of_part) {
  const auto rows = static_cast<Eigen::Index>(part_.boundary.mesh.boundary.size());
  Eigen::Matrix4Xd of_boundary = Eigen::Matrix4Xd::Zero(4, rows);
  for (std::size_t row = 0; row < part_.row_of_part.size(); ++row)
    of_boundary.col(part_.row_of_part[row]) = of_part.col(static_cast<Eigen::Index>(row));
  const Eigen::VectorXd summed = parallel::sum(of_boundary.reshaped());
  compliance_from_below_ =
      at_contact_points(summed.reshaped(4, rows), part_.boundary, part_.contact);
}

void EdgeSystem::create_matrix() {
  std::vector<Pair> pairs;
  for (const auto& [a, b, c] : part_.mesh.edges_of_triangle)
    pairs.insert(pairs.end(), {{a, b}, {b, c}, {c, a}});
  PetscInt block_size = 4;
  check(PetscOptionsGetInt(nullptr, nullptr, "-stiffness_block_size", &block_size, nullptr));
  if (block_size != 4 && block_size != 2 && block_size != 1)
    throw OptionError("-stiffness_block_size " + std::to_string(block_size) +
                      " (allowed: 1, 2, 4)");
  create_square_matrix(part_.mesh.edges, 4, pairs, MATBAIJ, static_cast<int>(block_size),
                       "stiffness_", A_);
  check(MatSetOption(A_, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  if (block_size == 2) set_rigid_modes(A_, points_of_slots());
}

// An affine displacement's moments are its values at an edge's third points.
std::vector<FramedPoint> EdgeSystem::points_of_slots() const {
  const Numbering& edges = part_.mesh.edges;
  const Problem& problem = part_.problem;
  std::vector<FramedPoint> points(static_cast<std::size_t>(2 * edges.owned));
  const auto set = [&](int edge, int a, int b, int row) {
    if (!edges.is_owned(edge)) return;
    for (int end = 0; end < 2; ++end) {
      FramedPoint& point = points[2 * (edges.global[edge] - edges.begin) + end];
      const auto &own = part_.mesh.vertices_mm[end == 0 ? a : b],
                 &other = part_.mesh.vertices_mm[end == 0 ? b : a];
      point.x = (2 * own + other) / 3;
      if (row < 0) continue;
      const EdgeFrame frame = problem.frame_of_moment(row, end);
      point.frame << frame.normal, frame.tangent;
    }
  };
  for (int edge = 0; edge < problem.edges.count(); ++edge)
    set(edge, problem.edges.vertices[edge][0], problem.edges.vertices[edge][1], -1);
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row)
    if (problem.condition(row).in_frame)
      set(problem.edges.of_boundary[row], problem.mesh.boundary[row].vertices[0],
          problem.mesh.boundary[row].vertices[1], row);
  return points;
}

OwnedVec EdgeSystem::new_vector() const {
  OwnedVec vector;
  check(VecDuplicate(b_, vector.put()));
  check(VecSet(vector, 0));
  return vector;
}

std::array<PetscInt, 12> EdgeSystem::slots_of(int triangle) const {
  std::array<PetscInt, 12> slots;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 4; ++i)
      slots[4 * k + i] = 4 * part_.mesh.edges.global[part_.mesh.edges_of_triangle[triangle][k]] + i;
  return slots;
}

void EdgeSystem::find_contact() {
  const Problem& problem = part_.problem;
  std::vector<int> first_point(part_.boundary.mesh.boundary.size(), -1);
  for (int p = 0; p < part_.contact.count; p += 2) first_point[part_.contact.boundary[p]] = p;
  std::vector<bool> on_contact(static_cast<std::size_t>(problem.edges.count()), false);
  for (std::size_t row = 0; row < part_.row_of_part.size(); ++row) {
    const int p = first_point[part_.row_of_part[row]];
    if (p < 0) continue;
    contact_edges_.push_back({problem.edges.of_boundary[row], p});
    on_contact[problem.edges.of_boundary[row]] = true;
  }
  contact_triangle_of_.assign(part_.mesh.triangles.size(), -1);
  std::vector<PetscInt> slots;
  for (int t = 0; t < static_cast<int>(part_.mesh.triangles.size()); ++t) {
    ContactTriangle of{t};
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 4; ++i)
        of.on_contact[4 * k + i] = on_contact[part_.mesh.edges_of_triangle[t][k]];
    if (std::ranges::find(of.on_contact, true) == of.on_contact.end()) continue;
    contact_triangle_of_[t] = static_cast<int>(contact_triangles_.size());
    contact_triangles_.push_back(of);
    const std::array<PetscInt, 12> own = slots_of(t);
    slots.insert(slots.end(), own.begin(), own.end());
  }
  contact_values_ = sequential(static_cast<Eigen::Index>(slots.size()));
  to_contact_triangles_ = scatter_from(b_, slots, contact_values_);
  slots.clear();
  for (const PetscInt edge : part_.mesh.edges.global)
    for (int i = 0; i < 4; ++i) slots.push_back(4 * edge + i);
  local_values_ = sequential(static_cast<Eigen::Index>(slots.size()));
  to_local_ = scatter_from(b_, slots, local_values_);
}

void EdgeSystem::put_into_A(const ContactTriangle& of) const {
  using Rows = Eigen::Matrix<double, 12, 12, Eigen::RowMajor>;
  Rows A = of.K;
  for (int i = 0; i < 12; ++i)
    if (of.held[i]) A.col(i).setZero();
  for (int i = 0; i < 12; ++i)
    if (of.ratio[i] != 0) A.row(i) -= of.ratio[i] * A.row(i - 1);
  for (int i = 0; i < 12; ++i)
    if (of.held[i]) {
      A.row(i).setZero();
      A(i, i) = of.K(i, i);
    }
  const std::array<PetscInt, 12> slots = slots_of(of.triangle);
  for (int k = 0; k < 12; k += 4)
    for (int l = 0; l < 12; l += 4) {
      if (!of.on_contact[k] && !of.on_contact[l]) continue;
      const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> block = A.block<4, 4>(k, l);
      check(MatSetValues(A_, 4, &slots[k], 4, &slots[l], block.data(), INSERT_VALUES));
    }
}

void EdgeSystem::set_laws(const std::vector<PointLaw>& laws) {
  laws_ = laws;
  slips_ = std::ranges::any_of(laws, [](const PointLaw& law) { return law.ratio != 0; });
  std::vector<const PointLaw*> at_start(static_cast<std::size_t>(part_.problem.edges.count()),
                                        nullptr);
  for (const ContactEdge& of : contact_edges_) at_start[of.edge] = &laws[of.first_point];
  for (ContactTriangle& of : contact_triangles_) {
    for (int k = 0; k < 3; ++k) {
      const PointLaw* start = at_start[part_.mesh.edges_of_triangle[of.triangle][k]];
      if (start == nullptr) continue;
      for (int end = 0; end < 2; ++end) {
        const int n = 4 * k + 2 * end;
        of.held[n] = start[end].closed;
        of.held[n + 1] = start[end].sticks;
        of.ratio[n + 1] = start[end].ratio;
      }
    }
    put_into_A(of);
  }
  check(MatAssemblyBegin(A_, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(A_, MAT_FINAL_ASSEMBLY));
}

Eigen::VectorXd EdgeSystem::at_contact_triangles(Vec x) const {
  return scattered(to_contact_triangles_, x, contact_values_);
}

void EdgeSystem::multiply(Vec x, Vec y) const {
  check(MatMult(A_, x, y));
  const Eigen::VectorXd near = at_contact_triangles(x);
  PetscScalar* values = nullptr;
  check(VecGetArray(y, &values));
  for (const ContactEdge& of : contact_edges_)  // they belong to the rank of their triangle
    std::fill_n(values + own_slot(of.edge), 4, 0.0);
  check(VecRestoreArray(y, &values));
  for (std::size_t k = 0; k < contact_triangles_.size(); ++k) {
    const ContactTriangle& of = contact_triangles_[k];
    const Eigen::Vector<double, 12> all = near.segment<12>(12 * static_cast<Eigen::Index>(k));
    Eigen::Vector<double, 12> held = all;
    for (int i = 0; i < 12; ++i)
      if (!of.held[i]) held(i) = 0;
    Eigen::Vector<double, 12> force = of.K * held;
    const Eigen::Vector<double, 12> of_all = of.K * all;
    for (int i = 0; i < 12; ++i)
      if (of.on_contact[i]) force(i) = of_all(i);
    check(VecSetValues(y, 12, slots_of(of.triangle).data(), force.data(), ADD_VALUES));
  }
  check(VecAssemblyBegin(y));
  check(VecAssemblyEnd(y));
}

void EdgeSystem::reduce(Vec r) const {
  PetscScalar* values = nullptr;
  check(VecGetArray(r, &values));
  for (const ContactEdge& of : contact_edges_) {
    PetscScalar* own = values + own_slot(of.edge);
    for (int end = 0; end < 2; ++end) {
      const PointLaw& law = laws_[of.first_point + end];
      own[2 * end + 1] -= law.ratio * own[2 * end];
      if (law.closed) own[2 * end] = 0;
      if (law.sticks) own[2 * end + 1] = 0;
    }
  }
  const EdgeUnknowns& unknown = local_.unknown;
  for (const int edge : part_.problem.edges.of_boundary)
    for (int i = 0; i < 4; ++i)
      if (unknown[edge][i] == prescribed_unknown) values[own_slot(edge) + i] = 0;
  check(VecRestoreArray(r, &values));
}

Eigen::VectorXd EdgeSystem::of_contact(Vec x) const {
  const int m = part_.contact.components;
  Eigen::VectorXd rows = Eigen::VectorXd::Zero(part_.contact.size());
  const PetscScalar* values = nullptr;
  check(VecGetArrayRead(x, &values));
  for (const ContactEdge& of : contact_edges_)
    for (int end = 0; end < 2; ++end)
      for (int k = 0; k < m; ++k)
        rows(m * (of.first_point + end) + k) = values[own_slot(of.edge) + 2 * end + k];
  check(VecRestoreArrayRead(x, &values));
  return sum(rows);
}

void EdgeSystem::set_at_contact(const Eigen::VectorXd& rows, const std::vector<bool>& which,
                                Vec x) const {
  const int m = part_.contact.components;
  PetscScalar* values = nullptr;
  check(VecGetArray(x, &values));
  for (const ContactEdge& of : contact_edges_)
    for (int end = 0; end < 2; ++end)
      for (int k = 0; k < m; ++k)
        if (const int row = m * (of.first_point + end) + k; which[row])
          values[own_slot(of.edge) + 2 * end + k] = rows(row);
  check(VecRestoreArray(x, &values));
}

double EdgeSystem::energy(Vec u, Vec K_times_u) const {
  PetscScalar own = 0, mixed = 0;
  check(VecDot(u, K_times_u, &own));
  check(VecDot(u, prescribed_force_, &mixed));
  return std::max(0.0, own + 2 * mixed + prescribed_energy_);
}

Eigen::VectorXd EdgeSystem::to_local(Vec x) const { return scattered(to_local_, x, local_values_); }

void EdgeSystem::add_from_local(const Eigen::VectorXd& local, Vec x) const {
  PetscScalar* values = nullptr;
  check(VecGetArray(local_values_, &values));
  Eigen::Map<Eigen::VectorXd>(values, local.size()) = local;
  check(VecRestoreArray(local_values_, &values));
  check(VecScatterBegin(to_local_, local_values_, x, ADD_VALUES, SCATTER_REVERSE));
  check(VecScatterEnd(to_local_, local_values_, x, ADD_VALUES, SCATTER_REVERSE));
}

}  // namespace airybench
