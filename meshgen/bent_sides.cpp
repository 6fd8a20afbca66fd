#include "meshgen/bent_sides.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "mesh/coordinate_rounding.hpp"
#include "mesh/mesh.hpp"

namespace airybench {

CurveGeometry::CurveGeometry(int curve) : curve_(curve) {
  std::string type;
  gmsh::model::getType(1, curve, type);
  if (type == "Discrete curve") return;
  std::vector<double> low, high, xyz, parameters;
  std::vector<std::size_t> nodes;
  gmsh::model::getParametrizationBounds(1, curve, low, high);
  low_ = low.at(0);
  high_ = high.at(0);
  gmsh::model::getValue(1, curve, {low_, (low_ + high_) / 2, high_}, xyz);
  const Eigen::Vector3d start(xyz.data()), middle(&xyz[3]), end(&xyz[6]);
  constexpr double rounding = 1e-9;
  is_closed_ = (end - start).norm() < rounding * (middle - start).norm();
  gmsh::model::mesh::getNodes(nodes, xyz, parameters, 1, curve, /*includeBoundary=*/true);
  if (parameters.size() != nodes.size()) return;
  for (std::size_t k = 0; k < nodes.size(); ++k) parameter_.emplace(nodes[k], parameters[k]);
}

std::vector<Eigen::Vector3d> CurveGeometry::between(std::size_t node, std::size_t next) const {
  const auto from = parameter_.find(node), to = parameter_.find(next);
  if (from == parameter_.end() || to == parameter_.end()) return {};
  double start = from->second, end = to->second;
  // Where a closed curve begins it also ends; Gmsh tells one of the two parameters.
  const double half = (high_ - low_) / 2;
  for (double* seam : {&start, &end})
    if (is_closed_ && std::abs(end - start) > half && (*seam == low_ || *seam == high_))
      *seam = *seam == low_ ? high_ : low_;
  constexpr int parts = 2 * EdgeCurve::max_degree;
  std::vector<double> parameters, xyz;
  for (int k = 0; k <= parts; ++k) parameters.push_back(start + (end - start) * k / parts);
  gmsh::model::getValue(1, curve_, parameters, xyz);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t at = 0; at + 2 < xyz.size(); at += 3) points.emplace_back(&xyz[at]);
  return points;
}

// A triangle of degree p has 3 (p − 1) nodes in its sides and (p − 1)(p − 2)/2 in its middle, a
// quadrilateral 4 (p − 1) and (p − 1)², or none there.
void SideNodes::add_element(Span corners, Span others) {
  const std::size_t sides = corners.size();
  for (std::size_t of_side = 1; of_side * sides <= others.size(); ++of_side) {
    const std::size_t middle = sides == 3 ? of_side * (of_side - 1) / 2 : of_side * of_side,
                      left = others.size() - sides * of_side;
    if (left != middle && left != 0) continue;
    for (std::size_t k = 0; k < sides; ++k)
      add_side(corners[k], corners[(k + 1) % sides], others.subspan(k * of_side, of_side));
    return;
  }
}

void SideNodes::add_side(std::size_t from, std::size_t to, Span inside) {
  if (inside.empty() || inside.size() >= EdgeCurve::max_degree) return;
  std::vector<std::size_t>& nodes = inside_[{std::min(from, to), std::max(from, to)}];
  nodes.assign(inside.begin(), inside.end());
  if (from > to) std::ranges::reverse(nodes);
}

std::vector<std::size_t> SideNodes::between(std::size_t from, std::size_t to) const {
  const auto found = inside_.find({std::min(from, to), std::max(from, to)});
  if (found == inside_.end()) return {};
  std::vector<std::size_t> nodes = found->second;
  if (from > to) std::ranges::reverse(nodes);
  return nodes;
}

std::optional<EdgeCurve> curve_through(const std::vector<Eigen::Vector2d>& points_mm,
                                       double mm_per_unit) {
  constexpr double max_of_sagitta = 0.01;
  const std::size_t most = EdgeCurve::max_degree + 1, stride = points_mm.size() > most ? 2 : 1;
  std::vector<Eigen::Vector2d> points;
  for (std::size_t k = 0; k < points_mm.size(); k += stride) points.push_back(points_mm[k]);
  if (points.size() < 3) return EdgeCurve{};
  const EdgeCurve curve = EdgeCurve{points};
  if (curve.sagitta() <= rounding_of_points(points, mm_per_unit)) return EdgeCurve{};
  for (std::size_t k = 1; stride == 2 && k < points_mm.size(); k += 2) {
    const double t = static_cast<double>(k) / static_cast<double>(points_mm.size() - 1);
    if ((curve.at(t) - points_mm[k]).norm() > max_of_sagitta * curve.sagitta()) return {};
  }
  return curve;
}

}  // namespace airybench
