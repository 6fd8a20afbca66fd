#include "bench/problems/problem_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "bench/problems/matrix_market.hpp"
#include "bench/problems/problem_arrays.hpp"
#include "bench/records/json.hpp"
#include "support/errors.hpp"
#include "support/shortened.hpp"
#ifdef AIRYBENCH_HAS_LIBZIP
#include "bench/problems/numpy_files.hpp"
#endif
#ifdef AIRYBENCH_HAS_HDF5
#include "bench/problems/fclib_file.hpp"
#endif

namespace airybench {
namespace {

struct Exported {
  std::string title;  // "Mesh0/default"
  std::vector<ProblemArray> arrays;
  std::vector<ProblemArray> of_condensed;
  std::optional<CondensedProblem> condensed;
};

// Adds files; returns per array, in their order, the file that has it; empty: none, it has no rows,
// which some readers of Matrix Market files refuse.
using Writer = std::vector<std::string> (*)(const Exported& problem, Files& files);

std::vector<std::string> write_matrix_market(const Exported& problem, Files& files) {
  std::vector<std::string> places;
  for (const ProblemArray& array : problem.arrays) {
    places.push_back(array.rows() > 0 ? array.name + ".mtx" : "");
    if (array.rows() > 0) files[places.back()] = matrix_market_text(array);
  }
  return places;
}

#ifdef AIRYBENCH_HAS_LIBZIP
std::vector<std::string> write_npz(const Exported& problem, Files& files) {
  std::vector<std::string> places;
  std::vector<const ProblemArray*> dense;
  for (const ProblemArray& array : problem.arrays)
    if (const auto* sparse = std::get_if<SparseRows>(&array.values)) {
      places.push_back(array.name + ".npz");
      files[places.back()] = npz_of_sparse(*sparse);
    } else {
      places.emplace_back("problem.npz");
      dense.push_back(&array);
    }
  files["problem.npz"] = npz_of_arrays(dense);
  return places;
}
#endif

#ifdef AIRYBENCH_HAS_HDF5
std::vector<std::string> write_fclib(const Exported& problem, Files& files) {
  files["problem.hdf5"] = fclib_file(*problem.condensed, problem.of_condensed, problem.title);
  std::vector<std::string> places;
  for (const ProblemArray& array : problem.arrays)
    places.push_back(array.name == "D" ? "problem.hdf5:/fclib_local/W"
                                       : "problem.hdf5:/airybench/" + array.name);
  return places;
}
#endif

// The writer of a format; null: this build is without it.
Writer writer_of(std::string_view format) {
  if (format == "matrix-market") return write_matrix_market;
#ifdef AIRYBENCH_HAS_LIBZIP
  if (format == "npz") return write_npz;
#endif
#ifdef AIRYBENCH_HAS_HDF5
  if (format == "fclib") return write_fclib;
#endif
  return nullptr;
}

Json shape_of(const ProblemArray& array) {
  return array.is_vector() ? Json{array.rows()} : Json{array.rows(), array.columns()};
}

Json descriptions(const std::vector<ProblemArray>& arrays, const std::vector<std::string>& places) {
  Json all = Json::array();
  for (std::size_t i = 0; i < arrays.size(); ++i)
    all.push_back({{"name", arrays[i].name},
                   {"file", places[i].empty() ? Json() : Json(places[i])},
                   {"shape", shape_of(arrays[i])},
                   {"symmetric", arrays[i].symmetric},
                   {"unit", arrays[i].unit},
                   {"about", arrays[i].about}});
  return all;
}

Json equations(bool airy, const Exported& problem, bool fclib) {
  Json all = Json::array();
  if (airy && problem.condensed)
    all = {"S x + C_F' lambda + C_C' lambda' = q", "C_F x = F", "F_C = C_C x + F0",
           "lambda' = -u_C"};
  else if (airy)
    all = {"S x + C_F' lambda = q", "C_F x = F"};
  if (!problem.condensed) return all;
  all.push_back("u_C = D F_C - G");
  all.push_back("r = u_C - gap");
  all.push_back("F_n <= 0, r_n <= 0, F_n r_n = 0");
  if (problem.condensed->contact.components == 2)
    all.push_back("|F_t| <= -mu F_n, F_t r_t <= 0, r_t = 0 unless |F_t| = -mu F_n");
  if (fclib)
    for (const char* line : {"FCLIB: W = s D, q = s (G + gap), s = 1/mean diag D = scale_N_per_mm",
                             "FCLIB: r = -F_C, u = -s (u_C - gap), u = W r + q"})
      all.push_back(line);
  return all;
}

}  // namespace

void check_problem_format(const std::string& format) {
  std::vector<std::string_view> valid;
  for (const std::string_view name : all_problem_formats)
    if (writer_of(name)) valid.push_back(name);
  if (writer_of(format)) return;
  const bool known = std::ranges::find(all_problem_formats, format) != all_problem_formats.end();
  throw UsageError(fmt::format(
      "--format: {}{} (valid: {})", shortened(format),
      known ? fmt::format(": this build is without {}", format == "npz" ? "libzip" : "HDF5") : "",
      fmt::join(valid, ", ")));
}

ProblemFiles problem_files(const PosedScene& posed, const std::string& format) {
  const Problem& problem = *posed.problem;
  const bool fclib = format == "fclib";
  const std::string why_no_airy = why_no_blocks(problem.mesh, Blocks::airy);
  const bool airy = !fclib && why_no_airy.empty();
  const bool contact = std::ranges::any_of(problem.mesh.boundary, [](const BoundaryEdge& edge) {
    return edge.role == BoundaryRole::contact;
  });

  ProblemFiles result;
  Exported exported{problem.mesh.name + "/" + posed.scene_name, mesh_arrays(problem.mesh), {}, {}};
  const auto append = [&](std::vector<ProblemArray> more) {
    std::ranges::move(more, std::back_inserter(exported.arrays));
  };
  if (airy) append(airy_arrays(assemble(posed.problem)));
  if (contact || !airy) {
    exported.condensed = condensed_problem(posed);
    exported.of_condensed = condensed_arrays(problem, *exported.condensed);
    if (fclib)
      exported.arrays = exported.of_condensed;
    else
      append(exported.of_condensed);
  }
  if (!fclib && !airy) result.notes.push_back("only the condensed problem: " + why_no_airy);
  if (!contact) result.notes.emplace_back("only the Airy system: there is no contact");
  if (!problem.later_steps.empty())
    result.notes.push_back(
        fmt::format("only the first of {} load steps: the others depend on its solution",
                    problem.later_steps.size() + 1));

  const std::vector<std::string> places = writer_of(format)(exported, result.files);
  Json description = {{"mesh", problem.mesh.name},
                      {"mesh_sha256", posed.mesh_sha256},
                      {"scene", posed.scene_name},
                      {"scene_definition", parse_json(posed.scene_definition)},
                      {"notes", result.notes},
                      {"units", "mm, N, MPa; thickness 1 mm"},
                      {"indices", "from 0"},
                      {"signs",
                       "F_C forces on the body, u_C and gap displacements along the same "
                       "directions; normals outward, n = (s_y, -s_x) of the tangent s"},
                      {"equations", equations(airy, exported, fclib)}};
  if (exported.condensed) {
    const ContactPoints& points = exported.condensed->contact;
    description["contact_points"] = points.count;
    description["components"] = points.components;
    description["order"] = points.components == 2 ? "per contact point normal, tangential"
                                                  : "per contact point normal; no friction";
    description["F_C_error_estimate"] = exported.condensed->reference.error_estimate;
    description["F_C_natural_map_residual"] = exported.condensed->reference.natural_map_residual;
  }
  description["arrays"] = descriptions(exported.arrays, places);
  result.files["problem.json"] = indented_json_text(description, 1) + "\n";
  return result;
}

}  // namespace airybench
