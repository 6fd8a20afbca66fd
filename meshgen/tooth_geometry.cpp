#include "meshgen/tooth_geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "meshgen/apportion.hpp"

namespace airybench {
namespace {

void check(const ToothDimensions& d) {
  const auto positive = [](const char* name, double value) {
    if (!(std::isfinite(value) && value > 0))
      throw std::invalid_argument(
          fmt::format("{} is {} mm; a positive number is needed", name, value));
  };
  if (d.teeth < 1)
    throw std::invalid_argument(fmt::format("teeth is {}; at least 1 is needed", d.teeth));
  positive("root half height", d.root_half_height);
  positive("length", d.length);
  positive("tip half height", d.tip_half_height);
  if (d.teeth == 1) return;
  positive("pitch", d.pitch);
  positive("block depth", d.block_depth);
  if (d.pitch < 2 * d.root_half_height)
    throw std::invalid_argument(
        fmt::format("pitch is {} mm; the roots need at least {} (twice the root half height)",
                    d.pitch, 2 * d.root_half_height));
  if (d.pitch <= 2 * d.tip_half_height)
    throw std::invalid_argument(
        fmt::format("pitch is {} mm; the tips need more than {} (twice the tip half height)",
                    d.pitch, 2 * d.tip_half_height));
}

// ∫ds/h along a segment.
double edges_wanted(const BoundarySegment& segment, const SizeField& h) {
  const double h0 = h.at(segment.start.x()), h1 = h.at(segment.end.x());
  // ∫₀¹ dt / (h0^(1−t) h1^t) = (1/h1 − 1/h0) / ln(h0/h1)
  const double slope = std::log(h0 / h1);
  const double mean = std::abs(slope) < 1e-9 ? 1 / h0 : (1 / h1 - 1 / h0) / slope;
  return segment.length() * mean;
}

// The fraction of a segment's length at which the fraction `part` of its ∫ds/h is reached.
double position_of_part(const BoundarySegment& segment, const SizeField& h, double part) {
  const double h0 = h.at(segment.start.x()), h1 = h.at(segment.end.x());
  const double slope = std::log(h0 / h1);
  if (std::abs(slope) < 1e-9) return part;
  return std::log1p(part * std::expm1(slope)) / slope;
}

std::vector<int> edges_per_segment(const std::vector<BoundarySegment>& segments, const SizeField& h,
                                   const EdgeCounts& edges) {
  std::vector<int> counts(segments.size());
  for (const auto& [role, total] : {std::pair(BoundaryRole::displacement, edges.displacement),
                                    std::pair(BoundaryRole::force, edges.force),
                                    std::pair(BoundaryRole::contact, edges.contact)}) {
    std::vector<std::size_t> rows;
    std::vector<double> weights;
    for (std::size_t i = 0; i < segments.size(); ++i) {
      if (segments[i].role != role) continue;
      rows.push_back(i);
      weights.push_back(edges_wanted(segments[i], h));
    }
    if (total < static_cast<int>(rows.size()))
      throw std::invalid_argument(
          fmt::format("{} edges: {}; at least {} needed, one per straight piece",
                      boundary_role_names[static_cast<std::size_t>(role)], total, rows.size()));
    const std::vector<int> shares = apportion(weights, total);
    for (std::size_t k = 0; k < rows.size(); ++k) counts[rows[k]] = shares[k];
  }
  return counts;
}

}  // namespace

double SizeField::at(double x, double exponent) const {
  const double xi = std::clamp((x - x_d) / (x_c - x_d), 0.0, 1.0);
  return h_d * std::pow(h_c / h_d, std::pow(xi, exponent));
}

double rounded_coordinate(double value) {
  return std::round(value * 1e10) / 1e10 + 0.0;  // −0 + 0 = 0
}

std::vector<BoundarySegment> boundary_segments(const ToothDimensions& d) {
  check(d);
  const double r = d.root_half_height, t = d.tip_half_height, l = d.length;
  std::vector<BoundarySegment> segments;
  Eigen::Vector2d at(0, -r);
  const auto go_to = [&](double x, double y, BoundaryRole role) {
    const Eigen::Vector2d next(x, y);
    if ((next - at).norm() < 1e-9) return;  // a tip or a gap of no width
    segments.push_back({at, next, role});
    at = next;
  };
  const auto tooth = [&](double axis_y) {
    go_to(l, axis_y - t, BoundaryRole::force);
    go_to(l, axis_y + t, BoundaryRole::contact);
    go_to(0, axis_y + r, BoundaryRole::force);
  };
  if (d.teeth == 1) {
    tooth(0);
    go_to(0, -r, BoundaryRole::displacement);
    return segments;
  }
  const double height = d.teeth * d.pitch;
  at = {-d.block_depth, 0};
  go_to(0, 0, BoundaryRole::force);
  for (int k = 0; k < d.teeth; ++k) {
    const double axis_y = d.pitch / 2 + d.pitch * k;
    go_to(0, axis_y - r, BoundaryRole::force);
    tooth(axis_y);
  }
  go_to(0, height, BoundaryRole::force);
  go_to(-d.block_depth, height, BoundaryRole::force);
  go_to(-d.block_depth, 0, BoundaryRole::displacement);
  return segments;
}

SizeField size_field(const ToothDimensions& d, const EdgeCounts& edges) {
  check(d);
  if (edges.displacement < 1)
    throw std::invalid_argument(
        fmt::format("displacement edges: {}; at least 1 is needed", edges.displacement));
  if (edges.contact < d.teeth)
    throw std::invalid_argument(fmt::format("contact edges: {}; at least {} needed, one per tooth",
                                            edges.contact, d.teeth));
  const bool rack = d.teeth > 1;
  return {.x_d = rack ? -d.block_depth : 0,
          .x_c = d.length,
          .h_d = (rack ? d.teeth * d.pitch : 2 * d.root_half_height) / edges.displacement,
          .h_c = d.teeth * 2 * d.tip_half_height / edges.contact};
}

BoundaryPolygon boundary_polygon(const ToothDimensions& dimensions, const EdgeCounts& edges) {
  const SizeField h = size_field(dimensions, edges);
  const std::vector<BoundarySegment> segments = boundary_segments(dimensions);
  const std::vector<int> counts = edges_per_segment(segments, h, edges);
  BoundaryPolygon polygon;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const BoundarySegment& segment = segments[i];
    for (int k = 0; k < counts[i]; ++k) {
      const double t = position_of_part(segment, h, static_cast<double>(k) / counts[i]);
      const Eigen::Vector2d p = segment.start + t * (segment.end - segment.start);
      polygon.vertices.emplace_back(rounded_coordinate(p.x()), rounded_coordinate(p.y()));
      polygon.roles.push_back(segment.role);
    }
  }
  return polygon;
}

}  // namespace airybench
