#include "assembly/rough_compliance.hpp"

namespace airybench {

Eigen::VectorXd rough_compliance(const Problem& problem, const ContactPoints& contact) {
  std::vector<double> of_edge(static_cast<std::size_t>(problem.edges.count()));
  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t)
    for (const int edge : problem.edges.of_triangle[t])
      of_edge[edge] = problem.compliance_of(t)(0, 0);
  Eigen::VectorXd compliance(contact.size());
  const int m = contact.components;
  for (int p = 0; p < contact.count; ++p)
    for (int k = 0; k < m; ++k)
      compliance(m * p + k) =
          (k == 0 ? 5 : 15) * of_edge[problem.edges.of_boundary[contact.boundary[p]]];
  return compliance;
}

}  // namespace airybench
