#include "bench/measure/part_answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "assembly/elements/edge_forces.hpp"
#include "assembly/rigid_contact.hpp"
#include "assembly/total_displacement.hpp"
#include "bench/measure/contact_zones.hpp"
#include "bench/measure/stress_samples.hpp"
#include "bench/records/csv.hpp"
#include "mesh/boundary_sides.hpp"
#include "verify/along_contact.hpp"

namespace airybench {
namespace {

// Largest values over the body, and where singular places are.
class PartReader {
 public:
  explicit PartReader(const SolvedFields& fields)
      : system_(fields.system),
        problem_(*fields.system.problem),
        mesh_(problem_.mesh),
        stress_(fields.solution.stress),
        degree_(stress_.degree()),
        F_C_(fields.solution.F_C),
        states_(contact_states(system_.contact, F_C_)),
        error_(fields.error),
        intervals_(fields.intervals),
        side_(boundary_sides(problem_.edges)),
        first_point_(system_.contact.first_points(mesh_.boundary.size())),
        singular_(singular_places(system_, degree_, F_C_)) {}

  PartAnswer answer(const std::optional<DisplacementField>& w) const {
    PartAnswer answer;
    answer.faces = faces();
    answer.supports = supports();
    answer.point_supports = problem_.loads.points;
    if (!problem_.free.motions.empty())
      answer.free_motion = words_of_open_motions(rigid_contact(problem_));
    if (w && answer.free_motion.empty())
      answer.displacement_mm = largest_displacement(with_rigid_motion(problem_, *w));
    const std::vector<LargestStresses> of_bodies = judged_largest_stresses(w);
    answer.stress = largest_of(of_bodies);
    for (std::size_t k = 0; k < of_bodies.size() && of_bodies.size() > 1; ++k)
      if (of_bodies[k].von_mises.triangle >= 0)
        answer.bodies.emplace_back(mesh_.body_names[k], of_bodies[k]);
    answer.unbounded = singular_;
    return answer;
  }

  std::optional<StressDoubt> stress_doubt(const std::optional<DisplacementField>& w) const {
    const LargestStresses judged = largest_of(judged_largest_stresses(w));
    constexpr double rounding = 1e-9;  // von Mises of a hydrostatic stress, which is 0
    StressDoubt doubt;
    const double size_MPa = std::max(judged.von_mises.value, std::abs(judged.principal.value));
    std::array<double, 2> least = {infinity, infinity};  // that may be the largest
    for (const auto& [largest, from] :
         {std::pair(&judged.von_mises, &least[0]), {&judged.principal, &least[1]}})
      if (const double value = std::abs(largest->value);
          largest->off_MPa && value > rounding * size_MPa && !is_at_circle(largest->at_mm)) {
        doubt.relative = std::max(doubt.relative, *largest->off_MPa / value);
        *from = value - *largest->off_MPa;
      }
    if (std::ranges::min(least) == infinity) return {};
    each_sample(stress_, [&](int t, const Eigen::Vector2d&, double of_mises, double principal) {
      if ((of_mises >= least[0] || std::abs(principal) >= least[1]) &&
          (doubt.triangles.empty() || doubt.triangles.back() != t))
        doubt.triangles.push_back(t);
    });
    return doubt;
  }

  std::string faces_csv(const ContactPicture& contact) const {
    std::string text = "face,along_mm,x_mm,y_mm,pressure_MPa,shear_MPa,gap_mm,slip_mm,state\n";
    const int m = system_.contact.components, n = system_.contact.per_edge;
    for (const std::vector<int>& chain : boundary_chains(mesh_, BoundaryRole::contact)) {
      double start = 0;
      for (const int row : chain) {
        const int first = first_point_[static_cast<std::size_t>(row)];
        AlongEdge normal(n), tangential = AlongEdge::Zero(n);
        for (int j = 0; j < n; ++j) {
          normal(j) = F_C_(m * (first + j));
          if (m == 2) tangential(j) = F_C_(m * (first + j) + 1);
        }
        const AlongEdge pressure = pressure_along(problem_, row, normal),
                        shear = -pressure_along(problem_, row, tangential);
        const AlongEdge gap = of_moments(contact.gap_mm, first),
                        slip = of_moments(contact.slip_mm, first);
        const double whole = length(row);
        constexpr int parts = 4;
        for (int i = 0; i <= parts; ++i) {
          const double s = static_cast<double>(i) / parts;
          const Eigen::Vector2d x = at(row, s);
          const auto p = static_cast<std::size_t>(first + std::lround(s * (n - 1)));
          const auto value = [&](const AlongEdge& of) {
            return of.size() == 0 ? std::string() : fmt::format("{}", bernstein_value(of, s));
          };
          text +=
              fmt::format("{},{},{},{},{},{},{},{},{}\n", csv_cell(label(row)), start + s * whole,
                          x.x(), x.y(), bernstein_value(pressure, s), bernstein_value(shear, s),
                          value(gap), value(slip), name_of(contact.state[p]));
        }
        start += whole;
      }
    }
    return text;
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  // Per body, with what is known of them.
  std::vector<LargestStresses> judged_largest_stresses(
      const std::optional<DisplacementField>& w) const {
    std::vector<LargestStresses> judged = largest_stresses(stress_);
    if (w && error_ != nullptr) {
      const std::vector<LargestStresses> of_displacements =
          largest_stresses(stress_of_displacement(problem_, *w));
      // For one unit of energy density: von Mises² ≤ 3 G σ:C:σ, principal² ≤ A_nnnn σ:C:σ.
      const auto estimate = [&](LargestStress& largest, const LargestStress& displaced,
                                int component, double factor) {
        const int t = largest.triangle;
        if (t < 0) return;
        const Eigen::Matrix3d A = elasticity_of(problem_.compliance_of(t));
        largest.off_MPa = twice_estimated_error_MPa(
            problem_, *error_, t, factor * A(component, component),
            std::abs(largest.value) - std::abs(displaced.value), std::abs(largest.value));
      };
      for (std::size_t k = 0; k < judged.size(); ++k) {
        estimate(judged[k].von_mises, of_displacements[k].von_mises, 2, 3);
        estimate(judged[k].principal, of_displacements[k].principal, 0, 1);
      }
    }
    return judged;
  }

  int rows() const { return static_cast<int>(mesh_.boundary.size()); }
  std::string label(int row) const { return boundary_label(mesh_, mesh_.boundary[row]); }

  Eigen::Vector2d at(int row, double s) const { return point_on_edge(problem_, row, degree_, s); }
  double length(int row) const {
    if (!problem_.follows_curve(row, degree_)) return problem_.frame_at(row, 0, 1).length_mm;
    const CurvedSide<double> side({mesh_.boundary[row].curve.points_mm, {}, {}}, degree_);
    double sum = 0;
    for (int q = 0; q < CurvedSide<double>::points; ++q)
      sum += CurvedSide<double>::weight(q) * side.normal(q).norm();
    return sum;
  }
  // The polynomial of degree k whose moments (edge_moment) these are; without coefficients: none.
  AlongEdge of_moments(const std::vector<double>& moments, int first) const {
    if (moments.empty()) return {};
    const int n = system_.contact.per_edge;
    Eigen::MatrixXd of_coefficients(n, n);
    Eigen::VectorXd given(n);
    for (int j = 0; j < n; ++j) {
      given(j) = moments[static_cast<std::size_t>(first + j)];
      for (int i = 0; i < n; ++i) of_coefficients(j, i) = edge_moment(n - 1, j, n - 1, i);
    }
    return of_coefficients.llt().solve(given).transpose();
  }

  // mm in contact and mm that stick, per row of Mesh::boundary.
  std::pair<std::vector<double>, std::vector<double>> zones() const {
    const ContactPoints& contact = system_.contact;
    const int m = contact.components;
    std::pair<std::vector<double>, std::vector<double>> of_rows(mesh_.boundary.size(),
                                                                mesh_.boundary.size());
    for (const std::vector<int>& chain : boundary_chains(mesh_, BoundaryRole::contact)) {
      std::vector<ZoneEdge> closed, stuck;
      for (const int row : chain) {
        closed.push_back({length(row), 0, {}});
        stuck.push_back(closed.back());
        const int first = first_point_[static_cast<std::size_t>(row)];
        for (int p = first; p < first + contact.per_edge; ++p) {
          const ContactState state = states_[static_cast<std::size_t>(p)];
          const double normal_N = std::abs(F_C_(m * p)),
                       tangential_N = m == 2 ? std::abs(F_C_(m * p + 1)) : 0;
          closed.back().force_N += normal_N;
          closed.back().is_inside.push_back(state != ContactState::open);
          stuck.back().force_N += std::max(0., contact.friction_at(p) * normal_N - tangential_N);
          stuck.back().is_inside.push_back(state == ContactState::stick);
        }
      }
      const bool is_loop =
          mesh_.boundary[chain.front()].vertices[0] == mesh_.boundary[chain.back()].vertices[1];
      const auto take = [&](const std::vector<ZoneEdge>& edges, std::vector<double>& lengths) {
        const std::vector<double> of_chain = zone_lengths_mm(edges, is_loop);
        for (std::size_t k = 0; k < chain.size(); ++k) lengths[chain[k]] = of_chain[k];
      };
      take(closed, of_rows.first);
      take(stuck, of_rows.second);
    }
    return of_rows;
  }

  // ∫ σn.
  Eigen::Vector2d force_on(int row) const {
    const auto [t, k] = side_[static_cast<std::size_t>(row)];
    const TriangleVertices v = problem_.vertices_of(t);
    const auto of_triangle = stress_[static_cast<std::size_t>(t)];
    const ForcesOnEdge forces =
        problem_.follows_curve(row, degree_)
            ? curved_edge_forces(v, of_triangle, k, {mesh_.boundary[row].curve.points_mm, {}, {}})
            : element_edge_forces(v, of_triangle, k);
    return forces * Eigen::VectorXd::Ones(forces.cols());
  }

  std::vector<FaceAnswer> faces() const {
    const int m = system_.contact.components, n = system_.contact.per_edge;
    const auto [closed_mm, stuck_mm] = zones();
    std::vector<FaceAnswer> answers;
    for (const ContactFace& face : contact_faces(problem_)) {
      FaceAnswer answer;
      answer.labels = face.labels;
      for (const int row : face.rows) {
        const int first = first_point_[static_cast<std::size_t>(row)];
        for (int p = first; p < first + n; ++p) {
          answer.normal_N += F_C_(m * p);
          if (m == 2) answer.tangential_N += F_C_(m * p + 1);
        }
        answer.closed_mm += closed_mm[row];
        answer.slipping_mm += closed_mm[row] - stuck_mm[row];
        answer.length_mm += length(row);
        answer.force_N += force_on(row);
      }
      answer.slipping_mm = std::max(0., answer.slipping_mm);
      const LargestPressure largest =
          largest_pressure(problem_, stress_, is_on_face(problem_, face), side_);
      answer.pressure_MPa = {largest.pressure_MPa, largest.at_mm};
      if (intervals_ != nullptr) answer.within = intervals_->faces[answers.size()];
      answers.push_back(std::move(answer));
    }
    return answers;
  }

  std::vector<SupportAnswer> supports() const {
    std::map<std::string, Eigen::Vector2d> forces;
    for (int row = 0; row < rows(); ++row)
      if (mesh_.boundary[row].role == BoundaryRole::displacement)
        forces.emplace(label(row), Eigen::Vector2d::Zero()).first->second += force_on(row);
    std::vector<SupportAnswer> list;
    for (const auto& [name, force] : forces) list.push_back({name, force});
    return list;
  }

  // At vertices and middles of edges.
  ValueAt largest_displacement(const DisplacementField& u) const {
    ValueAt largest;
    for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t) {
      const TriangleVertices v = problem_.vertices_of(t);
      for (int k = 0; k < 6; ++k) {
        const Eigen::Vector3d start = Eigen::Vector3d::Unit(k % 3),
                              end = k < 3 ? start : Eigen::Vector3d::Unit((k + 1) % 3);
        const Eigen::Vector3d lambda = (start + end) / 2;
        if (const double size = displacement_at(problem_, u, t, lambda).norm();
            size > largest.value)
          largest = {size, v * lambda};
      }
    }
    return largest;
  }

  // visit(triangle, x, von Mises, the principal stress of larger magnitude), away from singular
  // places.
  template <typename Visit>
  void each_sample(const StressField& stress, const Visit& visit) const {
    const StressSamples samples(problem_, stress, 6);
    for (int t = 0; t < static_cast<int>(stress.size()); ++t) {
      const std::vector<const SingularPlace*> near = places_near(t);
      for (int k = 0; k < 3; ++k) {
        const StressSamples::Third third = samples.third(t, k);
        for (Eigen::Index i = 0; i < third.at_mm.cols(); ++i) {
          if (std::ranges::any_of(near, [&](const SingularPlace* place) {
                return (place->at_mm - third.at_mm.col(i)).norm() < place->within_mm;
              }))
            continue;
          const Eigen::Vector3d s = third.stress.col(i);
          const Eigen::Vector2d principal = principal_stresses(s);
          const Eigen::Vector2d x = third.at_mm.col(i);
          visit(t, x, von_mises(problem_, t, x, s),
                std::abs(principal(0)) >= std::abs(principal(1)) ? principal(0) : principal(1));
        }
      }
    }
  }

  // Per body.
  std::vector<LargestStresses> largest_stresses(const StressField& stress) const {
    std::vector<LargestStresses> bodies(mesh_.body_names.size());
    const auto take = [](LargestStress& largest, double value, const Eigen::Vector2d& x, int t) {
      if (std::abs(value) > std::abs(largest.value)) largest = {{value, x}, t, {}};
    };
    each_sample(stress, [&](int t, const Eigen::Vector2d& x, double of_mises, double principal) {
      LargestStresses& own = bodies[static_cast<std::size_t>(mesh_.triangle_body[t])];
      take(own.von_mises, of_mises, x, t);
      take(own.principal, principal, x, t);
    });
    return bodies;
  }
  static LargestStresses largest_of(const std::vector<LargestStresses>& bodies) {
    LargestStresses all;
    for (const LargestStresses& own : bodies)
      for (const auto of : {&LargestStresses::von_mises, &LargestStresses::principal})
        if (std::abs((own.*of).value) > std::abs((all.*of).value)) all.*of = own.*of;
    return all;
  }

  // Where a stress that falls from a singular place on is largest.
  bool is_at_circle(const Eigen::Vector2d& x) const {
    return std::ranges::any_of(singular_, [&](const SingularPlace& place) {
      return (place.at_mm - x).norm() < 2 * place.within_mm;
    });
  }
  std::vector<const SingularPlace*> places_near(int triangle) const {
    const TriangleVertices v = problem_.vertices_of(triangle);
    const Eigen::Vector2d centroid = v.rowwise().mean();
    const double radius =
        1.5 * (v.colwise() - centroid).colwise().norm().maxCoeff();  // with curves
    std::vector<const SingularPlace*> near;
    for (const SingularPlace& place : singular_)
      if ((place.at_mm - centroid).norm() < place.within_mm + radius) near.push_back(&place);
    return near;
  }

  const ContactSystem& system_;
  const Problem& problem_;
  const Mesh& mesh_;
  const StressField& stress_;
  int degree_;
  const Eigen::VectorXd& F_C_;
  std::vector<ContactState> states_;
  const ConstitutiveError* error_;
  const ContactIntervals* intervals_;
  std::vector<TriangleSide> side_;  // per row of Mesh::boundary
  std::vector<int> first_point_;    // the same
  std::vector<SingularPlace> singular_;
};

Json point(const Eigen::Vector2d& x) { return Json::array({x.x(), x.y()}); }
Json to_json(const ValueAt& value) {
  return {{"value", value.value}, {"at_mm", point(value.at_mm)}};
}
Json to_json(const LargestStress& largest) {
  Json json = to_json(static_cast<const ValueAt&>(largest));
  if (largest.off_MPa) json["off"] = *largest.off_MPa;
  return json;
}
Json to_json(const PointSupport& support) {
  const auto& [ux_mm, uy_mm] = support.displacement_mm;
  return {{"at_mm", point(support.at_mm)},
          {"displacement_mm", Json::array({or_null(ux_mm), or_null(uy_mm)})}};
}
Json to_json(const FaceAnswer& face) {
  Json json = {{"name", face_name(face.labels)},
               {"labels", face.labels},
               {"force_N", point(face.force_N)},
               {"normal_N", face.normal_N},
               {"tangential_N", face.tangential_N},
               {"length_mm", face.length_mm},
               {"closed_mm", face.closed_mm},
               {"slipping_mm", face.slipping_mm},
               {"pressure_MPa", to_json(face.pressure_MPa)}};
  if (!face.within) return json;
  const auto add = [](Json& of, const char* name, const std::optional<Bracket>& interval) {
    if (interval) of[name] = Json::array({interval->low, interval->high});
  };
  add(json, "normal_in_N", face.within->normal_resultant_N);
  add(json, "tangential_in_N", face.within->tangential_resultant_N);
  json["pressure_MPa"]["is"] = name_of(face.within->peak);
  add(json["pressure_MPa"], "in", face.within->largest_pressure_within_MPa);
  return json;
}

}  // namespace

PartFiles part_files(const SolvedFields& fields, const ContactPicture& contact) {
  const PartReader part(fields);
  return {part.answer(fields.w), part.faces_csv(contact)};
}

std::optional<StressDoubt> stress_doubt(const SolvedFields& fields) {
  return PartReader(fields).stress_doubt(fields.w);
}

double stress_zz(const Problem& problem, int triangle, const Eigen::Vector2d& x,
                 const Eigen::Vector3d& stress) {
  const std::vector<double>& poisson = problem.poisson_zz;
  double zz = 0;
  if (!poisson.empty())
    zz += poisson[problem.mesh.triangle_body[triangle]] * stress.head<2>().sum();
  if (problem.is_warm(triangle))
    zz -= problem.thermal_strain(triangle).modulus_zz_MPa * problem.thermal_strain(triangle).at(x);
  return zz;
}
double von_mises(const Problem& problem, int triangle, const Eigen::Vector2d& x,
                 const Eigen::Vector3d& stress) {
  return von_mises(stress, stress_zz(problem, triangle, x, stress));
}
double von_mises(const Eigen::Vector3d& s, double zz) {
  return std::sqrt(
      ((s(0) - s(1)) * (s(0) - s(1)) + (s(1) - zz) * (s(1) - zz) + (zz - s(0)) * (zz - s(0))) / 2 +
      3 * s(2) * s(2));
}

Eigen::Vector2d principal_stresses(const Eigen::Vector3d& s) {
  const double middle = (s(0) + s(1)) / 2, radius = std::hypot((s(0) - s(1)) / 2, s(2));
  return {middle + radius, middle - radius};
}

Json to_json(const PartAnswer& answer) {
  Json json = {
      {"faces", Json::array()}, {"supports", Json::array()}, {"point_supports", Json::array()}};
  for (const FaceAnswer& face : answer.faces) json["faces"].push_back(to_json(face));
  for (const SupportAnswer& support : answer.supports)
    json["supports"].push_back({{"name", support.name}, {"force_N", point(support.force_N)}});
  for (const PointSupport& support : answer.point_supports)
    json["point_supports"].push_back(to_json(support));
  if (answer.displacement_mm) json["displacement_mm"] = to_json(*answer.displacement_mm);
  if (!answer.free_motion.empty()) json["free_motion"] = answer.free_motion;
  const auto add_stresses = [](const LargestStresses& stress, Json& to) {
    to["von_mises_MPa"] = to_json(stress.von_mises);
    to["principal_MPa"] = to_json(stress.principal);
  };
  add_stresses(answer.stress, json);
  json["bodies"] = Json::array();
  for (const auto& [name, stress] : answer.bodies)
    add_stresses(stress, json["bodies"].emplace_back(Json{{"name", name}}));
  json["unbounded"] = Json::array();
  for (const SingularPlace& place : answer.unbounded)
    json["unbounded"].push_back(
        {{"what", place.what}, {"at_mm", point(place.at_mm)}, {"within_mm", place.within_mm}});
  return json;
}

}  // namespace airybench
