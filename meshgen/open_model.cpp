#include "meshgen/open_model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmsh.h>

#include <algorithm>

#include "mesh/mesh.hpp"
#include "mesh/model_format.hpp"
#include "meshgen/geo_script.hpp"
#include "meshgen/quiet_stdout.hpp"
#include "support/errors.hpp"
#include "support/file_text.hpp"

namespace airybench {
namespace {

std::string names_of(const GeoScript& script) {
  std::set<std::string> names = script.constants;
  names.insert(script.onelab_names.begin(), script.onelab_names.end());
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

// What Gmsh would pass over, or wait for without end.
void check(const GeoScript& script, const std::filesystem::path& file) {
  const std::string text = file_text(file);
  if (!text.empty() && text.back() != '\n')
    throw InputError(
        "its last line does not end: Gmsh would pass over it (allowed: a new line there)");
  if (script.has_external_process)
    throw InputError("a field ExternalProcess (a model may start no programs)");
}

gmsh::vectorpair entities(int dimension) {
  gmsh::vectorpair found;
  gmsh::model::getEntities(found, dimension);
  return found;
}

std::vector<int> numbers_of(const gmsh::vectorpair& entities) {
  std::vector<int> numbers;
  for (const auto& [dimension, number] : entities) numbers.push_back(number);
  return numbers;
}

// "4 at (0, 5)", the middle of the curve.
std::string place_of_curve(int curve) {
  std::vector<double> least, most, point;
  gmsh::model::getParametrizationBounds(1, curve, least, most);
  gmsh::model::getValue(1, curve, {(least.at(0) + most.at(0)) / 2}, point);
  return fmt::format("{} at ({:.4g}, {:.4g})", curve, point.at(0), point.at(1));
}

std::string places_of(std::vector<int> curves) {
  constexpr std::size_t most = 12;
  const bool has_more = curves.size() > most;
  curves.resize(std::min(curves.size(), most));
  std::vector<std::string> places;
  for (const int curve : curves) places.push_back(place_of_curve(curve));
  return fmt::format("{}{}", fmt::join(places, ", "), has_more ? ", …" : "");
}

void name_parts_of_cad(const ModelOptions& options) {
  if (const std::size_t volumes = entities(3).size(); volumes > 0)
    throw InputError(fmt::format(
        "{} volume(s); the body must be plane: one or more faces in a plane z = constant",
        volumes));
  const std::vector<int> surfaces = numbers_of(entities(2)), curves = numbers_of(entities(1));
  if (surfaces.empty()) throw InputError("it has no surface");
  if (options.roles.empty())
    throw InputError(
        fmt::format("a CAD file names no curves; each needs a role by its number, --role {}=force "
                    "(its curves: {})",
                    curves.empty() ? 1 : curves.front(), places_of(curves)));
  gmsh::model::setPhysicalName(2, gmsh::model::addPhysicalGroup(2, surfaces), "body");
  for (const int curve : curves)
    gmsh::model::setPhysicalName(1, gmsh::model::addPhysicalGroup(1, {curve}, curve),
                                 std::to_string(curve));
}

// A straight curve from a to b.
struct StraightLine {
  int curve;
  Eigen::Vector2d a, b;
};

// The straight curves around a surface, a body's own or a hole's.
std::vector<StraightLine> straight_lines_around(int surface) {
  std::vector<StraightLine> lines;
  gmsh::vectorpair curves, ends;
  gmsh::model::getBoundary({{2, surface}}, curves, /*combined=*/false, /*oriented=*/false);
  for (const auto& [dimension, curve] : curves) {
    std::string type;
    gmsh::model::getType(dimension, curve, type);
    gmsh::model::getBoundary({{dimension, curve}}, ends, false, false);
    if (type != "Line" || ends.size() != 2) continue;
    const auto place = [&](std::size_t end) {
      std::vector<double> xyz;
      gmsh::model::getValue(0, ends[end].second, {}, xyz);
      return Eigen::Vector2d(xyz.at(0), xyz.at(1));
    };
    lines.push_back({curve, place(0), place(1)});
  }
  return lines;
}

// Inside both, not in an end of one: there other curves meet it.
bool cross(const StraightLine& one, const StraightLine& other) {
  const auto on_both_sides = [](const StraightLine& of, const StraightLine& ends) {
    return cross_area(of.a, of.b, ends.a) * cross_area(of.a, of.b, ends.b) < 0;
  };
  return on_both_sides(one, other) && on_both_sides(other, one);
}

// Of a surface in a plane z = constant. Gmsh tries to mend such a boundary: 4.8 gives up, 4.13 does
// not end.
void refuse_crossing_lines() {
  for (const int surface : numbers_of(entities(2))) {
    const std::vector<StraightLine> lines = straight_lines_around(surface);
    for (std::size_t i = 0; i < lines.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (cross(lines[k], lines[i]))
          throw InputError(fmt::format("curves {} and {} around surface {} cross", lines[k].curve,
                                       lines[i].curve, surface));
  }
}

bool has_mesh() {
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> elements, nodes;
  gmsh::model::mesh::getElements(types, elements, nodes, 2);
  return !types.empty();
}

double option(const char* name) {
  double value = 0;
  gmsh::option::getNumber(name, value);
  return value;
}

// Over what the model itself says of sizes. Numbers of edges (transfinite curves) stay.
void set_sizes(const ModelOptions& options) {
  if (options.size_factor)
    gmsh::option::setNumber("Mesh.MeshSizeFactor",
                            option("Mesh.MeshSizeFactor") * *options.size_factor);
  if (!options.longest_edge_mm) return;
  for (const char* bound : {"Mesh.MeshSizeMax", "Mesh.MeshSizeMin"})
    gmsh::option::setNumber(bound, std::min(option(bound), *options.longest_edge_mm));
}

void mesh_surfaces(const ModelOptions& options) {
  if (!has_mesh()) {
    set_sizes(options);
    refuse_crossing_lines();
    gmsh::model::mesh::generate(2);
  } else if (options.size_factor || options.longest_edge_mm) {
    throw InputError("--mesh-size: it has a mesh already (bench --adapt refines one)");
  }
}

}  // namespace

OpenModel::Parameters OpenModel::parameters_of(const std::filesystem::path& file,
                                               const ModelOptions& options) {
  Parameters parameters;
  if (format_of(file) != ModelFormat::geo) {
    if (options.parameters.empty()) return parameters;
    throw InputError("--parameter: only a .geo has parameters");
  }
  const GeoScript script = read_geo_script(file);
  check(script, file);
  for (const auto& [name, value] : options.parameters) {
    if (script.onelab_names.contains(name)) {
      parameters.onelab.emplace(name, value);
    } else if (script.constants.contains(name) || !script.is_self_contained) {
      parameters.constants.emplace(name, value);
    } else {
      throw InputError(
          fmt::format("--parameter: {} is none of its parameters (those of its DefineConstant: {})",
                      name, names_of(script)));
    }
  }
  return parameters;
}

OpenModel::OpenModel(const std::filesystem::path& file, const ModelOptions& options)
    : OpenModel(file, options, parameters_of(file, options)) {}

OpenModel::OpenModel(const std::filesystem::path& file, const ModelOptions& options,
                     const Parameters& parameters)
    : session_(parameters.constants) {
  for (const auto& [name, value] : parameters.onelab) gmsh::onelab::setNumber(name, {value});
  {
    const QuietStdout quiet;  // OpenCASCADE, inside Gmsh, complains there whatever Gmsh is told
    gmsh::open(file.string());
  }
  if (format_of(file) == ModelFormat::cad) name_parts_of_cad(options);
  mesh_surfaces(options);
}

}  // namespace airybench
