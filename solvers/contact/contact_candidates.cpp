#include "solvers/contact/contact_candidates.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "solvers/contact/coulomb_law.hpp"
#include "solvers/contact/free_body_contact.hpp"

namespace airybench {
namespace {

// Per point of at_rows(), the point of all.
std::vector<int> points_at(const ContactPoints& points, const std::vector<bool>& rows) {
  std::vector<int> kept;
  for (int p = 0; p < points.count; ++p)
    if (rows[static_cast<std::size_t>(points.boundary[p])]) kept.push_back(p);
  return kept;
}

Eigen::VectorXd rows_of(const Eigen::VectorXd& all, const std::vector<int>& points, int m) {
  Eigen::VectorXd rows(m * std::ssize(points));
  for (std::size_t k = 0; k < points.size(); ++k)
    rows.segment(m * static_cast<Eigen::Index>(k), m) = all.segment(m * points[k], m);
  return rows;
}

// The converse of rows_of().
void put_rows(const Eigen::VectorXd& rows, const std::vector<int>& points, int m,
              Eigen::VectorXd& all) {
  for (std::size_t k = 0; k < points.size(); ++k)
    all.segment(m * points[k], m) = rows.segment(m * static_cast<Eigen::Index>(k), m);
}

// Both edges of a pair are candidates, or none.
void add_opposite(const Problem& problem, std::vector<bool>& rows) {
  for (std::size_t row = 0; row < rows.size(); ++row)
    if (const int other = problem.opposite_of(static_cast<int>(row));
        rows[row] && other != Problem::no_row)
      rows[static_cast<std::size_t>(other)] = true;
}

// ū_C at every contact point.
Eigen::VectorXd contact_displacement(const ContactSystem& system, const EdgeDisplacements& u) {
  const Problem& problem = *system.problem;
  const ContactPoints& contact = system.contact;
  const int degree = system.degree, m = contact.components;
  Eigen::VectorXd of_points(contact.size());
  for (int p = 0; p < contact.count; ++p) {
    const int row = contact.boundary[p], j = p % contact.per_edge;
    const auto [a, b] = problem.mesh.boundary[row].vertices;
    const int from_low = a < b ? j : degree - j;
    const Eigen::Vector2d moment =
        u.moments.col(problem.edges.of_boundary[row]).segment<2>(2 * from_low);
    const EdgeFrame frame = problem.frame_of_moment(row, degree, j);
    of_points(m * p) = frame.normal.dot(moment);
    if (m == 2) of_points(m * p + 1) = frame.tangent.dot(moment);
  }
  return of_points;
}

class CandidateSolve {
 public:
  CandidateSolve(Solve solve, std::vector<bool> rows)
      : solve_(std::move(solve)), rows_(std::move(rows)) {}

  Solution operator()(const ContactSystem& system, const RunControl& control) {
    for (;;) {
      Solution solution = solve_at_rows(solve_, system, control);
      if (!has_answer(solution.status) || !add_touching(system, solution)) {
        if (solution.solve_again)
          solution.solve_again = on_same_rows(std::move(solution.solve_again));
        return solution;
      }
    }
  }

 private:
  Solution solve_at_rows(const Solve& solve, const ContactSystem& system,
                         const RunControl& control) const {
    const int m = system.contact.components;
    const std::vector<int> points = points_at(system.contact, rows_);
    ContactSystem part;
    part.problem = system.problem;
    part.degree = system.degree;
    part.contact = at_rows(system.contact, rows_);
    RunControl of_part = control;
    if (const Eigen::VectorXd& start = control.contact.start; start.size() > 0)
      of_part.contact.start = rows_of(start, points, m);
    Solution solution = run(solve, part, of_part);
    if (!has_answer(solution.status)) return solution;
    Eigen::VectorXd F = Eigen::VectorXd::Zero(system.contact.size());
    put_rows(solution.F_C, points, m, F);
    Eigen::VectorXd u =
        contact_displacement(system, std::get<EdgeDisplacements>(solution.unknowns));
    put_rows(solution.contact_displacement, points, m, u);  // the law's own digits
    solution.F_C = std::move(F);
    solution.contact_displacement = std::move(u);
    return solution;
  }

  // Makes candidates of the edges that overlap, and their neighbours. False: there are none.
  bool add_touching(const ContactSystem& system, const Solution& solution) {
    constexpr double rounding = 1e-12;
    const ContactPoints points = solution.free_motion_mm.size() > 0
                                     ? with_known_motion(system.contact, solution.free_motion_mm)
                                     : system.contact;
    const Eigen::VectorXd r = relative_to_gap(points, solution.contact_displacement);
    const double allowed = rounding * solution.contact_displacement.lpNorm<Eigen::Infinity>();
    const Mesh& mesh = system.problem->mesh;
    std::vector<bool> touches(mesh.vertices.size(), false);
    bool any = false;
    for (int p = 0; p < points.count; ++p)
      if (const int row = points.boundary[p]; !rows_[row] && r(points.components * p) > allowed) {
        any = true;
        for (const int v : mesh.boundary[row].vertices) touches[v] = true;
      }
    if (!any) return false;
    for (int p = 0; p < points.count; ++p)
      for (const int v : mesh.boundary[points.boundary[p]].vertices)
        if (touches[v]) rows_[points.boundary[p]] = true;
    add_opposite(*system.problem, rows_);
    return true;
  }

  // A later load case that touches elsewhere condenses the body again.
  Solve on_same_rows(Solve again) const {
    return [again = std::move(again), here = *this](const ContactSystem& system,
                                                    const RunControl& control) {
      Solution later = here.solve_at_rows(again, system, control);
      CandidateSolve wider = here;
      if (!has_answer(later.status) || !wider.add_touching(system, later)) return later;
      RunControl keeping = control;
      keeping.keep_body = true;
      return wider(system, keeping);
    };
  }

  Solve solve_;
  std::vector<bool> rows_;
};

}  // namespace

ContactPoints at_rows(const ContactPoints& points, const std::vector<bool>& rows) {
  const std::vector<int> kept = points_at(points, rows);
  const int m = points.components;
  ContactPoints result;
  result.count = static_cast<int>(kept.size());
  result.per_edge = points.per_edge;
  result.components = m;
  result.free = points.free;
  std::vector<int> number(static_cast<std::size_t>(points.count), ContactPoints::no_point);
  for (std::size_t k = 0; k < kept.size(); ++k) number[kept[k]] = static_cast<int>(k);
  for (const int p : kept) {
    if (!points.friction.empty()) result.friction.push_back(points.friction_at(p));
    result.boundary.push_back(points.boundary[p]);
    if (points.opposite.empty()) continue;
    const int q = points.opposite_of(p);
    result.opposite.push_back(q == ContactPoints::no_point ? q : number[q]);
  }
  if (points.gap.size() > 0) result.gap = rows_of(points.gap, kept, m);
  result.free.motions.resize(result.size(), points.free.motions.cols());
  for (Eigen::Index k = 0; k < points.free.motions.cols(); ++k)
    result.free.motions.col(k) = rows_of(points.free.motions.col(k), kept, m);
  return result;
}

Solve on_candidates(Solve solve, const Problem& problem, std::vector<bool> rows) {
  constexpr double nearly_all = 0.8;
  add_opposite(problem, rows);
  std::size_t contact = 0, candidates = 0;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (problem.mesh.boundary[row].role != BoundaryRole::contact) continue;
    ++contact;
    candidates += rows[row] ? 1 : 0;
  }
  if (candidates == 0 ||
      static_cast<double>(candidates) > nearly_all * static_cast<double>(contact))
    return solve;
  return CandidateSolve(std::move(solve), std::move(rows));
}

void ClosedEdges::add(const ContactSystem& system, const Solution& answer) {
  const ContactPoints& contact = system.contact;
  const Mesh& mesh = system.problem->mesh;
  for (int p = 0; p < contact.count; p += contact.per_edge) {
    bool is_closed = false;
    for (int j = 0; j < contact.per_edge; ++j)
      is_closed |= answer.F_C(contact.components * (p + j)) < 0;
    if (!is_closed) continue;
    const BoundaryEdge& edge = mesh.boundary[static_cast<std::size_t>(contact.boundary[p])];
    closed_.push_back({boundary_label(mesh, edge), mesh.vertices[edge.vertices[0]],
                       mesh.vertices[edge.vertices[1]]});
  }
}

std::vector<bool> ClosedEdges::candidates(const Mesh& finer) const {
  constexpr double lengths = 2;
  const auto is_near = [](const Closed& closed, const Eigen::Vector2d& x) {
    const Eigen::Vector2d along = closed.to - closed.from;
    const double t = std::clamp((x - closed.from).dot(along) / along.squaredNorm(), 0., 1.);
    return (closed.from + t * along - x).norm() <= lengths * along.norm();
  };
  std::vector<bool> rows(finer.boundary.size(), false);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const BoundaryEdge& edge = finer.boundary[row];
    if (edge.role != BoundaryRole::contact) continue;
    const std::string label = boundary_label(finer, edge);
    const Eigen::Vector2d middle =
        (finer.vertices[edge.vertices[0]] + finer.vertices[edge.vertices[1]]) / 2;
    rows[row] = std::ranges::any_of(closed_, [&](const Closed& closed) {
      return closed.label == label && is_near(closed, middle);
    });
  }
  return rows;
}

}  // namespace airybench
