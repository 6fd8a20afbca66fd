#include "mesh/mend.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include "mesh/arcs.hpp"
#include "mesh/bisection.hpp"
#include "mesh/curved_groups.hpp"
#include "mesh/fault_places.hpp"
#include "mesh/straight_sides.hpp"
#include "mesh/supposed_curves.hpp"

namespace airybench {
namespace {

// A curved edge that does not fit its triangle, also after with_fitting_curves(): refinement would
// lose its curve.
struct Misfit {
  int boundary_row, across;  // the vertex that it passes
};
std::optional<Misfit> misfit(const Mesh& mesh) {
  const MeshEdges edges = number_edges(mesh);
  std::map<int, int> curved;  // rows by their edge
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row)
    if (!mesh.boundary[row].curve.is_straight()) curved.emplace(edges.of_boundary[row], row);
  for (std::size_t t = 0; !curved.empty() && t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto found = curved.find(edges.of_triangle[t][k]);
      const int across = mesh.triangles[t][(k + 2) % 3];
      if (found != curved.end() && !fits(mesh.boundary[found->second].curve, mesh.vertices[across]))
        return Misfit{found->second, across};
    }
  return {};
}

[[noreturn]] void refuse_curve(const Mesh& mesh, const Misfit& misfit) {
  const auto [a, b] = mesh.boundary[misfit.boundary_row].vertices;
  throw MeshError(mesh.name + ": boundary " + edge_text(mesh, a, b) +
                  ": its curve does not stay on its side of " + vertex_text(mesh, misfit.across) +
                  " (allowed: curves within their triangle, as on a finer mesh)");
}

// Finds arcs and cuts triangles that are too thin. Where an arc that was found, not given, does not
// fit, its group stays a polygon. Returns how many edges are arcs.
int follow_curves(Mesh& mesh, double mm_per_unit) {
  std::set<std::string> given, polygons;  // groups
  for (const BoundaryEdge& edge : mesh.boundary)
    if (!edge.curve.is_straight()) given.insert(boundary_label(mesh, edge));
  for (;;) {
    Mesh round = mesh;
    int arcs = recognise_arcs(round, mm_per_unit);
    for (std::size_t row = 0; row < mesh.boundary.size(); ++row)
      if (EdgeCurve& curve = round.boundary[row].curve;
          mesh.boundary[row].curve.is_straight() && !curve.is_straight() &&
          polygons.contains(boundary_label(mesh, mesh.boundary[row]))) {
        curve = {};
        --arcs;
      }
    round = with_fitting_curves(std::move(round));
    if (const std::optional<Misfit> found = misfit(round)) {
      const std::string label = boundary_label(round, round.boundary[found->boundary_row]);
      if (given.contains(label)) refuse_curve(round, *found);
      polygons.insert(label);
      continue;
    }
    // Vertices on curves may meet another part of the boundary.
    if (round.triangles.size() > mesh.triangles.size()) validate(round);
    mesh = std::move(round);
    return arcs;
  }
}

}  // namespace

std::vector<std::string> mend(Mesh& mesh, double mm_per_unit) {
  std::vector<std::string> notes;
  if (const MovedVertices moved = straighten_sides(mesh, mm_per_unit); moved.count > 0)
    notes.push_back(moved.words());
  const std::size_t triangles = mesh.triangles.size();
  if (const int arcs = follow_curves(mesh, mm_per_unit); arcs > 0)
    notes.push_back("edges between vertices on circles, which are taken for arcs: " +
                    std::to_string(arcs));
  if (const std::size_t more = mesh.triangles.size() - triangles; more > 0)
    notes.push_back("triangles too thin for their curved edge, which were cut: " +
                    std::to_string(more));
  CurvedGroups known, supposed;
  for (const BoundaryEdge& edge : mesh.boundary)
    if (!edge.curve.is_straight()) known.add(boundary_label(mesh, edge), edge.curve.sagitta());
  for (const SupposedCurve& curve : supposed_curves(mesh))
    supposed.add(boundary_label(mesh, mesh.boundary[curve.boundary_row]), curve.sagitta_mm());
  if (!known.empty()) notes.push_back("curved sides, which refinement follows: " + known.words());
  if (!supposed.empty())
    notes.push_back(
        "sides that look like curves, but no circle passes through their vertices; they stay "
        "polygons, and the total error says what that costs: " +
        supposed.words());
  return notes;
}

}  // namespace airybench
