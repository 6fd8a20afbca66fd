#include "mesh/mend.hpp"

#include <algorithm>
#include <iomanip>
#include <map>
#include <sstream>

#include "mesh/arcs.hpp"
#include "mesh/bisection.hpp"
#include "mesh/straight_sides.hpp"
#include "mesh/supposed_curves.hpp"

namespace airybench {
namespace {

// "force:hole (24 edges, chords off by up to 0.0086 mm), …".
class CurvedGroups {
 public:
  explicit CurvedGroups(const Mesh& mesh) : mesh_(mesh) {}
  void add(const BoundaryEdge& edge, double sagitta_mm) {
    auto& [edges, largest_mm] = groups_[boundary_label(mesh_, edge)];
    ++edges;
    largest_mm = std::max(largest_mm, sagitta_mm);
  }
  bool empty() const { return groups_.empty(); }
  std::string words() const {
    std::ostringstream text;
    text << std::setprecision(2);
    for (const auto& [label, group] : groups_)
      text << (text.tellp() > 0 ? ", " : "") << label << " (" << group.first
           << " edges, chords off by up to " << group.second << " mm)";
    return text.str();
  }

 private:
  const Mesh& mesh_;
  std::map<std::string, std::pair<int, double>> groups_;
};

}  // namespace

std::vector<std::string> mend(Mesh& mesh, double mm_per_unit) {
  std::vector<std::string> notes;
  if (const MovedVertices moved = straighten_sides(mesh, mm_per_unit); moved.count > 0)
    notes.push_back(moved.words());
  if (const int arcs = recognise_arcs(mesh, mm_per_unit); arcs > 0)
    notes.push_back("edges between vertices on circles, which are taken for arcs: " +
                    std::to_string(arcs));
  const std::size_t triangles = mesh.triangles.size();
  mesh = with_fitting_curves(std::move(mesh));
  if (const std::size_t more = mesh.triangles.size() - triangles; more > 0)
    notes.push_back("triangles too thin for their curved edge, which were cut: " +
                    std::to_string(more));
  CurvedGroups known(mesh), supposed(mesh);
  for (const BoundaryEdge& edge : mesh.boundary)
    if (!edge.curve.is_straight()) known.add(edge, edge.curve.sagitta());
  for (const SupposedCurve& curve : supposed_curves(mesh))
    supposed.add(mesh.boundary[curve.boundary_row], curve.sagitta_mm());
  if (!known.empty()) notes.push_back("curved sides, which refinement follows: " + known.words());
  if (!supposed.empty())
    notes.push_back(
        "sides that look like curves, but no circle passes through their vertices; they stay "
        "polygons, and the total error says what that costs: " +
        supposed.words());
  return notes;
}

}  // namespace airybench
