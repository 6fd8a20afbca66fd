#include "verify/contact_faces.hpp"

#include <map>
#include <utility>

#include "support/lists.hpp"

namespace airybench {

std::string face_name(const std::vector<std::string>& labels) {
  return joined(labels, " against ");
}

std::vector<ContactFace> contact_faces(const Problem& problem) {
  const Mesh& mesh = problem.mesh;
  const auto label = [&](int row) { return boundary_label(mesh, mesh.boundary[row]); };
  std::map<std::vector<std::string>, std::vector<int>> faces;
  for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row) {
    if (mesh.boundary[row].role != BoundaryRole::contact) continue;
    const int other = problem.opposite_of(row);
    if (other == Problem::no_row)
      faces[{label(row)}].push_back(row);
    else if (std::pair(label(row), row) < std::pair(label(other), other))
      faces[{label(row), label(other)}].push_back(row);
  }
  std::vector<ContactFace> list;
  for (auto& [labels, rows] : faces) list.push_back({labels, std::move(rows)});
  return list;
}

std::vector<bool> is_on_face(const Problem& problem, const ContactFace& face) {
  std::vector<bool> is_on(problem.mesh.boundary.size(), false);
  for (const int row : face.rows) {
    is_on[row] = true;
    if (const int other = problem.opposite_of(row); other != Problem::no_row) is_on[other] = true;
  }
  return is_on;
}

}  // namespace airybench
