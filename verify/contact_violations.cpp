#include "verify/contact_violations.hpp"

#include <algorithm>
#include <map>

#include "assembly/problem/load_scale.hpp"
#include "assembly/total_displacement.hpp"
#include "verify/along_contact.hpp"

namespace airybench {

double tangential_force(const ContactPoints& contact, const Eigen::VectorXd& F, int point) {
  const int m = contact.components;
  return F.segment(m * point + 1, m - 1).norm();
}

double not_transmitted(const ContactPoints& contact, const Eigen::VectorXd& F,
                       const Eigen::VectorXd& rounding) {
  const int m = contact.components;
  double largest = 0;
  for (int p = 0; p < contact.count; ++p)
    if (const int q = contact.opposite_of(p); q > p) {
      const double allowed = rounding.size() > 0 ? rounding(p) + rounding(q) : 0;
      largest = std::max(
          largest, (F.segment(m * p, m) - F.segment(m * q, m)).cwiseAbs().maxCoeff() - allowed);
    }
  return largest;
}

ForceViolations force_violations(const ContactPoints& contact, const Eigen::VectorXd& F) {
  ForceViolations result;
  const double largest = F.size() > 0 ? F.lpNorm<Eigen::Infinity>() : 0;
  if (largest == 0) return result;
  const int m = contact.components;
  for (int p = 0; p < contact.count; ++p) {
    const double F_n = F(m * p);
    result.tension = std::max(result.tension, F_n / largest);
    if (m > 1)
      result.friction_excess = std::max(
          result.friction_excess,
          (tangential_force(contact, F, p) - contact.friction_at(p) * std::max(0.0, -F_n)) /
              largest);
  }
  return result;
}

Penetration penetration(const Problem& problem, const DisplacementField& w) {
  Penetration result;
  with_degree(displacement_degree(problem, w) - 1, [&](auto k) {
    constexpr int p = k + 1;
    const CurvedTraces traces(problem, p);
    const DisplacementField d = traces.traces(w);
    std::map<int, ContactMotion<p>> motions;  // by row
    std::map<int, double> at_vertex;          // the least of its edges
    for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row) {
      if (problem.mesh.boundary[row].role != BoundaryRole::contact) continue;
      const auto& beyond = (motions[row] = contact_motion<p>(problem, traces, row, d)).beyond;
      for (int end = 0; end < 2; ++end) {
        const int vertex = problem.mesh.boundary[row].vertices[end];
        const auto [found, is_new] = at_vertex.try_emplace(vertex, beyond[end * p]);
        if (!is_new) found->second = std::min(found->second, beyond[end * p]);
      }
    }
    for (auto& [row, motion] : motions) {
      for (int end = 0; end < 2; ++end)
        motion.beyond[end * p] = at_vertex.at(problem.mesh.boundary[row].vertices[end]);
      for (int i = 0; i <= p; ++i)
        result.at_nodes_mm = std::max(result.at_nodes_mm,
                                      bernstein_value(motion.beyond, static_cast<double>(i) / p));
      const AlongEdge beyond = Eigen::Map<const Eigen::RowVectorXd>(motion.beyond.data(), p + 1);
      result.on_edges_mm = largest_value(beyond, {result.on_edges_mm}).value;
    }
  });
  const auto largest = [](const DisplacementField& u) { return u.colwise().norm().maxCoeff(); };
  result.share =
      relative_error(result.at_nodes_mm, largest(w), largest(with_rigid_motion(problem, w)));
  return result;
}

}  // namespace airybench
