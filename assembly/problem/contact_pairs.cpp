#include "assembly/problem/contact_pairs.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "mesh/transform_error.hpp"
#include "support/lists.hpp"

namespace airybench {

void check_labels(const Mesh& mesh, const std::vector<ContactPair>& pairs) {
  std::set<std::string> groups, paired;
  for (const BoundaryEdge& edge : mesh.boundary)
    if (edge.role == BoundaryRole::contact) groups.insert(boundary_label(mesh, edge));
  const std::string valid = joined(groups);
  for (const ContactPair& pair : pairs)
    for (const std::vector<std::string>& labels : pair.between)
      for (const std::string& label : labels) {
        if (!groups.contains(label))
          refuse("contacts: between", label,
                 "is no contact group of the mesh " + mesh.name +
                     perhaps(label, {groups.begin(), groups.end()}) +
                     " (its contact groups: " + (valid.empty() ? "none" : valid) + ")");
        if (!paired.insert(label).second)
          refuse("contacts: between", label, "again (allowed: every group in one pair)");
      }
}

void free_unmet_edges(Mesh& mesh, const ContactPair& pair, const std::vector<bool>& is_met) {
  for (std::size_t row = 0; row < mesh.boundary.size(); ++row) {
    BoundaryEdge& edge = mesh.boundary[row];
    if (is_met[row] || !pair.has(boundary_label(mesh, edge))) continue;
    edge.role = BoundaryRole::force;
    edge.group = boundary_group(mesh, out_of_reach);
  }
}

std::string place_of(const ContactPair& pair) { return "contacts: " + names_of(pair); }

std::vector<std::array<int, 2>> facing_edges(const Mesh& mesh, const ContactPair& pair,
                                             const FaceMatching& matching) {
  const auto is_on = [&](std::size_t side, const BoundaryEdge& edge) {
    return std::ranges::count(pair.between[side], boundary_label(mesh, edge)) > 0;
  };
  const int rows = static_cast<int>(mesh.boundary.size());
  std::map<int, int> row_at;  // of the second face, per start
  for (int row = 0; row < rows; ++row)
    if (is_on(1, mesh.boundary[row])) row_at[mesh.boundary[row].vertices[0]] = row;
  std::vector<std::array<int, 2>> edges;
  for (int row = 0; row < rows; ++row) {
    if (!is_on(0, mesh.boundary[row])) continue;
    const auto [a, b] = mesh.boundary[row].vertices;
    const auto start = matching.twin.find(a), end = matching.twin.find(b);
    if (start == matching.twin.end() || end == matching.twin.end()) continue;
    const auto other = row_at.find(end->second);
    if (other != row_at.end() && mesh.boundary[other->second].vertices[1] == start->second)
      edges.push_back({row, other->second});
  }
  if (edges.empty())
    throw TransformError(place_of(pair) +
                         " do not face each other (allowed: groups whose outward normals point at "
                         "each other)");
  return edges;
}

}  // namespace airybench
