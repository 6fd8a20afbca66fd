// The contact problem on a mesh, in physical terms, before any choice of unknowns.
//
//   −div σ = b,  ε(u) = C σ + ε0 in Ω;   u = u0 on Γ_D;   σn = f on Γ_F;
//   on Γ_C, with gap g0 along the outward normal and the solution's own σ_n as threshold:
//     σ_n ≤ 0,  u_n ≤ g0,  σ_n (u_n − g0) = 0;   |σ_t| ≤ −μ σ_n, sliding only at equality, opposed.
// Where two bodies face each other u is the sum of both sides' displacements, each in its own frame
// (n, t), g0 that of their gaps, and σ_n, σ_t are the same on both.
// Parts of Γ_D may be rollers: u_n = n·u0, σ_t = 0. ε0: thermal_strain.hpp.
//
// The rigid motion ρ nearest to u0 is taken out: the unknown is w = u − ρ, with u0 − ρ on Γ_D; on
// Γ_C, u = w + ρ puts ρ into the gap, normal and tangential (ContactOffset). Energies are those of
// w: with b or f they differ from those of u by the constant work on ρ. Pieces that contact alone
// holds have motions of their own besides (free_motions.hpp), which enter as ρ does; energies are
// with these.
//
// Every method starts from here; assembly turns it into the Airy system (airy_system.hpp).
// Coordinates, compliances and load values are exact doubles, the data of the discrete problem;
// templates over Scalar compute from them in Scalar.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "assembly/elements/bernstein.hpp"
#include "assembly/elements/curved_side.hpp"
#include "assembly/elements/edge_forces.hpp"
#include "assembly/elements/elasticity.hpp"
#include "assembly/elements/hct.hpp"
#include "assembly/elements/stress_degrees.hpp"
#include "assembly/problem/free_motions.hpp"
#include "assembly/problem/rigid_motion.hpp"
#include "assembly/problem/thermal_strain.hpp"
#include "assembly/problem/wall_gap.hpp"
#include "mesh/mesh.hpp"

namespace airybench {

// Boundary data at x on an edge of Mesh::boundary, and body force. An empty function is zero and
// costs nothing.
struct Loads {
  // Per row of Mesh::boundary, where a load step has others than the mesh: edges of Γ_D that become
  // Γ_F, or the other way; empty: the mesh's.
  std::vector<BoundaryRole> roles;
  std::function<Eigen::Vector2d(const Eigen::Vector2d& x, int boundary_row)>
      displacement_mm;  // u0 on Γ_D; in a Problem without ρ
  std::function<Eigen::Vector2d(const Eigen::Vector2d& x, const Eigen::Vector2d& normal,
                                int boundary_row)>
      traction_MPa;  // f on Γ_F; linear on every edge
  std::function<double(const Eigen::Vector2d& x, int boundary_row)>
      gap_mm;                           // g0 on Γ_C, quadratic on every edge
  std::vector<WallDetail> wall_detail;  // what gap_mm omits, per row; empty: nothing
  std::vector<bool> rollers;  // per row of Mesh::boundary: rolling edges of Γ_D; empty: none
  std::vector<PointSupport> points;  // of u, not w; forces are zero there
  // u_t on Γ_C from which slip is measured, that of the previous load step. Per row of
  // Mesh::boundary a column of Bernstein coefficients, from the start of the edge's walk to its
  // end; empty: zero.
  Eigen::MatrixXd slid_mm;
  Eigen::Vector2d body_force_N_per_mm3 = {0, 0};  // b, constant
  std::vector<ThermalStrain> thermal;             // per row of Mesh::body_names; empty: none

  bool has_body_force() const { return !body_force_N_per_mm3.isZero(0); }
};

// What stands for the curved edges of a body. Stresses of degree 1 take the chords.
enum class Sides : std::uint8_t { chords, curves };
constexpr Sides sides_of_stresses(int degree) {
  return degree == 1 ? Sides::chords : Sides::curves;
}

enum class Known : std::uint8_t { displacement, force, contact_law };
struct EdgeCondition {
  bool in_frame;  // components: outward normal and tangent; else x and y
  std::array<Known, 2> component;
};

// Outward normals of an edge's contact law, at i/n of the way from its start to its end. On a flat
// wall all are equal.
class ContactNormals {
 public:
  static constexpr int max_parts = highest_stress_degree + 2;
  ContactNormals() { normals_.fill(Eigen::Vector2d::Zero()); }
  Eigen::Vector2d& at(int i, int n) { return normals_[place(i, n)]; }  // 0 ≤ i ≤ n ≤ max_parts
  const Eigen::Vector2d& at(int i, int n) const { return normals_[place(i, n)]; }
  // direction(i/n) everywhere.
  template <typename Direction>
  static ContactNormals along(const Direction& direction) {
    ContactNormals normals;
    for (int n = 1; n <= max_parts; ++n)
      for (int i = 0; i <= n; ++i) normals.at(i, n) = direction(static_cast<double>(i) / n);
    return normals;
  }
  std::span<const Eigen::Vector2d> all(int n) const {
    return {&at(0, n), static_cast<std::size_t>(n) + 1};
  }
  std::span<const Eigen::Vector2d> all() const { return normals_; }
  bool is_given() const { return !normals_.front().isZero(0); }
  bool operator==(const ContactNormals&) const = default;

 private:
  static constexpr std::size_t place(int i, int n) {
    return static_cast<std::size_t>((n - 1) * (n + 2) / 2 + i);
  }
  std::array<Eigen::Vector2d, max_parts*(max_parts + 3) / 2> normals_;
};

// Rollers are parallel if the sine between their directions is smaller.
inline constexpr double straight_roller = 1e-6;

// How far the body may move at a point of Γ_C before the contact law acts: wall, crown and
// clearance, the load step's rigid motion, and the slip of earlier steps.
struct ContactOffset {
  double gap_mm = 0;                   // g0
  double slid_mm = 0;                  // s0: u_t from which slip is measured
  Eigen::Vector2d motion_mm = {0, 0};  // ρ, and a free piece's own

  // For w, along an outward normal and, without slip, its tangent: (g0 − ρ_n, s0 − ρ_t).
  Eigen::Vector2d along(const Eigen::Vector2d& n) const {
    const Eigen::Vector2d t(-n.y(), n.x());
    return {gap_mm - n.dot(motion_mm), slid_mm - t.dot(motion_mm)};
  }
};

// The moments ū_j of an edge, k + 1 for stresses of degree k (edge_forces.hpp for k = 1,
// equilibrium_element.hpp), from its start on. Columns: their x and y.
using EdgeMoments =
    Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::ColMajor, 2, highest_stress_degree + 1>;

// Of u(x) on the edge from a to b: along its curve, else of the quadratic through u at both ends
// and the middle.
template <typename Displacement>
EdgeMoments moments_along(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                          const SideCurve& curve, int degree, const Displacement& u) {
  if (!curve.is_straight()) return CurvedSide<double>(curve, degree).moments_of(u);
  const auto along = edge_coefficients<Eigen::Vector2d>(u(a), u((a + b) / 2), u(b));
  EdgeMoments moments(2, degree + 1);
  for (int j = 0; j <= degree; ++j) moments.col(j) = moment_of(degree, j, along);
  return moments;
}

struct Problem {
  Mesh mesh;
  MeshEdges edges = {};
  std::vector<Eigen::Matrix3d> compliance;  // per row of mesh.body_names, 1/MPa
  // The same: ν of σ_zz = ν (σ_xx + σ_yy), 0 in plane stress; empty: not known.
  std::vector<double> poisson_zz = {};
  Loads loads;              // without the rigid motion
  RigidMotion motion = {};  // ρ
  FreeMotions free = {};
  std::vector<double> friction = {};  // μ ≥ 0 per row of Mesh::boundary, 0 off Γ_C; empty: none
  std::vector<ContactNormals> contact_normals = {};  // per row; empty: the edges' own
  // The same along the curves of edges, at ξ = i/n, of rollers, too; zero where an edge has neither
  // law nor curve; empty: there are none.
  std::vector<ContactNormals> curve_normals = {};
  // Per row: the contact edge of another body that it presses on, walked the other way; none: a
  // wall. Empty: walls only. Its points match those of this edge, and its frames are opposite.
  static constexpr int no_row = -1;
  std::vector<int> opposite = {};
  struct Matching {  // of those edges: vertices of the mesh that were put in and moved for it
    int inserted = 0, moved = 0;
    bool has_curves = false;  // edges stand for curves; the gap is known at three points of each
  } matching = {};
  // Stresses of degree 2 and more (curved_element.hpp) and displacements (curved_traces.hpp) follow
  // curved edges, of a pair both or none, rollers unless a piece could then move along them; others
  // take their chords. Triangles and rows in ascending order.
  struct RoundTriangle {
    int triangle;
    std::array<int, 3> rows;  // per side, of Mesh::boundary
  };
  std::vector<RoundTriangle> round = {};
  std::vector<int> round_rows = {};
  // Load steps after this one, with the whole u0. Slip is measured from the previous step, so they
  // are posed one by one (load_steps.hpp). Supports may change: `mesh` has the first step's.
  std::vector<Loads> later_steps = {};
  // Per piece of the mesh, nearest to its centroid: origin of φ; the first, of the particular
  // stress.
  std::vector<int> central_vertices = {0};

  const Eigen::Matrix3d& compliance_of(int triangle) const {
    return compliance[mesh.triangle_body[triangle]];
  }
  // Whether the same stress strains two bodies alike.
  bool strain_alike(int body, int other) const {
    return compliance[body] == compliance[other] &&
           (loads.thermal.empty() || loads.thermal[body] == loads.thermal[other]);
  }
  TriangleVertices vertices_of(int triangle) const;
  template <typename Scalar = double>
  Scalar area_mm2(int triangle) const {
    const auto& [a, b, c] = mesh.triangles[triangle];
    return cross_area<Scalar>(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]) / 2;
  }
  EdgeSigns edge_signs(int triangle) const;  // see hct.hpp

  const ThermalStrain& thermal_strain(int triangle) const {  // where there is any
    return loads.thermal[static_cast<std::size_t>(mesh.triangle_body[triangle])];
  }
  bool is_warm(int triangle) const {
    return !loads.thermal.empty() && !thermal_strain(triangle).is_zero();
  }

  // Per side of a triangle points of the curve that stresses or displacements of a degree follow;
  // none: straight sides only.
  std::optional<CurvedSides> curves_of(int triangle, int degree) const;
  bool follows_curve(int boundary_row, int degree) const;
  SideCurve curve_of(int boundary_row, int degree) const;  // if it follows one

  double friction_at(int boundary_row) const {
    return friction.empty() ? 0 : friction[static_cast<std::size_t>(boundary_row)];
  }
  bool has_friction() const { return !friction.empty(); }
  int opposite_of(int boundary_row) const {
    return opposite.empty() ? no_row : opposite[static_cast<std::size_t>(boundary_row)];
  }
  // Both edges of a pair are listed; true of the later one.
  bool is_second_of_pair(int boundary_row) const {
    const int other = opposite_of(boundary_row);
    return other != no_row && other < boundary_row;
  }
  bool has_gap() const {
    return loads.gap_mm || loads.slid_mm.size() > 0 || !motion.is_zero() ||
           free.amounts_mm.size() > 0;
  }
  // ρ and a free piece's own motion, at x on the piece that a vertex belongs to.
  Eigen::Vector2d motion_at(const Eigen::Vector2d& x, int vertex) const {
    return motion.at(x) + free.at(x, vertex);
  }
  WallDetail wall_detail_at(int boundary_row) const {
    return loads.wall_detail.empty() ? WallDetail{}
                                     : loads.wall_detail[static_cast<std::size_t>(boundary_row)];
  }
  // At x on an edge of Γ_C, without slip. Bernstein coefficients: offset_coefficients().
  ContactOffset offset_at(const Eigen::Vector2d& x, int boundary_row) const;

  // True if the law's normal changes along an edge. Stresses and displacements are then admissible
  // up to the square of that angle.
  bool contact_turns() const;
  // The edge's own frame, on Γ_C the contact law's, at i/n of the way from start to end, on its
  // chord or on its curve, there of rollers the curve's, too.
  template <typename Scalar = double>
  EdgeFrameIn<Scalar> frame_at(int boundary_row, int i, int n) const {
    return frame_of<Scalar>(contact_normals, boundary_row, i, n);
  }
  template <typename Scalar = double>
  EdgeFrameIn<Scalar> frame_on_curve(int boundary_row, int i, int n) const {
    return frame_of<Scalar>(curve_normals, boundary_row, i, n);
  }
  // Of F_j and ū_j, for stresses of a degree: at the centre of the weight B_j. In a round wall a
  // body can then turn without strain, since ∫ B_j ωJx ds ∥ J x_centre. (k + 1)/length F_j are the
  // Bernstein coefficients of the traction.
  template <typename Scalar = double>
  EdgeFrameIn<Scalar> frame_of_moment(int boundary_row, int degree, int j) const {
    if (!follows_curve(boundary_row, degree))
      return frame_at<Scalar>(boundary_row, j + 1, degree + 2);
    EdgeFrameIn<Scalar> frame = frame_on_curve<Scalar>(boundary_row, j + 1, degree + 2);
    frame.length_mm =
        mesh.boundary[boundary_row].curve.derivative(j / static_cast<double>(degree)).norm();
    return frame;
  }

  // Without friction the tangential force on Γ_C is known, as on a roller: zero.
  EdgeCondition condition(int boundary_row) const;
  bool is_roller(int boundary_row) const {
    return !loads.rollers.empty() && loads.rollers[static_cast<std::size_t>(boundary_row)];
  }
  // ū0 of an edge of Γ_D, mm; on a roller its normal part.
  EdgeMoments prescribed_moments(int boundary_row, int degree = 1) const;

  // A stress field that balances b: σ_p = −diag(b_x (x−x_c), b_y (y−y_c)), as (xx, yy, xy) in MPa.
  template <typename Scalar = double>
  Eigen::Vector3<Scalar> particular_stress(
      const std::type_identity_t<Eigen::Vector2<Scalar>>& x) const {
    const Eigen::Vector2<Scalar> d = x - mesh.vertices[central_vertices.front()].cast<Scalar>();
    const Eigen::Vector2<Scalar> b = loads.body_force_N_per_mm3.cast<Scalar>();
    return {-b.x() * d.x(), -b.y() * d.y(), Scalar(0)};
  }

 private:
  template <typename Scalar>
  EdgeFrameIn<Scalar> frame_of(const std::vector<ContactNormals>& normals, int boundary_row, int i,
                               int n) const {
    const auto [a, b] = mesh.boundary[boundary_row].vertices;
    const EdgeFrameIn<Scalar> own = edge_frame<Scalar>(mesh.vertices[a], mesh.vertices[b]);
    if (normals.empty() || !normals[boundary_row].is_given()) return own;
    const Eigen::Vector2<Scalar> normal =
        normals[boundary_row].at(i, n).template cast<Scalar>().normalized();
    return {own.length_mm, {-normal.y(), normal.x()}, normal};
  }
};

// True if two problems differ in loads, gap and friction at most: same mesh, materials and known
// components on every boundary edge. (With friction others are known than without.)
bool same_body(const Problem& a, const Problem& b);

// Finds the edges whose curves are followed, which depend on `curve_normals` of contact edges and
// on `opposite`, and adds the normals of rollers.
void find_round_sides(Problem& problem);

// Takes a valid mesh (see validate()), one compliance per body, loads with the whole u0, and μ on
// Γ_C, per row of Mesh::boundary or one for all.
Problem make_problem(Mesh mesh, std::vector<Eigen::Matrix3d> compliance, Loads loads,
                     const std::vector<double>& friction);
Problem make_problem(Mesh mesh, std::vector<Eigen::Matrix3d> compliance, Loads loads,
                     double friction);
// The same body between the chords of its curved edges.
Problem with_chords(Problem problem);
// For a problem with the whole u0.
SplitDisplacement split_rigid_motion(const Problem& problem);
// The same body under other loads with the whole u0, supported as these say; without later steps
// and known free motions.
Problem with_loads(const Problem& problem, Loads loads);
// Whether the same edges are held in both load steps, and the same roll.
bool same_supports(const Problem& first, const Loads& a, const Loads& b);
// Of a problem with later steps, from 0; without the slip of those before.
Problem problem_of_step(const Problem& first, int step);
// Whether in some step contact or points alone hold a piece.
bool has_free_motions(const Problem& first);
// Free pieces moved by these amounts.
Problem with_free_motion(Problem problem, Eigen::VectorXd amounts_mm);

// Traction σn of a stress (xx, yy, xy).
template <typename Scalar = double>
Eigen::Vector2<Scalar> traction(const std::type_identity_t<Eigen::Vector3<Scalar>>& stress,
                                const std::type_identity_t<Eigen::Vector2<Scalar>>& normal) {
  return {stress(0) * normal.x() + stress(2) * normal.y(),
          stress(2) * normal.x() + stress(1) * normal.y()};
}

}  // namespace airybench
