#include "verify/pressure_peak.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "assembly/problem/face_matching.hpp"
#include "mesh/boundary_sides.hpp"
#include "verify/along_contact.hpp"
#include "verify/verifier.hpp"

namespace airybench {
namespace {

constexpr double right_angle = std::numbers::pi / 2;
constexpr double straight = 1e-3;  // angles and parts below are none

// A chain of contact edges with the pressure along it.
class Face {
 public:
  struct Edge {
    int row;
    double start, length;
    AlongEdge pressure;
  };

  // Its highest pressure is that of the edges asked for.
  Face(const ContactSystem& system, const Eigen::VectorXd& F_C, const std::vector<int>& rows,
       const std::vector<int>& first_point, const std::vector<bool>& asked) {
    const Mesh& mesh = system.problem->mesh;
    const int m = system.contact.components, n = system.contact.per_edge;
    is_closed_ = mesh.boundary[rows.front()].vertices[0] == mesh.boundary[rows.back()].vertices[1];
    for (const int row : rows) {
      const double length = system.problem->frame_at(row, 0, 1).length_mm;
      AlongEdge normal_forces(n);
      for (int j = 0; j < n; ++j) normal_forces(j) = F_C(m * (first_point[row] + j));
      edges_.push_back({row, length_, length, pressure_along(*system.problem, row, normal_forces)});
      length_ += length;
      if (!asked[row]) continue;
      if (const LargestValue largest = largest_value(edges_.back().pressure, {highest_});
          largest.value > highest_) {
        highest_ = largest.value;
        peak_ = edges_.back().start + largest.s * length;
      }
    }
  }

  const std::vector<Edge>& edges() const { return edges_; }
  bool is_closed() const { return is_closed_; }
  double highest_MPa() const { return highest_; }
  double peak_mm() const { return peak_; }

  // Along the face.
  double distance_mm(double a, double b) const {
    const double apart = std::abs(a - b);
    return is_closed_ ? std::min(apart, length_ - apart) : apart;
  }

  double mean_within(double place, double reach) const {
    double sum = 0, width = 0;
    for (const int turn : {-1, 0, 1}) {
      if (turn != 0 && !is_closed_) continue;
      const double from = place - reach - turn * length_, to = place + reach - turn * length_;
      for (const Edge& e : edges_) {
        const double a = std::max(from, e.start), b = std::min(to, e.start + e.length);
        if (!(a < b)) continue;
        const Eigen::Index n = e.pressure.size();
        Eigen::RowVectorXd integral = Eigen::RowVectorXd::Zero(n + 1);
        for (Eigen::Index i = 0; i < n; ++i)
          integral(i + 1) = integral(i) + e.pressure(i) / static_cast<double>(n);
        sum += e.length * (bernstein_value(integral, (b - e.start) / e.length) -
                           bernstein_value(integral, (a - e.start) / e.length));
        width += b - a;
      }
    }
    return sum / width;
  }

  // Of the window around a place that is in contact: the shortest reach to an open edge.
  double closed_reach(double place, double open_MPa) const {
    double reach = length_;
    for (const Edge& e : edges_)
      if (e.pressure.maxCoeff() <= open_MPa)
        reach =
            std::min({reach, distance_mm(place, e.start), distance_mm(place, e.start + e.length)});
    return reach;
  }

 private:
  std::vector<Edge> edges_;
  bool is_closed_ = false;
  double length_ = 0, peak_ = 0, highest_ = 0;
};

// A place where the exact pressure may be infinite; edge_mm: of an edge there.
struct Place {
  double at_mm, edge_mm;
};

class Places {
 public:
  Places(const ContactSystem& system, const Eigen::VectorXd& F_C, const std::vector<bool>& asked)
      : system_(system),
        asked_(asked),
        problem_(*system.problem),
        states_(contact_states(system.contact, F_C)),
        first_point_(system.contact.first_points(problem_.mesh.boundary.size())),
        before_(problem_.mesh.vertices.size(), Problem::no_row),
        after_(before_),
        side_(boundary_sides(problem_.edges)) {
    const Mesh& mesh = problem_.mesh;
    for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row)
      before_[mesh.boundary[row].vertices[1]] = after_[mesh.boundary[row].vertices[0]] = row;
  }

  const std::vector<int>& first_point() const { return first_point_; }

  // Those in contact, with more pressure than this, of the edges asked for.
  std::vector<Place> on(const Face& face, double open_MPa) const {
    const std::vector<Face::Edge>& edges = face.edges();
    const auto starting = [](const Face::Edge& e) { return e.pressure(0); };
    const auto ending = [](const Face::Edge& e) { return e.pressure(e.pressure.size() - 1); };
    std::vector<Place> places;
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const Face::Edge& e = edges[k];
      if (asked_[e.row] && e.pressure.maxCoeff() > open_MPa && is_uneven(e))
        places.push_back({e.start + e.length / 2, e.length});
      if (k == 0 && !face.is_closed()) continue;
      const Face::Edge& before = k == 0 ? edges.back() : edges[k - 1];
      const double at_vertex = std::max(starting(e), ending(before));
      if ((asked_[e.row] || asked_[before.row]) && at_vertex > open_MPa && !is_smooth(before, e))
        places.push_back({e.start, std::min(e.length, before.length)});
    }
    if (face.is_closed()) return places;
    const Face::Edge &first = edges.front(), &last = edges.back();
    if (asked_[first.row] && starting(first) > open_MPa && !is_regular_end(first.row, 0))
      places.push_back({0, first.length});
    if (asked_[last.row] && ending(last) > open_MPa && !is_regular_end(last.row, 1))
      places.push_back({last.start + last.length, last.length});
    return places;
  }

 private:
  int body_at(int row) const {
    return problem_.mesh.triangle_body[side_[static_cast<std::size_t>(row)].triangle];
  }
  const Eigen::Matrix3d& compliance_at(int row) const { return problem_.compliance[body_at(row)]; }
  // 1/E' of both bodies.
  double compliance(int row) const {
    const int other = problem_.opposite_of(row);
    return compliance_at(row)(0, 0) + (other == Problem::no_row ? 0 : compliance_at(other)(0, 0));
  }
  double gap_mm(int row, double s) const {
    const auto own = [&](int r, double at) {
      const auto [a, b] = problem_.mesh.boundary[r].vertices;
      const Eigen::Vector2d x =
          (1 - at) * problem_.mesh.vertices[a] + at * problem_.mesh.vertices[b];
      return problem_.loads.gap_mm ? problem_.loads.gap_mm(x, r) : 0;
    };
    const int other = problem_.opposite_of(row);
    return own(row, s) + (other == Problem::no_row ? 0 : own(other, 1 - s));
  }
  // What a gap's slope that jumps by κ adds to the pressure with each halving of the distance, if
  // it is not negligible.
  bool is_kink(double slope, int row, double pressure_MPa) const {
    const double growth_MPa = std::numbers::ln2 / (2 * std::numbers::pi) * slope / compliance(row);
    return growth_MPa > straight * pressure_MPa;
  }

  // A wall ends or has a kink inside the edge.
  bool is_uneven(const Face::Edge& e) const {
    const WallDetail detail = problem_.wall_detail_at(e.row);
    if (std::ranges::any_of(detail.unmet, [](double part) { return part != 0; })) return true;
    double largest_mm = 0;
    for (const double moment : detail.moments_mm)
      largest_mm = std::max(largest_mm, std::abs(moment));
    return is_kink(8 * largest_mm / e.length, e.row, e.pressure.maxCoeff());
  }

  // Of faces that are matched, whose normal at a vertex is that of both edges.
  bool is_corner(int before, int after) const {
    if (problem_.matching.has_curves) return false;  // which edges may stand for
    const auto normal = [&](int row, double s) {
      const BoundaryEdge& edge = problem_.mesh.boundary[row];
      return edge.curve.is_straight() ? own_frame(row).normal : edge.curve.normal(s);
    };
    return normal(before, 1).dot(normal(after, 0)) < min_cosine_of_face;
  }
  EdgeFrame own_frame(int row) const {
    const auto [a, b] = problem_.mesh.boundary[row].vertices;
    return edge_frame(problem_.mesh.vertices[a], problem_.mesh.vertices[b]);
  }

  bool is_smooth(const Face::Edge& before, const Face::Edge& after) const {
    const int a = before.row, b = after.row;
    const auto is_alike = [&](int one, int other) {
      return problem_.friction_at(one) == problem_.friction_at(other) &&
             problem_.strain_alike(body_at(one), body_at(other));
    };
    const int beyond_a = problem_.opposite_of(a), beyond_b = problem_.opposite_of(b);
    if (!is_alike(a, b) || (beyond_a == Problem::no_row) != (beyond_b == Problem::no_row))
      return false;
    if (beyond_a != Problem::no_row && !is_alike(beyond_a, beyond_b)) return false;
    if (beyond_a != Problem::no_row && (is_corner(a, b) || is_corner(beyond_b, beyond_a)))
      return false;
    if ((problem_.frame_at(a, 1, 1).normal - problem_.frame_at(b, 0, 1).normal).norm() > straight)
      return false;
    const double pressure = std::max(before.pressure.maxCoeff(), after.pressure.maxCoeff()),
                 step = std::abs(gap_mm(a, 1) - gap_mm(b, 0)),
                 slope_a = (gap_mm(a, 0) - 4 * gap_mm(a, 0.5) + 3 * gap_mm(a, 1)) / before.length,
                 slope_b = (-3 * gap_mm(b, 0) + 4 * gap_mm(b, 0.5) - gap_mm(b, 1)) / after.length;
    return !is_kink(slope_b - slope_a, a, pressure) &&
           !is_kink(step / std::min(before.length, after.length), a, pressure);
  }

  // end: 0 or 1, the start or the end of the edge.
  bool is_regular_end(int row, int end) const {
    const Mesh& mesh = problem_.mesh;
    const int v = mesh.boundary[row].vertices[end], side = end == 0 ? before_[v] : after_[v];
    const EdgeFrame face = problem_.frame_at(row, end, 1), other = own_frame(side);
    const bool slides = problem_.friction_at(row) == 0;
    if (mesh.boundary[side].role == BoundaryRole::displacement)
      return problem_.is_roller(side) && std::abs(face.normal.dot(other.normal)) <= straight &&
             (slides || sticks(row));
    const Eigen::Vector2d &in = end == 0 ? other.tangent : own_frame(row).tangent,
                          &out = end == 0 ? own_frame(row).tangent : other.tangent;
    return slides && std::numbers::pi - turning_angle(in, out) <= right_angle + straight;
  }
  bool sticks(int row) const {
    for (int i = 0; i < system_.contact.per_edge; ++i)
      if (states_[static_cast<std::size_t>(first_point_[row] + i)] != ContactState::stick)
        return false;
    return true;
  }

  const ContactSystem& system_;
  const std::vector<bool>& asked_;
  const Problem& problem_;
  std::vector<ContactState> states_;
  std::vector<int> first_point_, before_, after_;
  std::vector<TriangleSide> side_;
};

bool grows_towards(const Face& face, const Place& place, double open_MPa) {
  constexpr double least = 0.9, noise = 0.01;
  if (face.closed_reach(place.at_mm, open_MPa) < 8 * place.edge_mm) return false;
  std::array<double, 4> mean{};
  for (int k = 0; k < 4; ++k)
    mean[static_cast<std::size_t>(k)] = face.mean_within(place.at_mm, std::ldexp(place.edge_mm, k));
  const double last = mean[0] - mean[1], before = mean[1] - mean[2], first = mean[2] - mean[3];
  return last > noise * mean[0] && last >= least * before && before >= least * first && first > 0;
}

}  // namespace

PressurePeak pressure_peak(const ContactSystem& system, const Eigen::VectorXd& F_C,
                           const std::vector<bool>& asked) {
  const Places places(system, F_C, asked);
  std::vector<Face> faces;
  double highest = 0, highest_of_all = 0;
  for (const std::vector<int>& rows :
       boundary_chains(system.problem->mesh, BoundaryRole::contact)) {
    faces.emplace_back(system, F_C, rows, places.first_point(), asked);
    highest = std::max(highest, faces.back().highest_MPa());
    for (const Face::Edge& edge : faces.back().edges())
      highest_of_all = std::max(highest_of_all, edge.pressure.maxCoeff());
  }
  const double open = 1e-9 * highest_of_all;
  bool is_bounded = true;
  for (const Face& face : faces)
    for (const Place& place : places.on(face, open)) {
      is_bounded = false;
      if (face.highest_MPa() == highest &&
          face.distance_mm(place.at_mm, face.peak_mm()) <= place.edge_mm &&
          grows_towards(face, place, open))
        return PressurePeak::unbounded;
    }
  return is_bounded ? PressurePeak::bounded : PressurePeak::not_seen;
}

}  // namespace airybench
