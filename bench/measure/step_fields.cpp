#include "bench/measure/step_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <tuple>

#include "assembly/total_displacement.hpp"
#include "support/atomic_file.hpp"

namespace airybench {
namespace {

namespace fs = std::filesystem;

constexpr auto series_ends = {".pvd", ".contact.pvd", ".steps.csv"};

constexpr std::size_t kinds_of_loads = 6;
using LoadsOfSteps = std::array<Eigen::MatrixXd, kinds_of_loads>;

// A column per step: displacements of Γ_D, of rollers their normal part, tractions of Γ_F, gaps of
// Γ_C, at the ends of their edges, the body force, which edges are Γ_D, and the thermal strain of
// each body.
LoadsOfSteps loads_of_steps(const Problem& first) {
  const Mesh& mesh = first.mesh;
  LoadsOfSteps all;
  const auto ends = 4 * static_cast<Eigen::Index>(mesh.boundary.size());
  for (Eigen::MatrixXd& kind : all) kind.setZero(ends, count_of_steps(first));
  all[5].setZero(3 * std::ssize(first.compliance), count_of_steps(first));
  const auto take = [&](const Loads& loads, const RigidMotion& motion, int step) {
    all[3].col(step).head<2>() = loads.body_force_N_per_mm3;
    for (Eigen::Index body = 0; body < std::ssize(loads.thermal); ++body)
      all[5].col(step).segment<3>(3 * body) << loads.thermal[body].at_origin,
          loads.thermal[body].slope_per_mm;
    const auto rolls = [&](int row) { return !loads.rollers.empty() && loads.rollers[row]; };
    for (Eigen::Index at = 0; at < ends; at += 2) {
      const int row = static_cast<int>(at / 4);
      const BoundaryRole role = loads.roles.empty() ? mesh.boundary[row].role : loads.roles[row];
      const auto [start, end] = mesh.boundary[row].vertices;
      const Eigen::Vector2d &a = mesh.vertices[start], &b = mesh.vertices[end];
      const Eigen::Vector2d& x = at % 4 == 0 ? a : b;
      if (role == BoundaryRole::displacement) {
        Eigen::Vector2d u = motion.at(x);
        if (loads.displacement_mm) u += loads.displacement_mm(x, row);
        const Eigen::Vector2d normal = edge_frame(a, b).normal;
        all[0].col(step).segment<2>(at) = rolls(row) ? normal.dot(u) * normal : u;
        all[4].col(step).segment<2>(at).setConstant(rolls(row) ? 1 : 2);
      } else if (role == BoundaryRole::force && loads.traction_MPa) {
        all[1].col(step).segment<2>(at) = loads.traction_MPa(x, edge_frame(a, b).normal, row);
      } else if (role == BoundaryRole::contact && loads.gap_mm) {
        all[2](at, step) = loads.gap_mm(x, row);
      }
    }
  };
  take(first.loads, first.motion, 0);
  for (int step = 1; step < count_of_steps(first); ++step)
    take(first.later_steps[step - 1], {}, step);
  return all;
}

constexpr double rounding = 1e-9;  // of the largest of a kind of loads

// Per step the first one, from 0, with its loads; roundings aside.
std::vector<int> first_with_loads(const LoadsOfSteps& loads) {
  std::array<double, kinds_of_loads> allowed = {};
  for (std::size_t kind = 0; kind < kinds_of_loads; ++kind)
    allowed[kind] = rounding * loads[kind].lpNorm<Eigen::Infinity>();
  std::vector<int> first;
  for (int step = 0; step < loads[0].cols(); ++step) {
    const auto is_like = [&](int other) {
      for (std::size_t kind = 0; kind < kinds_of_loads; ++kind)
        if (!((loads[kind].col(step) - loads[kind].col(other)).lpNorm<Eigen::Infinity>() <=
              allowed[kind]))
          return false;
      return true;
    };
    int like = 0;
    while (like < step && !(first[like] == like && is_like(like))) ++like;
    first.push_back(like);
  }
  return first;
}

// The piece that the path moves (see step_fields.hpp), and its rows that are held and loaded.
std::tuple<int, std::vector<int>, std::vector<int>> moved_piece(const Mesh& mesh,
                                                                const LoadsOfSteps& loads) {
  const auto rows_where = [&](const auto& is_chosen) {
    std::vector<int> rows;
    for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row)
      if (is_chosen(row)) rows.push_back(row);
    return rows;
  };
  const auto rows_with = [&](BoundaryRole role) {
    return rows_where([&](int row) { return mesh.boundary[row].role == role; });
  };
  const auto largest = [](const Eigen::MatrixXd& kind, int row) {
    return kind.middleRows<4>(4 * Eigen::Index{row}).lpNorm<Eigen::Infinity>();
  };
  const auto rows_under = [&](const Eigen::MatrixXd& kind) {
    const double least = rounding * kind.lpNorm<Eigen::Infinity>();
    return rows_where([&](int row) { return largest(kind, row) > least; });
  };
  std::vector<int> held = rows_under(loads[0]), loaded = rows_under(loads[1]);
  std::ranges::stable_sort(held, std::ranges::greater(),
                           [&](int row) { return largest(loads[0], row); });
  const MeshPieces pieces = pieces_of(mesh);
  const auto piece_of = [&](int row) { return pieces.of_vertex[mesh.boundary[row].vertices[0]]; };
  const std::vector<int> touching = rows_with(BoundaryRole::contact);
  const auto touches = [&](int row) {
    return std::ranges::find(touching, piece_of(row), piece_of) != touching.end();
  };
  int piece = 0;
  for (const auto& rows : {touching, loaded, held})
    if (const auto row = std::ranges::find_if(rows, touches); row != rows.end())
      piece = piece_of(*row);
  if (held.empty()) held = rows_with(BoundaryRole::displacement);
  for (std::vector<int>* rows : {&held, &loaded})
    std::erase_if(*rows, [&](int row) { return piece_of(row) != piece; });
  return {piece, held, loaded};
}

// "x,y", or "," if unknown.
std::string mean_on(const std::vector<int>& rows, const Problem& problem,
                    const std::optional<DisplacementField>& w) {
  if (!w || rows.empty()) return ",";
  const DisplacementField u = with_rigid_motion(problem, *w);
  Eigen::Vector2d sum(0, 0);
  double length_mm = 0;
  for (const int row : rows) {
    const auto [start, end] = problem.mesh.boundary[row].vertices;
    const double length = (problem.mesh.vertices[end] - problem.mesh.vertices[start]).norm();
    length_mm += length;
    sum += length * mean_on_edge(problem, u, row);
  }
  return fmt::format("{},{}", sum.x() / length_mm, sum.y() / length_mm);
}

std::string xml_escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text)
    if (std::string_view("&<>\"'").find(c) == std::string_view::npos)
      escaped += c;
    else
      escaped += fmt::format("&#{};", static_cast<int>(c));
  return escaped;
}

std::string pvd_text(const std::string& data_sets) {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n" +
         data_sets + "</Collection>\n</VTKFile>\n";
}

template <typename Value>
std::string or_empty(const std::optional<Value>& value) {
  return value ? fmt::format("{}", *value) : std::string();
}

}  // namespace

bool keeps_body(int step, int count) {
  if (count <= max_step_bodies) return true;
  return (step + 1) * max_step_bodies / count != step * max_step_bodies / count;
}

void remove_fields(const fs::path& folder, const std::string& name) {
  remove_files_of_fields(folder, name);
  remove_step_fields(folder, name);
}

void remove_step_fields(const fs::path& folder, const std::string& name) {
  std::error_code error;  // what cannot be removed cannot be replaced: that is said then
  for (const char* end : series_ends) fs::remove(folder / (name + end), error);
  const fs::path steps = folder / (name + ".steps");
  std::vector<fs::path> found;
  for (fs::directory_iterator at(steps, error), none; !error && at != none; at.increment(error)) {
    const std::string file = at->path().filename().string();
    const std::size_t digits = std::min(file.find_first_not_of("0123456789"), file.size());
    if (digits >= 4 && digits < file.size() && file[digits] == '.') found.push_back(at->path());
  }
  for (const fs::path& file : found) fs::remove(file, error);
  fs::remove(steps, error);  // if it is empty
}

StepFields::StepFields(fs::path folder, std::string name, const Problem& first)
    : folder_(std::move(folder)),
      name_(std::move(name)),
      count_(count_of_steps(first)),
      table_(
          "step,normal_resultant_N,tangential_resultant_N,dissipation_Nmm,n_open,n_stick,n_slip,"
          "held_x_mm,held_y_mm,loaded_x_mm,loaded_y_mm,piece,same_loads_as,fields\n") {
  remove_step_fields(folder_, name_);
  const LoadsOfSteps loads = loads_of_steps(first);
  first_with_loads_ = first_with_loads(loads);
  std::tie(piece_, held_, loaded_) = moved_piece(first.mesh, loads);
}

std::string StepFields::write(int step, const SolvedFields& fields, const JudgedStep& judged) {
  const bool has_body = keeps_body(step, count_);
  const std::string number = fmt::format("{:04}", step + 1), word = has_body ? "body" : "contact";
  write_fields(folder_ / (name_ + ".steps"), number, fields,
               has_body ? FieldParts::all : FieldParts::contact);
  const auto data_set = [&](const char* end) {
    return fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}.steps/{}{}\"/>\n", step + 1,
                       xml_escaped(name_), number, end);
  };
  if (has_body) series_ += data_set(".vtu");
  contact_series_ += data_set(".contact.vtu");
  const Problem& problem = *fields.system.problem;
  const Verification& v = judged.seen();
  table_ += fmt::format(
      "{},{},{},{},{},{},{},{},{},{},{},{}\n", step + 1, or_empty(v.normal_resultant_N),
      or_empty(v.tangential_resultant_N), judged.dissipation_Nmm, or_empty(v.n_open),
      or_empty(v.n_stick), or_empty(v.n_slip), mean_on(held_, problem, fields.w),
      mean_on(loaded_, problem, fields.w), piece_ + 1, first_with_loads_[step] + 1, word);
  write_file_atomically(folder_ / (name_ + ".pvd"), pvd_text(series_));
  write_file_atomically(folder_ / (name_ + ".contact.pvd"), pvd_text(contact_series_));
  write_file_atomically(folder_ / (name_ + ".steps.csv"), table_);
  return word;
}

}  // namespace airybench
