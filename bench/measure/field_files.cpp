#include "bench/measure/field_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "assembly/control_points.hpp"
#include "assembly/curved_traces.hpp"
#include "assembly/elements/edge_forces.hpp"
#include "assembly/total_displacement.hpp"
#include "bench/measure/part_answer.hpp"
#include "bench/measure/part_picture.hpp"
#include "bench/measure/point_locator.hpp"
#include "bench/measure/stress_samples.hpp"
#include "bench/measure/vtu.hpp"
#include "mesh/boundary_sides.hpp"
#include "solvers/contact/coulomb_law.hpp"
#include "support/atomic_file.hpp"
#include "verify/along_contact.hpp"
#include "verify/displacement_recovery.hpp"

namespace airybench {
namespace {

Eigen::Vector2d corner_of_third(const TriangleVertices& v, int column) {
  const int third = column / 3, corner = column % 3;
  return corner == 2 ? Eigen::Vector2d(v.rowwise().mean())
                     : Eigen::Vector2d(v.col((third + corner) % 3));
}

std::string stress_csv(const Problem& problem, const StressField& stress) {
  std::string text = "triangle,third,corner,x_mm,y_mm,sxx_MPa,syy_MPa,sxy_MPa\n";
  for (int t = 0; t < static_cast<int>(stress.size()); ++t) {
    const TriangleVertices v = problem.vertices_of(t);
    const ElementStress corners = stress.corners(static_cast<std::size_t>(t));
    for (int c = 0; c < 9; ++c) {
      const Eigen::Vector2d x = corner_of_third(v, c);
      const auto s = corners.col(c);
      text += fmt::format("{},{},{},{},{},{},{},{}\n", t + 1, c / 3 + 1, c % 3 + 1, x.x(), x.y(),
                          s(0), s(1), s(2));
    }
  }
  return text;
}

// At the vertices, then the middles of the edges V1V2, V2V3, V3V1.
Eigen::Matrix<double, 2, 6> values_at_nodes(const Problem& problem, int triangle,
                                            const DisplacementField& u) {
  Eigen::Matrix<double, 2, 6> values;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d here = Eigen::Vector3d::Unit(k),
                          next = Eigen::Vector3d::Unit((k + 1) % 3);
    values.col(k) = displacement_at(problem, u, triangle, here);
    values.col(3 + k) = displacement_at(problem, u, triangle, (here + next) / 2);
  }
  return values;
}

std::string displacement_csv(const Problem& problem, const DisplacementField& u) {
  std::string text = "triangle,node,x_mm,y_mm,ux_mm,uy_mm\n";
  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t) {
    const TriangleVertices v = problem.vertices_of(t);
    const Eigen::Matrix<double, 2, 6> values = values_at_nodes(problem, t, u);
    for (int k = 0; k < 6; ++k) {
      const Eigen::Vector2d x = k < 3 ? Eigen::Vector2d(v.col(k))
                                      : Eigen::Vector2d((v.col(k - 3) + v.col((k - 2) % 3)) / 2);
      text += fmt::format("{},{},{},{},{},{}\n", t + 1, k + 1, x.x(), x.y(), values(0, k),
                          values(1, k));
    }
  }
  return text;
}

std::string contact_csv(const ContactPicture& picture) {
  const auto value = [](const std::vector<double>& values, std::size_t p) {
    return values.empty() ? std::string() : fmt::format("{}", values[p]);
  };
  const auto row_of_opposite = [&](std::size_t p) {
    const bool is_paired = !picture.opposite.empty() && picture.opposite[p] >= 0;
    return is_paired ? fmt::format("{}", picture.opposite[p] + 1) : std::string();
  };
  std::string text =
      "x_mm,y_mm,normal_x,normal_y,edge_length_mm,F_n_N,F_t_N,gap_mm,slip_mm,opposite,piece,"
      "state\n";
  for (std::size_t p = 0; p < picture.force.size(); ++p) {
    const EdgeFrame& frame = picture.frame[p];
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", picture.at_mm[p].x(),
                        picture.at_mm[p].y(), frame.normal.x(), frame.normal.y(), frame.length_mm,
                        picture.force[p](0), picture.force[p](1), value(picture.gap_mm, p),
                        value(picture.slip_mm, p), row_of_opposite(p), picture.piece[p] + 1,
                        name_of(picture.state[p]));
  }
  return text;
}

std::string boundary_csv(const Problem& problem, int degree) {
  std::string text = "x0_mm,y0_mm,x1_mm,y1_mm,rolls,t0_x_MPa,t0_y_MPa,t1_x_MPa,t1_y_MPa,role\n";
  for (int row = 0; row < static_cast<int>(problem.mesh.boundary.size()); ++row) {
    const BoundaryEdge& edge = problem.mesh.boundary[row];
    const auto &a = problem.mesh.vertices[edge.vertices[0]],
               &b = problem.mesh.vertices[edge.vertices[1]];
    text += fmt::format("{},{},{},{},", a.x(), a.y(), b.x(), b.y());
    text += edge.role == BoundaryRole::displacement && problem.is_roller(row) ? "1" : "0";
    for (const int end : {0, 1}) {
      Eigen::Vector2d t(0, 0);
      if (edge.role == BoundaryRole::force && problem.loads.traction_MPa)
        t = problem.loads.traction_MPa(end == 0 ? a : b, normal_on_edge(problem, row, degree, end),
                                       row);
      text += fmt::format(",{},{}", t.x(), t.y());
    }
    text += fmt::format(",{}\n", boundary_role_names[static_cast<std::size_t>(edge.role)]);
  }
  return text;
}

std::vector<double> error_shares(const ConstitutiveError& error) {
  std::vector<double> shares = error.of_triangle_Nmm;
  double sum = 0;
  for (double& share : shares) sum += share = std::max(0.0, share);
  for (double& share : shares) share = sum > 0 ? share / sum : 0.0;
  return shares;
}

std::string error_csv(const ConstitutiveError& error) {
  const std::vector<double> shares = error_shares(error);
  std::string text = "triangle,error_share\n";
  for (std::size_t t = 0; t < shares.size(); ++t) text += fmt::format("{},{}\n", t + 1, shares[t]);
  return text;
}

template <typename Number>
std::vector<Number> of_thirds(const std::vector<Number>& of_triangles) {
  std::vector<Number> values;
  for (const Number value : of_triangles) values.insert(values.end(), 3, value);
  return values;
}

// Thirds are linear triangles for stresses of degree 1, else Lagrange triangles of the
// displacement's degree, curved where the stresses follow a curve.
std::string vtu_of_body(const Problem& problem, const StressField& stress,
                        const std::optional<DisplacementField>& u, const ConstitutiveError* error) {
  const int degree = stress.degree() == 1 ? 1 : stress.degree() + 1;
  const std::vector<std::array<int, 3>> nodes = lagrange_points(degree);
  const StressSamples samples(problem, stress, degree);
  VtuGrid grid;
  grid.cell = degree == 1 ? VtuCell::triangle : VtuCell::lagrange_triangle;
  grid.per_cell = nodes.size();
  std::vector<double> stresses, across, equivalent, principal;
  std::vector<Eigen::Vector2d> displacements;
  std::vector<std::int32_t> triangles;
  for (int t = 0; t < static_cast<int>(stress.size()); ++t) {
    triangles.push_back(t + 1);
    for (int k = 0; k < 3; ++k) {
      const StressSamples::Third third = samples.third(t, k);
      for (const auto& [a, b, c] : nodes) {
        const Eigen::Index at = samples.place(b, c);
        const Eigen::Vector3d s = third.stress.col(at);
        grid.points.emplace_back(third.at_mm.col(at));
        stresses.insert(stresses.end(), s.begin(), s.end());
        if (!problem.poisson_zz.empty()) {
          across.push_back(stress_zz(problem, t, grid.points.back(), s));
          equivalent.push_back(von_mises(s, across.back()));
          for (const double value : principal_stresses(s)) principal.push_back(value);
        }
        if (u) displacements.push_back(displacement_at(problem, *u, t, third.lambda.col(at)));
      }
    }
  }
  grid.of_points = vtu_array("stress_MPa", stresses, {"xx", "yy", "xy"});
  if (!across.empty())
    grid.of_points += vtu_array("stress_zz_MPa", across) + vtu_array("von_mises_MPa", equivalent) +
                      vtu_array("principal_MPa", principal, {"larger", "smaller"});
  if (u) grid.of_points += vtu_vectors("displacement_mm", displacements);
  const std::vector<int>& bodies = problem.mesh.triangle_body;
  grid.of_cells =
      vtu_array("body", of_thirds(std::vector<std::int32_t>(bodies.begin(), bodies.end()))) +
      vtu_array("triangle", of_thirds(triangles));
  if (error != nullptr) grid.of_cells += vtu_array("error_share", of_thirds(error_shares(*error)));
  return vtu_text(grid);
}

std::string vtu_of_contact(const ContactPicture& picture) {
  std::vector<double> F_n, F_t;
  for (const Eigen::Vector2d& force : picture.force) {
    F_n.push_back(force(0));
    F_t.push_back(force(1));
  }
  std::vector<Eigen::Vector2d> normals;
  for (const EdgeFrame& frame : picture.frame) normals.push_back(frame.normal);
  std::vector<std::int32_t> states;
  for (const ContactState state : picture.state) states.push_back(static_cast<std::int32_t>(state));
  VtuGrid grid = {VtuCell::poly_line, picture.at_mm, {}, {}, picture.per_edge};
  grid.of_points = vtu_array("F_n_N", F_n) + vtu_array("F_t_N", F_t) +
                   vtu_vectors("normal", normals) + vtu_array("state", states);
  if (!picture.gap_mm.empty()) grid.of_points += vtu_array("gap_mm", picture.gap_mm);
  if (!picture.slip_mm.empty()) grid.of_points += vtu_array("slip_mm", picture.slip_mm);
  return vtu_text(grid);
}

void take_forces(const ContactPoints& contact, const Solution& solution, ContactPicture& picture) {
  picture.state = contact_states(contact, solution.F_C);
  const int m = contact.components;
  for (int p = 0; p < contact.count; ++p)
    picture.force.emplace_back(solution.F_C(m * p), m == 2 ? solution.F_C(m * p + 1) : 0.0);
}

// The state is that of the nearest control point of the edge; if that is prescribed, of an inner
// one.
template <int p>
void take_forces_of_displacements(const ContactSystem& system, const Solution& solution,
                                  ContactPicture& picture) {
  const Problem& problem = *system.problem;
  const int last = system.contact.per_edge - 1;
  const ControlPoints control = control_points(problem, p);
  const std::vector<ContactState> states = contact_states(control.law, solution.F_C);
  std::map<int, ContactState> state_of_node;
  for (int i = 0; i < control.law.count; ++i) state_of_node[control.node[i]] = states[i];
  const std::vector<TriangleSide> sides = boundary_sides(problem.edges);

  for (int point = 0; point < system.contact.count; ++point) {
    const int row = system.contact.boundary[point], j = point % (last + 1);
    const std::array<int, p + 1> nodes = boundary_nodes<p>(problem, row);
    const auto found = state_of_node.find(nodes[(2 * j * p + last - 1) / (2 * last)]);
    picture.state.push_back(found != state_of_node.end() ? found->second
                                                         : state_of_node.at(nodes[1]));
    const auto [t, k] = sides[static_cast<std::size_t>(row)];
    const TriangleVertices v = problem.vertices_of(t);
    const Eigen::Vector2d force =
        (problem.follows_curve(row, system.degree)
             ? curved_edge_forces(v, solution.stress[t], k, problem.curve_of(row, system.degree))
             : element_edge_forces(v, solution.stress[t], k))
            .col(j);
    picture.force.emplace_back(picture.frame[point].normal.dot(force),
                               picture.frame[point].tangent.dot(force));
  }
}

// r = (w_n − (g0 − ρ_n), w_t − (s0 − ρ_t)) as moments, per contact point.
std::vector<Eigen::Vector2d> moments_of(const ContactSystem& system, const DisplacementField& w,
                                        const std::vector<EdgeFrame>& frames) {
  return with_degree(system.degree, [&](auto degree) {
    constexpr int k = degree, p = k + 1;
    const CurvedTraces traces(*system.problem, p, sides_of_stresses(k));
    const DisplacementField d = traces.traces(w);
    std::vector<Eigen::Vector2d> moments;
    for (int point = 0; point < system.contact.count; ++point) {
      const int row = system.contact.boundary[point];
      const std::array<int, p + 1> nodes = boundary_nodes<p>(*system.problem, row);
      const auto offset = traces.offsets<p>(row);
      const bool is_curved = system.problem->follows_curve(row, k);
      Eigen::Vector2d& moment = moments.emplace_back(0, 0);
      for (int i = 0; i <= p; ++i) {
        const EdgeFrame frame = is_curved ? traces.frame(row, i) : frames[point];
        const Eigen::Vector2d u = d.col(nodes[i]);
        moment += edge_moment(k, point % (k + 1), p, i) *
                  (Eigen::Vector2d(frame.normal.dot(u), frame.tangent.dot(u)) -
                   offset[i].along(frame.normal));
      }
    }
    return moments;
  });
}

// Of a pair the sum.
std::vector<Eigen::Vector2d> between_bodies(const ContactPoints& contact,
                                            std::vector<Eigen::Vector2d> r) {
  for (int p = 0; p < contact.count; ++p)
    if (const int q = contact.opposite_of(p); q > p) r[q] = r[p] += r[q];
  return r;
}

}  // namespace

ContactPicture contact_picture(const ContactSystem& system, const Solution& solution,
                               const std::optional<DisplacementField>& w) {
  const auto* const displacements = solution.as<Displacements>();
  const bool has_own_points = displacements == nullptr;
  if (const int degree = solution.stress.degree(); displacements && degree != system.degree)
    return contact_picture(contact_system(system.problem, degree), solution,
                           w ? std::optional(elevated(*system.problem, *w, degree + 1)) : w);
  const ContactPoints& contact = system.contact;
  ContactPicture picture;
  picture.per_edge = static_cast<std::size_t>(contact.per_edge);
  picture.opposite = contact.opposite;
  const MeshPieces pieces = pieces_of(system.problem->mesh);
  for (int p = 0; p < contact.count; ++p) {
    const int row = contact.boundary[p];
    const int j = p % contact.per_edge;
    const double s = static_cast<double>(j) / (contact.per_edge - 1);
    picture.at_mm.push_back(point_on_edge(*system.problem, row, system.degree, s));
    picture.frame.push_back(system.problem->frame_of_moment(row, system.degree, j));
    picture.piece.push_back(pieces.of_vertex[system.problem->mesh.boundary[row].vertices.front()]);
  }
  if (has_own_points)
    take_forces(contact, solution, picture);
  else
    with_degree(displacement_degree(*system.problem, displacements->w) - 1,
                [&](auto k) { take_forces_of_displacements<k + 1>(system, solution, picture); });
  if (w)
    for (const Eigen::Vector2d& r :
         between_bodies(contact, moments_of(system, *w, picture.frame))) {
      picture.gap_mm.push_back(-r.x());
      picture.slip_mm.push_back(r.y());
    }
  // A program that returns an Airy function has no contact displacement.
  if (!has_own_points || solution.contact_displacement.size() == 0) return picture;
  const Eigen::VectorXd r = relative_to_gap(contact, solution.contact_displacement);
  const int m = contact.components;
  picture.gap_mm.clear();
  if (m == 2) picture.slip_mm.clear();
  for (int p = 0; p < contact.count; ++p) {
    picture.gap_mm.push_back(-r(m * p));
    if (m == 2) picture.slip_mm.push_back(r(m * p + 1));
  }
  return picture;
}

SolvedFields own_fields(const ContactSystem& system, const Solution& solution) {
  SolvedFields fields{system,  solution, displacement_of_answer(system, solution),
                      nullptr, nullptr,  {}};
  if (fields.w && !fields.w->allFinite()) fields.w.reset();
  return fields;
}

void remove_files_of_fields(const std::filesystem::path& folder, const std::string& name) {
  std::error_code error;  // what cannot be removed cannot be replaced: that is said then
  for (const char* part : {".stress.csv", ".displacement.csv", ".contact.csv", ".boundary.csv",
                           ".faces.csv", ".answer.json", ".von_mises.csv", ".outline.csv",
                           ".points.json", ".error.csv", ".mean.csv", ".vtu", ".contact.vtu"})
    if (const auto file = folder / (name + part); !std::filesystem::is_directory(file, error))
      std::filesystem::remove(file, error);
}

void write_fields(const std::filesystem::path& folder, const std::string& name,
                  const SolvedFields& fields, FieldParts parts) {
  remove_files_of_fields(folder, name);
  const Problem& problem = *fields.system.problem;
  const StressField& stress = fields.solution.stress;
  const ContactPicture contact = contact_picture(fields.system, fields.solution, fields.w);
  make_folder(folder);
  const auto write = [&](const char* part, const std::string& text) {
    write_file_atomically(folder / (name + part), text);
  };
  const auto write_if = [&](bool is_known, const char* part, const auto& text) {
    if (is_known) write(part, text());
  };
  write(".contact.csv", contact_csv(contact));
  write(".contact.vtu", vtu_of_contact(contact));
  if (parts == FieldParts::contact) return;
  std::optional<DisplacementField> u;
  if (fields.w) u = with_rigid_motion(problem, *fields.w);
  write(".stress.csv", stress_csv(problem, stress));
  write(".boundary.csv", boundary_csv(problem, stress.degree()));
  const bool is_part = fields.solution.as<Displacements>() == nullptr;  // else F_C has other points
  const PartFiles part = is_part ? part_files(fields, contact) : PartFiles();
  write_if(is_part, ".answer.json", [&] { return json_text(to_json(part.answer)); });
  write_if(is_part, ".faces.csv", [&] { return part.faces_csv; });
  write_if(!fields.points_mm.empty(), ".points.json",
           [&] { return json_text(values_at_points(problem, stress, u, fields.points_mm)); });
  write_if(fields.picture, ".von_mises.csv", [&] { return von_mises_csv(fields); });
  write_if(fields.picture, ".outline.csv",
           [&] { return outline_csv(problem, stress.degree(), u); });
  write_if(u.has_value(), ".displacement.csv", [&] { return displacement_csv(problem, *u); });
  write_if(fields.error != nullptr, ".error.csv", [&] { return error_csv(*fields.error); });
  write_if(fields.mean.has_value(), ".mean.csv", [&] { return stress_csv(problem, *fields.mean); });
  write(".vtu", vtu_of_body(problem, stress, u, fields.error));
}

}  // namespace airybench
