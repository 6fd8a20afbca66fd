#include "bench/problems/problem_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <optional>

#include "bench/problems/problem_arrays.hpp"
#include "bench/problems/siconos_text.hpp"
#include "bench/records/json.hpp"
#include "solvers/contact/paired_points.hpp"
#include "support/errors.hpp"
#include "support/shortened.hpp"
#include "verify/reference.hpp"
#ifdef AIRYBENCH_HAS_LIBZIP
#include "bench/problems/numpy_files.hpp"
#endif
#ifdef AIRYBENCH_HAS_HDF5
#include "bench/problems/fclib.hpp"
#endif

namespace airybench {
namespace {

// The Matrix Market exchange format, https://math.nist.gov/MatrixMarket/formats.html: numbers read
// back to the last bit.
using Text = std::back_insert_iterator<std::string>;

template <typename Scalar>
void write_values(const Eigen::MatrixX<Scalar>& matrix, bool symmetric, Text out) {
  fmt::format_to(out, "{} {}\n", matrix.rows(), matrix.cols());
  for (Eigen::Index j = 0; j < matrix.cols(); ++j)
    for (Eigen::Index i = symmetric ? j : 0; i < matrix.rows(); ++i)
      fmt::format_to(out, "{}\n", matrix(i, j));
}

template <typename Visit>
void for_each_entry(const SparseRows& matrix, bool symmetric, Visit visit) {
  for (Eigen::Index i = 0; i < matrix.outerSize(); ++i)
    for (SparseRows::InnerIterator entry(matrix, i); entry; ++entry)
      if (!symmetric || entry.col() <= entry.row()) visit(entry);
}

void write_values(const SparseRows& matrix, bool symmetric, Text out) {
  Eigen::Index count = 0;
  for_each_entry(matrix, symmetric, [&](const auto&) { ++count; });
  fmt::format_to(out, "{} {} {}\n", matrix.rows(), matrix.cols(), count);
  for_each_entry(matrix, symmetric, [&](const auto& entry) {
    fmt::format_to(out, "{} {} {}\n", entry.row() + 1, entry.col() + 1, entry.value());
  });
}

std::string matrix_market_text(const ProblemArray& array) {
  const bool sparse = std::holds_alternative<SparseRows>(array.values);
  const bool whole_numbers = std::holds_alternative<Eigen::MatrixXi>(array.values);
  std::string text =
      fmt::format("%%MatrixMarket matrix {} {} {}\n% {}: {}\n% unit: {}\n",
                  sparse ? "coordinate" : "array", whole_numbers ? "integer" : "real",
                  array.symmetric ? "symmetric" : "general", array.name, array.about, array.unit);
  std::visit(
      [&](const auto& matrix) { write_values(matrix, array.symmetric, std::back_inserter(text)); },
      array.values);
  return text;
}

struct Exported {
  std::string title;  // "Mesh0/default"
  std::vector<ProblemArray> arrays = {};
  const contact::Problem* condensed = nullptr;  // may be null
  Eigen::VectorXd answer = {};                  // F_C to compare with; may be empty
  std::vector<ProblemArray> of_condensed = {};  // also in `arrays`
  bool airy = false;                            // `arrays` has the Airy system

  void append(std::vector<ProblemArray> more) {
    std::ranges::move(more, std::back_inserter(arrays));
  }
  void append_condensed(const contact::Problem& problem, const Problem* body) {
    condensed = &problem;
    of_condensed = contact_arrays(problem, answer);
    if (body != nullptr)
      std::ranges::move(contact_place_arrays(*body, problem.points),
                        std::back_inserter(of_condensed));
    append(of_condensed);
  }
};

// Adds files and returns the file of each array. Empty: the array has no rows and thus no file,
// since some readers of Matrix Market files refuse it.
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
  files["problem.hdf5"] =
      fclib_file(*problem.condensed, problem.answer, problem.of_condensed, problem.title);
  std::vector<std::string> places;
  for (const ProblemArray& array : problem.of_condensed)
    places.push_back(array.name == "D" ? "problem.hdf5:/fclib_local/W"
                                       : "problem.hdf5:/airybench/" + array.name);
  return places;
}
#endif

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

Json equations(const Exported& problem, bool fclib) {
  Json all = Json::array();
  if (problem.airy && problem.condensed)
    all = {"S x + C_F' lambda + C_C' lambda' = q", "C_F x = F", "F_C = C_C x + F0",
           "lambda' = -u_C"};
  else if (problem.airy)
    all = {"S x + C_F' lambda = q", "C_F x = F"};
  if (!problem.condensed) return all;
  all.push_back("u_C = D F_C - G");
  all.push_back("r = u_C - gap");
  all.push_back("F_n <= 0, r_n <= 0, F_n r_n = 0");
  if (problem.condensed->points.components > 1)
    all.push_back("|F_t| <= -mu F_n, F_t . r_t <= 0, r_t along F_t, 0 unless |F_t| = -mu F_n");
  if (fclib)
    for (const char* line : {"FCLIB: W = s D, q = s (G + gap), s = 1/mean diag D = scale_N_per_mm",
                             "FCLIB: r = -F_C, u = -s (u_C - gap), u = W r + q"})
      all.push_back(line);
  return all;
}

Files write(const Exported& exported, const std::string& format, Json description) {
  Files files;
  const std::vector<std::string> places = writer_of(format)(exported, files);
  const bool fclib = format == "fclib";
  description["units"] = "mm, N, MPa; thickness 1 mm";
  description["indices"] = "from 0";
  description["signs"] =
      "F_C forces on the body, u_C and gap displacements along the same directions; normals "
      "outward, n = (s_y, -s_x) of the tangent s";
  description["equations"] = equations(exported, fclib);
  if (exported.condensed) {
    const ContactPoints& points = exported.condensed->points;
    description["contact_points"] = points.count;
    description["components"] = points.components;
    constexpr std::array orders = {"per contact point normal; no friction",
                                   "per contact point normal, tangential",
                                   "per contact point normal, two tangential"};
    description["order"] = orders.at(static_cast<std::size_t>(points.components - 1));
  }
  description["arrays"] = descriptions(fclib ? exported.of_condensed : exported.arrays, places);
  files["problem.json"] = indented_json_text(description, 1) + "\n";
  return files;
}

// Throws InputError if there is no reference.
Reference reference_of(const ContactSystem& points, const std::string& title) {
  if (points.contact.count == 0)
    throw InputError(title + ": no contact points (allowed: a scene with contact)");
  try {
    return compute_reference(points);
  } catch (const Breakdown& breakdown) {
    throw InputError(fmt::format("{}: {}", title, breakdown.what()));
  }
}

}  // namespace

std::vector<std::string_view> problem_formats() {
  std::vector<std::string_view> valid;
  for (const std::string_view name : all_problem_formats)
    if (writer_of(name)) valid.push_back(name);
  return valid;
}

void check_problem_format(const std::string& format) {
  if (writer_of(format)) return;
  const bool known = std::ranges::find(all_problem_formats, format) != all_problem_formats.end();
  throw UsageError(fmt::format(
      "--format: {}{} (valid: {})", shortened(format),
      known ? fmt::format(": this build is without {}", format == "npz" ? "libzip" : "HDF5") : "",
      fmt::join(problem_formats(), ", ")));
}

ProblemFiles problem_files(const PosedScene& posed, const std::string& format) {
  const Problem& problem = *posed.body();
  if (!problem.free.motions.empty())
    throw UsageError(fmt::format(
        "{}: a body that contact alone holds has no D to export (allowed: bodies that displacement "
        "edges hold)",
        problem.mesh.name));
  const bool fclib = format == "fclib";
  const std::string why_no_airy = why_no_airy_function(problem);
  const bool contact = std::ranges::any_of(problem.mesh.boundary, [](const BoundaryEdge& edge) {
    return edge.role == BoundaryRole::contact;
  });

  ProblemFiles result;
  Exported exported{problem.mesh.name + "/" + posed.scene_name, mesh_arrays(problem.mesh)};
  exported.append(body_arrays(problem));
  const bool joins_bodies = !problem.opposite.empty();
  exported.airy = !fclib && why_no_airy.empty() && !joins_bodies;
  if (exported.airy) exported.append(airy_arrays(airy_system(posed.body())));
  Json answer = Json::object();
  Reference reference;
  if (contact || fclib) {
    const ContactSystem points = contact_system(posed.body());
    reference = reference_of(points, exported.title);
    answer = {{"F_C_error_estimate", reference.error_estimate},
              {"F_C_natural_map_residual", reference.natural_map_residual}};
    exported.answer = of_first(points.contact, reference.F_C);
    reference.condensed = joined(reference.condensed);  // exported refers to it
    exported.append_condensed(reference.condensed, &problem);
  }
  if (!fclib && !exported.airy)
    result.notes.push_back(
        joins_bodies ? "only the bodies and the condensed problem: they press on each other"
        : contact    ? "only the body and the condensed problem: " + why_no_airy
                     : "only the body: " + why_no_airy);
  if (!contact) result.notes.emplace_back("no condensed problem: there is no contact");
  if (!problem.later_steps.empty())
    result.notes.push_back(
        fmt::format("only the first of {} load steps: the others depend on its solution",
                    problem.later_steps.size() + 1));
  Json description = {{"mesh", problem.mesh.name},
                      {"mesh_sha256", posed.mesh_sha256},
                      {"scene", posed.scene_name},
                      {"scene_definition", parse_json(posed.scene_definition)},
                      {"notes", result.notes}};
  description.update(answer);
  result.files = write(exported, format, std::move(description));
  return result;
}

contact::Problem read_contact_problem(const std::filesystem::path& file) {
  if (file.extension() == ".dat") return read_siconos_text(file);
#ifdef AIRYBENCH_HAS_HDF5
  return read_fclib(file);
#else
  throw UsageError(fmt::format("--problem: {}: this build is without HDF5", file.string()));
#endif
}

Files airy_files(const AirySystem& system, const std::string& format) {
  Exported exported{system.problem->mesh.name, airy_arrays(system)};
  exported.airy = true;
  if (system.contact.count > 0) exported.append(contact_law_arrays(system.contact));
  return write(exported, format, Json::object());
}

Files contact_files(const contact::Problem& problem, const Problem* body,
                    const std::string& format) {
  Exported exported{body != nullptr ? body->mesh.name : problem.name};
  exported.append_condensed(problem, body);
  return write(exported, format, Json::object());
}

Files body_files(const Problem& problem, const std::string& format) {
  Exported exported{problem.mesh.name, mesh_arrays(problem.mesh)};
  exported.append(body_arrays(problem));
  return write(exported, format, Json::object());
}

}  // namespace airybench
