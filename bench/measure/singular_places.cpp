#include "bench/measure/singular_places.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "verify/verifier.hpp"

namespace airybench {
namespace {

constexpr double one_degree = std::numbers::pi / 180;

class Wedges {
 public:
  Wedges(const ContactSystem& system, int degree, const Eigen::VectorXd& F_C)
      : system_(system),
        problem_(*system.problem),
        mesh_(problem_.mesh),
        degree_(degree),
        states_(contact_states(system.contact, F_C)),
        first_point_(system.contact.first_points(mesh_.boundary.size())) {}

  // Between two rows of Mesh::boundary, as the body is walked.
  std::optional<std::string> what_is_singular(int before, int after) const {
    const Eigen::Vector2d in = direction(before, 1), out = direction(after, 0);
    const double inside = std::numbers::pi - turning_angle(in, out);
    if (inside > 359 * one_degree) return end_of(before, after);
    // Contact opens, sticks and slips within a face where stresses stay finite.
    if (is_contact(before) && is_contact(after) && label(before) == label(after) &&
        std::abs(inside - std::numbers::pi) < one_degree)
      return {};
    const Hold a = hold_at(before, true), b = hold_at(after, false);
    const auto [less, more] = std::minmax(a, b);
    if (a == b)
      return inside > 181 * one_degree ? std::optional<std::string>("a re-entrant corner")
                                       : std::nullopt;
    const double from = less == Hold::free && more == Hold::full ? 60 : 91;
    return inside > from * one_degree ? std::optional(end_of(before, after)) : std::nullopt;
  }

 private:
  // How a side is held: not at all, along its normal only, or as a whole.
  enum class Hold : std::uint8_t { free, normal, full };
  Hold hold_at(int row, bool at_end) const {
    switch (mesh_.boundary[row].role) {
      case BoundaryRole::force:
        return Hold::free;
      case BoundaryRole::displacement:
        return problem_.is_roller(row) ? Hold::normal : Hold::full;
      case BoundaryRole::contact:
        break;
    }
    const int p =
        first_point_[static_cast<std::size_t>(row)] + (at_end ? system_.contact.per_edge - 1 : 0);
    switch (states_[static_cast<std::size_t>(p)]) {
      case ContactState::open:
        return Hold::free;
      case ContactState::stick:
        return Hold::full;
      case ContactState::slip:
        break;
    }
    // Where a face slips with friction one of its ends is singular, as where it sticks.
    return problem_.friction_at(row) > 0 ? Hold::full : Hold::normal;
  }
  Eigen::Vector2d direction(int row, double s) const {
    const BoundaryEdge& edge = mesh_.boundary[row];
    return problem_.follows_curve(row, degree_) ? edge.curve.derivative(s)
                                                : Eigen::Vector2d(mesh_.vertices[edge.vertices[1]] -
                                                                  mesh_.vertices[edge.vertices[0]]);
  }
  std::string end_of(int before, int after) const {
    for (const int row : {before, after})
      if (is_contact(row)) return "the end of " + label(row);
    const bool is_first = mesh_.boundary[before].role == BoundaryRole::displacement;
    return "the end of " + label(is_first ? before : after);
  }
  std::string label(int row) const { return boundary_label(mesh_, mesh_.boundary[row]); }
  bool is_contact(int row) const { return mesh_.boundary[row].role == BoundaryRole::contact; }

  const ContactSystem& system_;
  const Problem& problem_;
  const Mesh& mesh_;
  int degree_;
  std::vector<ContactState> states_;
  std::vector<int> first_point_;  // per row of Mesh::boundary
};

}  // namespace

std::vector<SingularPlace> singular_places(const ContactSystem& system, int degree,
                                           const Eigen::VectorXd& F_C) {
  const Problem& problem = *system.problem;
  const Mesh& mesh = problem.mesh;
  const MeshPieces pieces = pieces_of(mesh);
  const auto count = static_cast<std::size_t>(pieces.count);
  std::vector<double> area(count, 0), perimeter(count, 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    area[pieces.of_vertex[mesh.triangles[t][0]]] += problem.area_mm2(static_cast<int>(t));
  std::map<int, int> before;  // rows that end in a vertex
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row) {
    const auto [start, end] = mesh.boundary[row].vertices;
    before[end] = row;
    perimeter[pieces.of_vertex[start]] += problem.frame_at(row, 0, 1).length_mm;
  }
  const Wedges wedges(system, degree, F_C);
  std::vector<SingularPlace> places;
  std::vector<int> piece_of;
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row) {
    const int vertex = mesh.boundary[row].vertices[0], piece = pieces.of_vertex[vertex];
    const auto what = wedges.what_is_singular(before.at(vertex), row);
    if (!what) continue;
    places.push_back({mesh.vertices[vertex], *what, area[piece] / perimeter[piece] / 10});
    piece_of.push_back(piece);
  }
  for (std::size_t k = 0; k < places.size(); ++k)
    for (std::size_t other = 0; other < places.size(); ++other)
      if (const double apart = (places[k].at_mm - places[other].at_mm).norm();
          apart > 0 && piece_of[k] == piece_of[other])
        places[k].within_mm = std::min(places[k].within_mm, apart / 20);
  return places;
}

}  // namespace airybench
