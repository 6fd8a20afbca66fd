#include "peers/petsc/edge_system.hpp"

#include <algorithm>

#include "peers/petsc/matrices.hpp"
#include "solvers/condensation/contact_compliance.hpp"
#include "solvers/condensation/hybridized_templates.hpp"

namespace airybench {
namespace {

using namespace parallel;
using ElementVector = Eigen::Matrix<double, 12, 1>;

// An affine displacement's moments are its values at an edge's third points.
std::vector<FramedPoint> points_of_slots(const BodyPart& part) {
  const Numbering& edges = part.mesh.edges;
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
      point.x = (2 * part.mesh.vertices_mm[ends[end]] + part.mesh.vertices_mm[ends[1 - end]]) / 3;
      if (row == no_frame) continue;
      const EdgeFrame frame = problem.frame_of_moment(row, end);
      point.frame << frame.normal, frame.tangent;
    }
  }
  return points;
}

}  // namespace

EdgeSystem::EdgeSystem(const BodyPart& part, const Visit& visit) : part_(part) {
  const Problem& problem = part.problem;
  const EdgeUnknowns& unknown = part.system.unknown;
  create_matrix();
  find_contact_triangles();
  ContactCompliance near_contact(problem);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(part.system.b.size()), of_prescribed = b;
  each_by_itself([&] {
    auto at_contact = contact_triangles_.begin();
    visit_stiffness<double>(problem, [&](int t, const HybridStiffness<double>& element) {
      ElementStiffness K = from_lower(element.lower);
      if (near_contact.asks_for(t)) near_contact.add(t, K);
      const std::array<int, 12> slots = element_unknowns(problem, unknown, t);
      const ElementVector u0 = element_displacement(problem, part.system, {}, t);
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
      visit(t, K);
      add_element(t, K);
      if (at_contact != contact_triangles_.end() && at_contact->triangle == t) {
        at_contact->K = at_contact->A = K;
        ++at_contact;
      }
    });
  });
  assemble(A_);
  compliance_from_below_ = at_contact_points(of_whole_boundary(part, near_contact.from_below()),
                                             part.boundary, part.contact);
  b -= of_prescribed;
  add_tractions(problem, unknown, b);
  b_ = from_local(b);
  prescribed_force_ = from_local(of_prescribed);
  prescribed_energy_ = sum(prescribed_energy_);
}

void EdgeSystem::create_matrix() {
  std::vector<Pair> pairs;
  for (const auto& [a, b, c] : part_.mesh.edges_of_triangle)
    pairs.insert(pairs.end(), {{a, b}, {b, c}, {c, a}});
  check(PetscOptionsGetInt(nullptr, nullptr, "-stiffness_block_size", &block_size_, nullptr));
  if (block_size_ != 4 && block_size_ != 2 && block_size_ != 1)
    throw std::runtime_error("-stiffness_block_size " + std::to_string(block_size_) +
                             " (allowed: 1, 2, 4)");
  A_ = square_matrix(part_.mesh.edges, 4, pairs, MATBAIJ, static_cast<int>(block_size_),
                     "stiffness_");
  if (block_size_ == 2) set_rigid_modes(A_, points_of_slots(part_));
}

void EdgeSystem::add_element(int triangle, const ElementStiffness& K_e) {
  const PetscInt per_edge = 4 / block_size_;
  std::array<PetscInt, 12> blocks;
  PetscInt count = 0;
  for (const int edge : part_.mesh.edges_of_triangle[triangle])
    for (PetscInt k = 0; k < per_edge; ++k)
      blocks[count++] = per_edge * part_.mesh.edges.global[edge] + k;
  check(MatSetValuesBlocked(A_, count, blocks.data(), count, blocks.data(), K_e.data(),
                            ADD_VALUES));  // symmetric: rows or columns first
}

void EdgeSystem::find_contact_triangles() {
  std::vector<int> first_point(part_.mesh.edges.input.size(), -1);
  for (const ContactEdge& of : part_.contact_edges) first_point[of.edge] = of.first_point;
  for (int t = 0; t < static_cast<int>(part_.mesh.triangles.size()); ++t) {
    const auto& [a, b, c] = part_.mesh.edges_of_triangle[t];
    const std::array<int, 3> points = {first_point[a], first_point[b], first_point[c]};
    if (std::ranges::max(points) >= 0)
      contact_triangles_.push_back({t, points, ElementStiffness::Zero(), ElementStiffness::Zero()});
  }
}

void EdgeSystem::set_laws(const std::vector<PointLaw>& laws) {
  laws_ = laws;
  for (ContactTriangle& of : contact_triangles_) {
    std::vector<int> held;
    of.A = of.K;
    for (int n = 0; n < 12; n += 2) {  // a point's normal slot
      if (of.first_point[n / 4] < 0) continue;
      const PointLaw& law = laws[of.first_point[n / 4] + n / 2 % 2];
      if (law.closed) held.push_back(n);
      if (law.sticks) held.push_back(n + 1);
    }
    for (const int i : held) of.A.col(i).setZero();
    for (int n = 0; n < 12; n += 2)
      if (of.first_point[n / 4] >= 0)
        of.A.row(n + 1) -= laws[of.first_point[n / 4] + n / 2 % 2].ratio * of.A.row(n);
    for (const int i : held) {
      of.A.row(i).setZero();
      of.A(i, i) = of.K(i, i);
    }
    const std::array<int, 3>& edges = part_.mesh.edges_of_triangle[of.triangle];
    const auto slots = [&](int k) {
      const PetscInt first = 4 * part_.mesh.edges.global[edges[k]];
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

void EdgeSystem::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  y.resize(x.size());
  check(MatMult(A_, as_vec(x), as_vec(y)));
  const Eigen::VectorXd local = to_local(x);
  Eigen::VectorXd rest = Eigen::VectorXd::Zero(local.size());
  for (const ContactTriangle& of : contact_triangles_) {
    const std::array<int, 3>& edges = part_.mesh.edges_of_triangle[of.triangle];
    ElementVector own;
    for (int k = 0; k < 3; ++k) own.segment<4>(4 * k) = local.segment<4>(4 * edges[k]);
    const ElementVector force = (of.K - of.A) * own;
    for (int k = 0; k < 3; ++k) rest.segment<4>(4 * edges[k]) += force.segment<4>(4 * k);
  }
  y += from_local(rest);
}

void EdgeSystem::reduce(Eigen::VectorXd& r) const {
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

Eigen::VectorXd EdgeSystem::of_contact(const Eigen::VectorXd& x) const {
  Eigen::VectorXd rows = Eigen::VectorXd::Zero(part_.contact.size());
  visit_contact([&](int row, PetscInt slot) { rows(row) = x(slot); });
  return sum(std::move(rows));
}

double EdgeSystem::energy(const Eigen::VectorXd& u, const Eigen::VectorXd& K_times_u) const {
  return sum(u.dot(K_times_u) + 2 * u.dot(prescribed_force_)) + prescribed_energy_;
}

Eigen::VectorXd EdgeSystem::to_local(const Eigen::VectorXd& x) const {
  Eigen::VectorXd local(4 * part_.mesh.edges.count());
  to_values(part_.mesh.edges.to_owned, FourNumbers().type, x.data(), local.data());
  return local;
}

Eigen::VectorXd EdgeSystem::from_local(const Eigen::VectorXd& local) const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(4 * part_.mesh.edges.owned);
  to_rows(part_.mesh.edges.to_owned, FourNumbers().type, local.data(), x.data(), MPI_SUM);
  return x;
}

}  // namespace airybench
