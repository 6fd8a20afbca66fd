#include "assembly/problem/wall_gap.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>

#include "assembly/elements/bernstein.hpp"

namespace airybench {
namespace {

// Place on the edge whose ray to the wall passes through p.
std::optional<double> seen_from(const FacingEdge& edge, const Eigen::Vector2d& p) {
  const auto* round = std::get_if<CircularWall>(&edge.wall);
  const Eigen::Vector2d ray =
      round ? Eigen::Vector2d(p - round->centre_mm) : edge.direction_at(edge.a);
  const double slope = cross(edge.b - edge.a, ray);
  if (slope == 0) return {};
  return cross(p - edge.a, ray) / slope;
}

// Places where g0 may kink or jump: corners, and where parallel rays touch a circle.
void add_kinks(const FacingEdge& edge, const Wall& curve, std::vector<double>& places) {
  const auto add = [&](const Eigen::Vector2d& p) {
    if (const std::optional<double> s = seen_from(edge, p); s && *s > 0 && *s < 1)
      places.push_back(*s);
  };
  if (const auto* line = std::get_if<PolylineWall>(&curve))
    for (const Eigen::Vector2d& p : line->points_mm) add(p);
  if (const auto* round = std::get_if<CircularWall>(&curve)) {
    const Eigen::Vector2d n = edge.direction_at(edge.a), aside(-n.y(), n.x());
    add(round->centre_mm + round->radius_mm * aside);
    add(round->centre_mm - round->radius_mm * aside);
  }
}

// Size of the curve's coordinates, mm; bounds the rounding of distances.
double size_of(const Wall& curve) {
  if (const auto* flat = std::get_if<FlatWall>(&curve)) return flat->point_mm.norm();
  if (const auto* round = std::get_if<CircularWall>(&curve))
    return round->centre_mm.norm() + round->radius_mm;
  double size = 0;
  for (const Eigen::Vector2d& p : std::get<PolylineWall>(curve).points_mm)
    size = std::max(size, p.norm());
  return size;
}

bool is_round(const Wall& curve) { return std::holds_alternative<CircularWall>(curve); }

// Halves a part until one quadratic is g0 on it. Samples lie inside, as g0 may jump at the ends.
class Pieces {
 public:
  explicit Pieces(const FacingEdge& edge)
      : edge_(edge),
        length_mm_((edge.b - edge.a).norm()),
        size_mm_(std::max({edge.a.norm(), edge.b.norm(), size_of(edge.wall),
                           edge.face ? size_of(*edge.face) : 0})),
        curved_(is_round(edge.wall) || (edge.face && is_round(*edge.face))) {}

  void add(double start, double end, int depth = 0) {
    constexpr int most = 20;
    constexpr std::array<double, 5> places = {1. / 8, 1. / 4, 1. / 2, 3. / 4, 7. / 8};
    std::array<double, 5> g{};
    int met = 0;
    for (std::size_t k = 0; k < places.size(); ++k)
      if (const auto gap = edge_.gap_mm(start + places[k] * (end - start))) {
        g[k] = *gap;
        ++met;
      }
    GapPiece piece{start, end, met == 5, {0, 0, 0}, 0};
    bool done = met == 0;
    if (piece.is_met) {
      // v = (u − 1/2) / (3/8) for u from 0 to 1: −1, 0, 1 at the samples that define q.
      const double slope = (g[4] - g[0]) / 2, bend = (g[0] - 2 * g[2] + g[4]) / 2;
      const auto q = [&](double u) {
        const double v = (u - 0.5) / 0.375;
        return g[2] + slope * v + bend * v * v;
      };
      piece.gap_mm = {q(0), 2 * g[2] - (q(0) + q(1)) / 2, q(1)};
      // The third-order term is 2.8 times as large at the ends.
      constexpr double at_ends = 4;
      piece.off_mm =
          at_ends * std::max(std::abs(q(places[1]) - g[1]), std::abs(q(places[3]) - g[3]));
      // Non-finite values end here, too: halving does not help.
      done = !(piece.off_mm > allowed_mm(g)) || !std::isfinite(piece.off_mm);
    }
    if (!done && piece.is_met && depth >= most) {  // a jump, where the neighbours end
      piece.gap_mm.fill(std::ranges::min(g));
      piece.off_mm = 0;
    }
    if (done || depth >= most) {
      pieces_.push_back(piece);
    } else {
      add(start, (start + end) / 2, depth + 1);
      add((start + end) / 2, end, depth + 1);
    }
  }
  std::vector<GapPiece> take() { return std::move(pieces_); }

 private:
  // Rounding; for curves a sufficient accuracy.
  double allowed_mm(const std::array<double, 5>& g) const {
    const double share = curved_ ? 1e-6 : 1e-9;
    return 1e-12 * size_mm_ + share * (length_mm_ + std::abs(g[2]));
  }

  const FacingEdge& edge_;
  double length_mm_, size_mm_;
  bool curved_;
  std::vector<GapPiece> pieces_;
};

// Bernstein coefficients over [start, end] of the quadratic with c over [0, 1].
std::array<double, 3> restricted(const std::array<double, 3>& c, double start, double end) {
  const auto polar = [&](double s, double t) {
    return (1 - s) * (1 - t) * c[0] + ((1 - s) * t + s * (1 - t)) * c[1] + s * t * c[2];
  };
  return {polar(start, start), polar(start, end), polar(end, end)};
}

double largest_of(const std::array<double, 3>& c) {
  const double bend = c[0] - 2 * c[1] + c[2];
  const double ends = std::max(c[0], c[2]), place = (c[0] - c[1]) / bend;
  if (!(bend < 0) || !(place > 0 && place < 1)) return ends;
  return c[0] + place * (c[1] - c[0]);  // c0 − (c1 − c0)²/bend
}

// WallDetail::lowered_mm. rise: max (q − g0).
std::array<double, 3> lowered(const std::vector<GapPiece>& pieces, const std::array<double, 3>& q,
                              double rise) {
  // A convex function below these control points is below g0 on every piece.
  std::vector<std::pair<double, double>> below;  // s, mm
  for (const GapPiece& piece : pieces)
    for (int k = 0; k < 3 && piece.is_met; ++k)
      below.emplace_back(piece.start + k * (piece.end - piece.start) / 2,
                         piece.gap_mm[k] - piece.off_mm);
  if (below.empty()) return {0, 0, 0};
  double least = below.front().second, first = least, last = below.back().second;
  for (const auto& [s, gap] : below) {
    least = std::min(least, gap);
    if (s == below.front().first) first = std::min(first, gap);
    if (s == below.back().first) last = std::min(last, gap);
  }
  // At most the mean, so that the quadratic is convex.
  double middle = (first + last) / 2;
  for (const auto& [s, gap] : below)
    if (s > 0 && s < 1)
      middle =
          std::min(middle, (gap - (1 - s) * (1 - s) * first - s * s * last) / (2 * s * (1 - s)));
  std::array<double, 3> best = {rise, rise, rise};
  const std::array<std::array<double, 3>, 2> others = {
      {{least, least, least}, {first, middle, last}}};
  for (const std::array<double, 3>& c : others) {
    const std::array<double, 3> down = {q[0] - c[0], q[1] - c[1], q[2] - c[2]};
    if (down[0] + down[1] + down[2] < best[0] + best[1] + best[2]) best = down;
  }
  return best;
}

}  // namespace

std::optional<double> FacingEdge::gap_mm(double s) const {
  constexpr double min_cosine = 0.05;
  const Eigen::Vector2d x = at(s), n = direction_at(x);
  if (!(n.dot(m) > min_cosine)) return {};  // faces away
  std::optional<double> t = distance_along(wall, x, n);
  if (t && face) *t -= distance_to_either_side(*face, x, n).value_or(0);
  return t;
}

std::vector<GapPiece> gap_pieces(const FacingEdge& edge) {
  constexpr double shortest = 1e-12;
  std::vector<double> places = {0, 1};
  add_kinks(edge, edge.wall, places);
  if (edge.face) add_kinks(edge, *edge.face, places);
  std::ranges::sort(places);
  Pieces pieces(edge);
  double start = 0;
  for (const double end : places)
    if (end - start > shortest) {
      pieces.add(start, end);
      start = end;
    }
  return pieces.take();
}

bool WallDetail::is_nothing(double rounding_mm) const {
  const auto is_small = [&](double value) { return std::abs(value) <= rounding_mm; };
  return std::ranges::all_of(lowered_mm, is_small) && std::ranges::all_of(moments_mm, is_small) &&
         std::ranges::all_of(unmet, [](double part) { return part == 0; });
}

WallDetail wall_detail(const std::vector<GapPiece>& pieces, const std::array<double, 3>& q) {
  constexpr int n = highest_stress_degree;
  using Points = boost::math::quadrature::gauss<double, n / 2 + 2>;  // exact for degree n + 2
  const std::array<double, 3> of_edge = edge_coefficients(q[0], q[1], q[2]);
  WallDetail detail;
  double rise = -std::numeric_limits<double>::infinity();
  for (const GapPiece& piece : pieces) {
    const double start = piece.start, length = piece.end - piece.start;
    const auto add = [&](auto value, WallDetail::Moments& moments) {
      for (int j = 0; j <= n; ++j)
        moments[j] +=
            (n + 1) * length *
            Points::integrate(
                [&](double u) {
                  const double s = start + u * length;
                  return binomial(n, j) * std::pow(s, j) * std::pow(1 - s, n - j) * value(u);
                },
                0., 1.);
    };
    if (!piece.is_met) {
      add([](double) { return 1.; }, detail.unmet);
      continue;
    }
    std::array<double, 3> above = restricted(of_edge, piece.start, piece.end);  // q − g0
    for (std::size_t k = 0; k < 3; ++k) above[k] -= piece.gap_mm[k];
    rise = std::max(rise, largest_of(above) + piece.off_mm);
    add(
        [&](double u) {
          return piece.off_mm -
                 ((1 - u) * (1 - u) * above[0] + 2 * u * (1 - u) * above[1] + u * u * above[2]);
        },
        detail.moments_mm);
  }
  detail.lowered_mm = lowered(pieces, of_edge, std::max(0.0, rise));
  return detail;
}

}  // namespace airybench
