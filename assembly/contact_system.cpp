#include "assembly/contact_system.hpp"

#include "assembly/displacement_field.hpp"
#include "assembly/elements/edge_forces.hpp"
#include "assembly/free_bodies.hpp"

namespace airybench {
namespace {

// The points of an edge that faces another match its points in the other order.
void pair_points(const Problem& problem, ContactPoints& contact) {
  const std::vector<int> first = contact.first_points(problem.mesh.boundary.size());
  contact.opposite.assign(static_cast<std::size_t>(contact.count), ContactPoints::no_point);
  for (int p = 0; p < contact.count; ++p)
    if (const int row = problem.opposite_of(contact.boundary[p]); row != Problem::no_row)
      contact.opposite[p] = first[row] + contact.per_edge - 1 - p % contact.per_edge;
}

// The moments ū_j of a motion that is linear in x, columns, in x and y.
template <int k, typename Motion>
Eigen::Matrix2Xd moments_of_motion(const Problem& problem, int row, const Motion& at) {
  Eigen::Matrix2Xd moments(2, k + 1);
  if (problem.follows_curve(row, k))
    return CurvedSide<double>(problem.curve_of(row, k), k).moments_of(at);
  const auto [start, end] = problem.mesh.boundary[row].vertices;
  const std::array<Eigen::Vector2d, 2> ends = {at(problem.mesh.vertices[start]),
                                               at(problem.mesh.vertices[end])};
  for (int j = 0; j <= k; ++j) moments.col(j) = moment_of(k, j, ends);
  return moments;
}

template <int k>
void add_contact_points(const Problem& problem, int row, ContactPoints& contact,
                        std::vector<double>& gap) {
  for (int j = 0; j <= k; ++j) {
    contact.boundary.push_back(row);
    if (contact.components == 2) contact.friction.push_back(problem.friction_at(row));
  }
  if (!problem.has_gap()) return;
  const std::array<ContactOffset, k + 2> offset = offset_coefficients<k + 1>(problem, row);
  std::array<Eigen::Vector2d, k + 2> along;  // without motion
  for (int i = 0; i <= k + 1; ++i) along[i] = {offset[i].gap_mm, offset[i].slid_mm};
  const int start = problem.mesh.boundary[row].vertices[0];
  const Eigen::Matrix2Xd motion = moments_of_motion<k>(
      problem, row, [&](const Eigen::Vector2d& x) { return problem.motion_at(x, start); });
  for (int j = 0; j <= k; ++j) {
    const EdgeFrame frame = problem.frame_of_moment(row, k, j);
    const Eigen::Vector2d moment =
        moment_of(k, j, along) -
        Eigen::Vector2d(frame.normal.dot(motion.col(j)), frame.tangent.dot(motion.col(j)));
    gap.insert(gap.end(), moment.data(), moment.data() + contact.components);
  }
}

// The moment ū_j of a motion.
template <int k>
Eigen::Vector2d moment_in_frame(const Problem& problem, int row, int j, const RigidMotion& motion) {
  const Eigen::Vector2d moment = moments_of_motion<k>(problem, row, [&](const Eigen::Vector2d& x) {
                                   return motion.at(x);
                                 }).col(j);
  const EdgeFrame frame = problem.frame_of_moment(row, k, j);
  return {frame.normal.dot(moment), frame.tangent.dot(moment)};
}

}  // namespace

ContactPoints contact_points(const Problem& problem, int degree) {
  ContactPoints contact;
  contact.per_edge = degree + 1;
  contact.components = problem.has_friction() ? 2 : 1;
  std::vector<double> gap;
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row)
    if (problem.mesh.boundary[row].role == BoundaryRole::contact)
      with_degree(degree, [&](auto k) { add_contact_points<k>(problem, row, contact, gap); });
  contact.count = static_cast<int>(contact.boundary.size());
  if (!problem.opposite.empty()) pair_points(problem, contact);
  contact.gap = Eigen::Map<Eigen::VectorXd>(gap.data(), static_cast<Eigen::Index>(gap.size()));
  add_free_bodies(
      problem, degree,
      [&](const RigidMotion& motion, int p) {
        return with_degree(degree, [&](auto k) -> Eigen::Vector2d {
          return moment_in_frame<k>(problem, contact.boundary[p], p % contact.per_edge, motion);
        });
      },
      contact);
  contact.free.edge_reach = 1. / (degree + 2);  // of ∫ B_j
  return contact;
}

std::size_t ContactSystem::bytes() const {
  return static_cast<std::size_t>(contact.gap.size()) * sizeof(double) +
         contact.boundary.size() * sizeof(int);
}

void ContactSystem::set_load_case(std::shared_ptr<const Problem> load_case) {
  problem = std::move(load_case);
  contact = contact_points(*problem, degree);
}

ContactSystem contact_system(std::shared_ptr<const Problem> problem, int degree) {
  ContactSystem system;
  system.degree = degree;
  system.set_load_case(std::move(problem));
  return system;
}

}  // namespace airybench
