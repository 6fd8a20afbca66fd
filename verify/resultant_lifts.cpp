#include "verify/resultant_lifts.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>

#include "assembly/total_displacement.hpp"
#include "solvers/loading/load_steps.hpp"
#include "solvers/methods.hpp"
#include "verify/displacement_recovery.hpp"

namespace airybench {
namespace {

constexpr int no_unit = -1;

// The sides of faces, joined to units that move together.
class LiftUnits {
 public:
  struct Unit {
    int piece;
    Eigen::VectorXd parts;
    int solve;  // which of its piece's units it is
  };

  LiftUnits(const Problem& problem, const std::vector<ContactFace>& faces, int degree)
      : problem_(problem),
        mesh_(problem.mesh),
        degree_(degree),
        slides_(!problem.has_friction() && problem.free.motions.empty()),
        unit_of_row_(mesh_.boundary.size(), no_unit) {
    const int sides = find_sides(faces);
    join(sides);
    number(sides);
  }

  const std::vector<int>& face_of_part() const { return face_of_part_; }
  const std::vector<Unit>& units() const { return units_; }
  int solves() const { return solves_; }
  bool is_roller(int row) const {
    if (mesh_.boundary[row].role != BoundaryRole::contact) return problem_.is_roller(row);
    return slides_ && is_flat(row);
  }

  // Of a unit that has none v would jump.
  bool has_lift(int unit, bool tangential) const {
    std::vector<int> after(mesh_.vertices.size(), Problem::no_row);
    for (int row = 0; row < rows(); ++row) after[mesh_.boundary[row].vertices[0]] = row;
    const auto motion = [&](int row, double s) -> Eigen::Vector2d {
      if (unit_of_row_[row] != unit) return {0, 0};
      return direction(row, s, tangential);
    };
    for (int a = 0; a < rows(); ++a) {
      const int b = after[mesh_.boundary[a].vertices[1]];
      if (is_held(a) && is_held(b) && jumps(a, motion(a, 1), b, motion(b, 0))) return false;
    }
    return true;
  }

  // v on the contact edges, where every unit moves by its weight.
  Eigen::Vector2d motion(const Eigen::Vector2d& x, int row, const Eigen::VectorXd& weights,
                         bool tangential) const {
    const int unit = unit_of_row_[row];
    if (unit == no_unit) return {0, 0};
    const auto [start, end] = mesh_.boundary[row].vertices;
    const Eigen::Vector2d a = mesh_.vertices[start], chord = mesh_.vertices[end] - a;
    return weights(unit) * direction(row, chord.dot(x - a) / chord.squaredNorm(), tangential);
  }

 private:
  int rows() const { return static_cast<int>(mesh_.boundary.size()); }
  bool is_held(int row) const { return mesh_.boundary[row].role != BoundaryRole::force; }

  EdgeFrame frame(int row, int i) const {
    return problem_.follows_curve(row, degree_) ? problem_.frame_on_curve(row, i, 2)
                                                : problem_.frame_at(row, i, 2);
  }
  Eigen::Vector2d own_normal(int row) const {
    const auto [a, b] = mesh_.boundary[row].vertices;
    return edge_frame(mesh_.vertices[a], mesh_.vertices[b]).normal;
  }
  bool is_flat(int row) const {
    for (const int i : {0, 1, 2})
      if ((frame(row, i).normal - own_normal(row)).norm() > straight_roller) return false;
    return true;
  }
  // Interpolated between those of the law at the edge's ends and middle.
  Eigen::Vector2d direction(int row, double s, bool tangential) const {
    const auto at = [&](int i) {
      const EdgeFrame own = frame(row, i);
      return tangential ? own.tangent : own.normal;
    };
    return (1 - s) * (1 - 2 * s) * at(0) + 4 * s * (1 - s) * at(1) + s * (2 * s - 1) * at(2);
  }
  // Where edges a and b meet, with v as prescribed on each.
  bool jumps(int a, const Eigen::Vector2d& of_a, int b, const Eigen::Vector2d& of_b) const {
    constexpr double on_curves = 1e-3;  // neighbours know their common curve so well
    const double allowed = problem_.contact_turns() ? on_curves : straight_roller;
    const Eigen::Vector2d off = of_a - of_b, n = own_normal(a), m = own_normal(b);
    if (!is_roller(a) && !is_roller(b)) return off.norm() > allowed;
    if (!is_roller(a)) return std::abs(m.dot(off)) > allowed;
    if (!is_roller(b)) return std::abs(n.dot(off)) > allowed;
    return std::abs(n.x() * m.y() - n.y() * m.x()) < straight_roller &&
           std::abs(n.dot(off)) > allowed;
  }

  // Numbers them in unit_of_row_; a side: a part's edges on one of its pieces.
  int find_sides(const std::vector<ContactFace>& faces) {
    const MeshPieces pieces = pieces_of(mesh_);
    const auto piece = [&](int row) {
      return row == Problem::no_row ? Problem::no_row
                                    : pieces.of_vertex[mesh_.boundary[row].vertices[0]];
    };
    std::map<std::array<int, 3>, std::array<int, 2>> sides_of;
    for (int face = 0; face < static_cast<int>(faces.size()); ++face)
      for (const int row : faces[face].rows) {
        const int other = problem_.opposite_of(row);
        const auto [found, is_new] =
            sides_of.try_emplace({face, piece(row), piece(other)}, std::array{0, 0});
        if (is_new) {
          const int part = static_cast<int>(face_of_part_.size());
          face_of_part_.push_back(face);
          for (const int of : {row, other}) {
            if (of == Problem::no_row) continue;
            found->second[of == row ? 0 : 1] = static_cast<int>(side_part_.size());
            side_part_.push_back(part);
            side_piece_.push_back(piece(of));
          }
        }
        unit_of_row_[row] = found->second[0];
        if (other != Problem::no_row) unit_of_row_[other] = found->second[1];
      }
    return static_cast<int>(side_part_.size());
  }

  int root(int side) const {
    while (joined_to_[side] != side) side = joined_to_[side];
    return side;
  }
  void join(int sides) {
    constexpr int most = 12;  // sides that move one by one on a piece, each by a solve
    std::map<int, int> on_piece;
    for (int side = 0; side < sides; ++side) {
      joined_to_.push_back(side);
      ++on_piece[side_piece_[side]];
    }
    for (int side = 0; side < sides; ++side)
      for (int other = 0; other < side; ++other)
        if (side_piece_[side] == side_piece_[other] && on_piece[side_piece_[side]] > most)
          joined_to_[root(side)] = root(other);
    for (const std::vector<int>& chain : boundary_chains(mesh_, BoundaryRole::contact))
      for (std::size_t k = 0; k < chain.size(); ++k) {
        const int a = chain[k], b = chain[(k + 1) % chain.size()];
        if (mesh_.boundary[a].vertices[1] != mesh_.boundary[b].vertices[0] ||
            root(unit_of_row_[a]) == root(unit_of_row_[b]))
          continue;
        for (const bool tangential : {false, problem_.has_friction()})
          if (jumps(a, direction(a, 1, tangential), b, {0, 0}) ||
              jumps(a, {0, 0}, b, direction(b, 0, tangential)))
            joined_to_[root(unit_of_row_[a])] = root(unit_of_row_[b]);
      }
  }

  void number(int sides) {
    std::map<int, int> unit_of_root, on_piece;
    for (int side = 0; side < sides; ++side) {
      const auto [found, is_new] =
          unit_of_root.try_emplace(root(side), static_cast<int>(units_.size()));
      if (is_new) {
        units_.push_back({side_piece_[side],
                          Eigen::VectorXd::Zero(static_cast<Eigen::Index>(face_of_part_.size())),
                          on_piece[side_piece_[side]]++});
        solves_ = std::max(solves_, units_.back().solve + 1);
      }
      units_[found->second].parts(side_part_[side]) += 1;
    }
    for (int& unit : unit_of_row_)
      if (unit != no_unit) unit = unit_of_root.at(root(unit));
  }

  const Problem& problem_;
  const Mesh& mesh_;
  int degree_;
  bool slides_;                   // contact edges hold their normals only
  std::vector<int> unit_of_row_;  // a side's number at first
  std::vector<int> side_part_, side_piece_, joined_to_;
  std::vector<int> face_of_part_;
  std::vector<Unit> units_;
  int solves_ = 0;
};

// Γ_C held, and moved.
class HeldFaces {
 public:
  HeldFaces(const Problem& problem, int degree, const std::vector<ContactFace>& faces)
      : problem_(problem),
        units_(std::make_shared<const LiftUnits>(problem, faces, degree)),
        pieces_(pieces_of(problem.mesh)),
        method_(select_methods(hybrid_of_degree(degree)).front()) {
    Mesh mesh = problem.mesh;
    for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row) {
      loads_.rollers.push_back(units_->is_roller(row));
      if (!problem.follows_curve(row, degree)) mesh.boundary[row].curve = {};
      if (mesh.boundary[row].role == BoundaryRole::contact)
        mesh.boundary[row].role = BoundaryRole::displacement;
    }
    held_ = std::make_shared<const Problem>(
        make_problem(std::move(mesh), problem.compliance, loads_, 0));
    system_ = contact_system(held_, degree);
  }

  const LiftUnits& units() const { return *units_; }

  // Per wanted sum of the faces, one or zero each, a lift if there is one.
  std::vector<std::optional<Lift>> lifts(const std::vector<std::vector<bool>>& wanted,
                                         bool tangential) {
    std::vector<std::optional<Lift>> lifts(wanted.size());
    std::vector<int> movable;
    for (int unit = 0; unit < static_cast<int>(units_->units().size()); ++unit)
      if (units_->has_lift(unit, tangential)) movable.push_back(unit);
    if (movable.empty()) return lifts;
    const Eigen::MatrixXd products = products_of(movable, tangential);
    for (std::size_t k = 0; k < wanted.size(); ++k)
      if (const auto weights = weights_of(movable, products, wanted[k]))
        // Of a motion without strain the method may say that all is rounding.
        if (const Solution answer = solved(*weights, tangential); has_answer(answer.status))
          lifts[k] = lift(answer);
    return lifts;
  }

 private:
  Solution solved(const Eigen::VectorXd& weights, bool tangential) {
    Loads loads = loads_;
    loads.displacement_mm = [units = units_, weights, tangential](const Eigen::Vector2d& x,
                                                                  int row) {
      return units->motion(x, row, weights, tangential);
    };
    system_.set_load_case(std::make_shared<const Problem>(with_loads(*held_, std::move(loads))));
    RunControl control;
    control.keep_body = !again_;
    Solution answer = run(again_ ? again_ : method_.solve, system_, control);
    if (answer.solve_again) again_ = std::move(answer.solve_again);
    answer.solve_again = nullptr;
    return answer;
  }

  Lift lift(const Solution& answer) const {
    DisplacementField v =
        with_rigid_motion(*system_.problem, recovered_displacement(system_, answer));
    StressField stress = stress_of_strain(problem_, v);
    const double norm = std::sqrt(stress_norm_squared(problem_, stress));
    return {std::move(v), std::move(stress), norm};
  }

  // Of the stresses that units cause: ∫ σ_i:C:σ_j. Those of different pieces are solved at once.
  Eigen::MatrixXd products_of(const std::vector<int>& movable, bool tangential) {
    const auto count = static_cast<Eigen::Index>(units_->units().size());
    std::vector<StressField> stress;
    for (int solve = 0; solve < units_->solves(); ++solve) {
      Eigen::VectorXd weights = Eigen::VectorXd::Zero(count);
      for (const int unit : movable) weights(unit) = units_->units()[unit].solve == solve ? 1 : 0;
      stress.push_back(solved(weights, tangential).stress);
    }
    Eigen::MatrixXd products = Eigen::MatrixXd::Zero(count, count);
    for (int t = 0; t < static_cast<int>(problem_.mesh.triangles.size()); ++t)
      for (const int i : movable)
        for (const int j : movable) {
          const LiftUnits::Unit &one = units_->units()[i], &other = units_->units()[j];
          if (one.piece != pieces_.of_vertex[problem_.mesh.triangles[t][0]] ||
              other.piece != one.piece || stress[one.solve].empty() || stress[other.solve].empty())
            continue;
          products(i, j) += stress_product(problem_, t, stress[one.solve], stress[other.solve]);
        }
    return products;
  }

  // With the least norm. Empty: none moves as it is wanted to.
  std::optional<Eigen::VectorXd> weights_of(const std::vector<int>& movable,
                                            const Eigen::MatrixXd& products,
                                            const std::vector<bool>& wanted) const {
    constexpr double rounding = 1e-9;
    const auto count = static_cast<Eigen::Index>(movable.size()),
               parts = static_cast<Eigen::Index>(units_->face_of_part().size());
    const double largest = products.diagonal().maxCoeff();
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(count + parts, count + parts);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(count + parts);
    K.topLeftCorner(count, count) = products(movable, movable) / (largest > 0 ? largest : 1);
    for (Eigen::Index i = 0; i < count; ++i)
      K.block(count, i, parts, 1) = units_->units()[movable[static_cast<std::size_t>(i)]].parts;
    K.topRightCorner(count, parts) = K.bottomLeftCorner(parts, count).transpose();
    for (Eigen::Index part = 0; part < parts; ++part)
      right(count + part) =
          wanted[static_cast<std::size_t>(units_->face_of_part()[static_cast<std::size_t>(part)])]
              ? 1
              : 0;
    const Eigen::VectorXd w = K.completeOrthogonalDecomposition().solve(right).head(count),
                          off = K.bottomLeftCorner(parts, count) * w - right.tail(parts);
    if (off.cwiseAbs().maxCoeff() > rounding) return {};
    Eigen::VectorXd of_units = Eigen::VectorXd::Zero(products.rows());
    of_units(movable) = w;
    return of_units;
  }

  const Problem& problem_;
  std::shared_ptr<const LiftUnits> units_;
  MeshPieces pieces_;
  Method method_;
  Loads loads_;
  std::shared_ptr<const Problem> held_;
  ContactSystem system_;
  Solve again_;  // with the factors of the first solve
};

}  // namespace

ResultantLifts resultant_lifts(const Problem& problem, int degree) {
  ResultantLifts result;
  result.faces = contact_faces(problem);
  const std::size_t count = result.faces.size();
  result.of_faces.resize(count);
  if (count == 0) return result;
  HeldFaces held(problem, degree, result.faces);
  std::vector<std::vector<bool>> wanted = {std::vector<bool>(count, true)};
  for (std::size_t face = 0; count > 1 && face < count; ++face) {
    wanted.emplace_back(count, false);
    wanted.back()[face] = true;
  }
  const auto set = [&](bool tangential, std::optional<Lift> FaceLifts::*lift) {
    std::vector<std::optional<Lift>> lifts = held.lifts(wanted, tangential);
    for (std::size_t face = 0; face < count; ++face)
      result.of_faces[face].*lift = lifts[count > 1 ? face + 1 : 0];
    result.of_all.*lift = std::move(lifts.front());
  };
  set(false, &FaceLifts::normal);
  if (problem.has_friction()) set(true, &FaceLifts::tangential);
  return result;
}

}  // namespace airybench
