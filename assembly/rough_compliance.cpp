#include "assembly/rough_compliance.hpp"

namespace airybench {

Eigen::VectorXd compliance_at_boundary(const Problem& problem) {
  std::vector<double> of_edge(static_cast<std::size_t>(problem.edges.count()));
  for (int t = 0; t < static_cast<int>(problem.edges.of_triangle.size()); ++t)
    for (const int edge : problem.edges.of_triangle[t])
      of_edge[edge] = problem.compliance_of(t)(0, 0);
  Eigen::VectorXd at_boundary(static_cast<Eigen::Index>(problem.edges.of_boundary.size()));
  for (std::size_t row = 0; row < problem.edges.of_boundary.size(); ++row)
    at_boundary(static_cast<Eigen::Index>(row)) = of_edge[problem.edges.of_boundary[row]];
  return at_boundary;
}

Eigen::VectorXd rough_compliance(const Eigen::VectorXd& at_boundary, const ContactPoints& contact) {
  Eigen::VectorXd compliance(contact.size());
  const int m = contact.components;
  for (int p = 0; p < contact.count; ++p)
    for (int k = 0; k < m; ++k)
      compliance(m * p + k) = (k == 0 ? 5 : 15) * at_boundary(contact.boundary[p]);
  return compliance;
}

Eigen::VectorXd rough_compliance(const Problem& problem, const ContactPoints& contact) {
  return rough_compliance(compliance_at_boundary(problem), contact);
}

}  // namespace airybench
