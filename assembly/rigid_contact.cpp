#include "assembly/rigid_contact.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "assembly/displacement_field.hpp"
#include "assembly/nodal_forces.hpp"
#include "assembly/problem/load_scale.hpp"

namespace airybench {
namespace {

constexpr double parallel = 1e-8;
constexpr double alike = 1e-6;           // velocities, relatively
constexpr double load_rounding = 1e-11;  // of the force that loads could make
constexpr double input_rounding = 1e-7;

// l_m = ∫ b·N_m + ∫_{Γ_F} f·N_m, N.
Eigen::VectorXd loads_on_motions(const Problem& problem, int degree) {
  const auto count = static_cast<Eigen::Index>(problem.free.motions.size());
  Eigen::VectorXd loads(count);
  FreeMotions moved = problem.free;
  for (Eigen::Index m = 0; m < count; ++m) {
    moved.amounts_mm = Eigen::VectorXd::Unit(count, m);
    loads(m) = work_on_free_motion(problem, moved, degree);
  }
  return loads;
}

// An end of an edge, the contact law's frame there, and the piece.
struct EdgeEnd {
  Eigen::Vector2d at_mm;
  EdgeFrame frame;
  int piece;
  double gap_mm;
};

EdgeEnd edge_end(const Problem& problem, int row, int end) {
  const int vertex = problem.mesh.boundary[row].vertices[end];
  const Eigen::Vector2d& x = problem.mesh.vertices[vertex];
  const EdgeFrame frame = problem.frame_at(row, end, 1);
  return {x, frame, problem.free.piece_of_vertex[vertex],
          problem.offset_at(x, row).along(frame.normal).x()};
}

// Its row of N; none: it resists no motion.
struct EndRow {
  RigidContact::End end;
  Eigen::RowVectorXd normal, tangential;
};

std::optional<EndRow> end_row(const Problem& problem, int row, int end, int face) {
  const std::vector<FreeMotion>& motions = problem.free.motions;
  const int other = problem.opposite_of(row);
  std::vector<EdgeEnd> sides = {edge_end(problem, row, end)};
  if (other != Problem::no_row) sides.push_back(edge_end(problem, other, 1 - end));
  EndRow result{{sides[0].at_mm,
                 sides[0].frame.length_mm,
                 problem.friction_at(row),
                 0,
                 {RigidContact::held, RigidContact::held},
                 face},
                Eigen::RowVectorXd::Zero(std::ssize(motions)),
                Eigen::RowVectorXd::Zero(std::ssize(motions))};
  double gap_mm = 0;
  for (std::size_t side = 0; side < sides.size(); ++side) {
    gap_mm += sides[side].gap_mm;
    for (std::size_t m = 0; m < motions.size(); ++m) {
      if (motions[m].piece != sides[side].piece) continue;
      result.end.pieces[side] = motions[m].piece;
      const Eigen::Vector2d u = motions[m].of_one_mm.at(sides[side].at_mm);
      result.normal(static_cast<Eigen::Index>(m)) += sides[side].frame.normal.dot(u);
      result.tangential(static_cast<Eigen::Index>(m)) += sides[side].frame.tangent.dot(u);
    }
  }
  result.end.gap_mm = std::max(gap_mm, 0.);
  if (result.end.pieces == std::array{RigidContact::held, RigidContact::held} ||
      (sides.size() == 2 && sides[0].piece == sides[1].piece))  // a crack's faces
    return {};
  return result;
}

Eigen::Vector2d velocity_of(const RigidContact& contact, int piece, const Eigen::VectorXd& q,
                            const Eigen::Vector2d& x) {
  Eigen::Vector2d v = Eigen::Vector2d::Zero();
  for (Eigen::Index m = 0; m < q.size(); ++m)
    if (contact.motions[m].piece == piece) v += q(m) * contact.motions[m].of_one_mm.at(x);
  return v;
}

double turn_of(const RigidContact& contact, int piece, const Eigen::VectorXd& q) {
  double turn = 0;
  for (Eigen::Index m = 0; m < q.size(); ++m)
    if (contact.motions[m].piece == piece) turn += q(m) * contact.motions[m].of_one_mm.rotation;
  return turn;
}

std::string words(const Eigen::Vector2d& v, int digits) {
  const auto tidy = [](double c) { return std::abs(c) < 1e-6 ? 0 : c; };
  std::ostringstream text;
  text.precision(digits);
  text << "(" << tidy(v.x()) << ", " << tidy(v.y()) << ")";
  return text.str();
}

}  // namespace

double RigidContact::negligible_N() const {
  return std::max(rounding_N, 1e-9 * loads_N.lpNorm<Eigen::Infinity>());
}

Eigen::VectorXd RigidContact::masses() const {
  Eigen::VectorXd areas(std::ssize(motions));
  for (Eigen::Index m = 0; m < areas.size(); ++m) areas(m) = motions[m].area_mm2;
  return areas / areas.maxCoeff();
}

RigidContact rigid_contact(const Problem& problem, int degree) {
  constexpr double straight = 1e-6;
  RigidContact contact;
  contact.motions = problem.free.motions;
  for (const FreeMotion& motion : contact.motions)
    contact.bodies.push_back(
        name_of_piece(problem.mesh, problem.free.piece_of_vertex, motion.piece));
  contact.loads_N = loads_on_motions(problem, degree);
  const double force_N = load_scale(problem).force_N;
  contact.rounding_N = load_rounding * force_N;
  contact.rounding_on_points_N = input_rounding * force_N;
  contact.points = held_points(problem);
  std::vector<EndRow> rows;
  std::vector<char> seen(problem.mesh.boundary.size());  // edges, or the ones opposite
  int face = 0;
  for (const std::vector<int>& chain : boundary_chains(problem.mesh, BoundaryRole::contact)) {
    Eigen::Vector2d before = Eigen::Vector2d::Zero();
    for (const int row : chain) {
      const auto [a, b] = problem.mesh.boundary[row].vertices;
      const Eigen::Vector2d along =
          edge_frame(problem.mesh.vertices[a], problem.mesh.vertices[b]).tangent;
      if ((along - before).norm() > straight) ++face;
      before = along;
      if (seen[row]) continue;
      if (const int other = problem.opposite_of(row); other != Problem::no_row) seen[other] = 1;
      for (const int end : {0, 1})
        if (std::optional<EndRow> resisting = end_row(problem, row, end, face))
          rows.push_back(std::move(*resisting));
    }
  }
  contact.normal.resize(std::ssize(rows), std::ssize(contact.motions));
  contact.tangential.resizeLike(contact.normal);
  for (Eigen::Index e = 0; e < contact.normal.rows(); ++e) {
    contact.ends.push_back(rows[e].end);
    contact.normal.row(e) = rows[e].normal;
    contact.tangential.row(e) = rows[e].tangential;
  }
  return contact;
}

MotionSpaces motion_spaces(const RigidContact& contact) {
  const Eigen::Index ends = contact.normal.rows(), motions = contact.normal.cols();
  Eigen::MatrixXd resistance(2 * ends, motions);
  resistance.topRows(ends) = contact.normal;
  for (Eigen::Index e = 0; e < ends; ++e)
    resistance.row(ends + e) = (contact.ends[e].friction > 0 ? 1 : 0) * contact.tangential.row(e);
  const Eigen::MatrixXd scaled = contact.masses().cwiseSqrt().cwiseInverse().asDiagonal();
  if (ends == 0) return {scaled, Eigen::MatrixXd(motions, 0)};
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(resistance * scaled, Eigen::ComputeFullV);
  const double least = parallel * std::sqrt(static_cast<double>(ends));
  const auto resisted = (svd.singularValues().array() > least).count();
  if (resisted == motions) return {Eigen::MatrixXd(motions, 0), scaled};
  const Eigen::MatrixXd basis = scaled * svd.matrixV();
  return {basis.rightCols(motions - resisted), basis.leftCols(resisted)};
}

bool RigidGroup::turns() const { return std::abs(turn) * size_mm > alike * velocity.norm(); }

// v + ω J (x − c) = 0.
Eigen::Vector2d RigidGroup::pole() const {
  return centroid + Eigen::Vector2d(-velocity.y(), velocity.x()) / turn;
}

double RigidGroup::moment_about(const Eigen::Vector2d& x) const {
  const Eigen::Vector2d d = centroid - x;
  return moment_Nmm + d.x() * force_N.y() - d.y() * force_N.x();
}

std::string words_of_direction(const Eigen::Vector2d& v) {
  return "along " + words(v.normalized(), 3);
}

std::string words_of_place(const Eigen::Vector2d& x) { return words(x, 4); }

std::string words_of_open_motions(const RigidContact& contact) {
  Eigen::MatrixXd open = motion_spaces(contact).open;
  if (const auto held = std::ssize(contact.points.rows); held > 0 && open.cols() > 0) {
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(contact.points.of_motions * open,
                                                Eigen::ComputeFullV);
    open *= svd.matrixV().rightCols(std::max<Eigen::Index>(open.cols() - held, 0)).eval();
  }
  if (open.cols() == 0) return "";
  std::string named;
  for (Eigen::Index first = 0, count = 0; first < open.rows(); first += count) {
    const int piece = contact.motions[first].piece;
    count = std::ranges::count(contact.motions, piece, &FreeMotion::piece);
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(open.middleRows(first, count), Eigen::ComputeFullU);
    if (svd.singularValues()(0) <= alike) continue;
    named += named.empty() ? "no contact resists, and no load moves, " : ", ";
    named += contact.bodies[first];
    if (svd.singularValues().size() > 1 && svd.singularValues()(1) > alike) continue;
    Eigen::VectorXd q = Eigen::VectorXd::Zero(open.rows());
    q.segment(first, count) = svd.matrixU().col(0);
    RigidGroup own = fastest_group(contact, q, q);
    if (own.turns()) {
      named += " about " + words_of_place(own.pole());
    } else {
      const bool back = own.velocity.x() + 1e-3 * own.velocity.y() < 0;  // either sense would do
      named += " " + words_of_direction(back ? -own.velocity : own.velocity);
    }
  }
  return named;
}

RigidGroup fastest_group(const RigidContact& contact, const Eigen::VectorXd& q,
                         const Eigen::VectorXd& unbalanced_N) {
  std::map<int, double> unbalanced;
  for (Eigen::Index m = 0; m < q.size(); ++m)
    unbalanced[contact.motions[m].piece] += unbalanced_N(m) * unbalanced_N(m);
  const int worst =
      std::ranges::max_element(unbalanced, {}, [](const auto& of) { return of.second; })->first;
  const double turn = turn_of(contact, worst, q);
  RigidGroup group;
  group.turn = turn;
  double area = 0;
  const auto for_each_alike = [&](const auto& visit) {
    int seen = RigidContact::held;
    for (std::size_t m = 0; m < contact.motions.size(); ++m) {
      const auto& [piece, of_one_mm, area_mm2] = contact.motions[m];
      if (piece == seen) continue;
      seen = piece;
      const Eigen::Vector2d &c = of_one_mm.centre, v = velocity_of(contact, piece, q, c),
                            v_worst = velocity_of(contact, worst, q, c);
      const double size = std::sqrt(area_mm2),
                   scale = alike * (v_worst.norm() + size * std::abs(turn));
      if (piece == worst || ((v - v_worst).norm() <= scale &&
                             std::abs(turn_of(contact, piece, q) - turn) * size <= scale))
        visit(piece, c, area_mm2, contact.bodies[m]);
    }
  };
  for_each_alike(
      [&](int piece, const Eigen::Vector2d& c, double area_mm2, const std::string& body) {
        group.pieces.push_back(piece);
        group.bodies += (group.bodies.empty() ? "" : " and ") + body;
        group.centroid += area_mm2 * c;
        area += area_mm2;
      });
  group.centroid /= area;
  group.size_mm = std::sqrt(area);
  group.velocity = velocity_of(contact, worst, q, group.centroid);
  return with_loads(contact, std::move(group), unbalanced_N);
}

RigidGroup with_loads(const RigidContact& contact, RigidGroup group,
                      const Eigen::VectorXd& loads_N) {
  group.force_N.setZero();
  group.moment_Nmm = 0;
  for (Eigen::Index m = 0; m < loads_N.size(); ++m) {
    const auto& [piece, of_one_mm, area_mm2] = contact.motions[m];
    if (std::ranges::find(group.pieces, piece) == group.pieces.end()) continue;
    const Eigen::Vector2d f = loads_N(m) * of_one_mm.translation_mm,
                          d = of_one_mm.centre - group.centroid;
    group.force_N += f;
    group.moment_Nmm += d.x() * f.y() - d.y() * f.x();
    if (of_one_mm.rotation != 0) group.moment_Nmm += loads_N(m) / of_one_mm.rotation;
  }
  return group;
}

}  // namespace airybench
