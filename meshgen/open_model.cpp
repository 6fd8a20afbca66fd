#include "meshgen/open_model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <unordered_map>

#include "mesh/mesh.hpp"
#include "mesh/model_format.hpp"
#include "meshgen/geo_script.hpp"
#include "meshgen/gmsh_input.hpp"
#include "meshgen/plane_model.hpp"
#include "meshgen/quiet_stdout.hpp"
#include "support/called_as.hpp"
#include "support/errors.hpp"

namespace airybench {
namespace {

std::string names_of(const GeoScript& script) {
  std::set<std::string> names = script.constants;
  names.insert(script.onelab_names.begin(), script.onelab_names.end());
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
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

void refuse_volumes() {
  gmsh::vectorpair groups;
  gmsh::model::getPhysicalGroups(groups, 2);
  if (const std::size_t volumes = entities(3).size(); volumes > 0 && groups.empty())
    throw InputError(fmt::format(
        "{} volume(s); the body must be plane: one or more faces in a plane z = constant",
        volumes));
}

// Gmsh meshes a body of any size, until the memory ends.
void refuse_huge() {
  constexpr double most = 1e9;
  std::array<double, 6> box;
  gmsh::model::getBoundingBox(-1, -1, box[0], box[1], box[2], box[3], box[4], box[5]);
  for (const double coordinate : box)
    if (!(std::abs(coordinate) <= most))
      throw InputError(fmt::format("it has a coordinate {:.6g} (allowed: up to {:g} in size)",
                                   coordinate, most));
}

// Gmsh calls bent polylines lines too. Of two coordinates of the plane, on the curve.
template <class Place>
bool is_straight(int curve, const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                 const Place& in_plane) {
  std::vector<double> low, high, parameters, xyz;
  gmsh::model::getParametrizationBounds(1, curve, low, high);
  constexpr int parts = 64;
  for (int k = 1; k < parts; ++k)
    parameters.push_back(low.at(0) + (high.at(0) - low.at(0)) * k / parts);
  gmsh::model::getValue(1, curve, parameters, xyz);
  const double square = (b - a).squaredNorm();
  for (std::size_t at = 0; at < xyz.size(); at += 3)
    if (std::abs(cross_area(a, b, in_plane(xyz, at))) > 1e-9 * square) return false;
  return true;
}

// A straight curve from a to b.
struct StraightLine {
  int curve;
  Eigen::Vector2d a, b;
};

// The straight curves around a surface, a body's own or a hole's, in its plane.
std::vector<StraightLine> straight_lines_around(int surface) {
  double x0, y0, z0, x1, y1, z1;
  gmsh::model::getBoundingBox(2, surface, x0, y0, z0, x1, y1, z1);
  const double least = std::min({x1 - x0, y1 - y0, z1 - z0}),
               most = std::max({x1 - x0, y1 - y0, z1 - z0});
  if (least > 1e-6 * most) return {};  // in none of the planes that a body may lie in
  const std::size_t first = least == x1 - x0 && least < z1 - z0 ? 1 : 0,
                    second = least == z1 - z0 ? 1 : 2;
  std::vector<StraightLine> lines;
  gmsh::vectorpair curves, ends;
  gmsh::model::getBoundary({{2, surface}}, curves, /*combined=*/false, /*oriented=*/false);
  for (const auto& [dimension, curve] : curves) {
    std::string type;
    gmsh::model::getType(dimension, curve, type);
    gmsh::model::getBoundary({{dimension, curve}}, ends, false, false);
    if (type != "Line" || ends.size() != 2) continue;
    const auto in_plane = [&](const std::vector<double>& xyz, std::size_t at) {
      return Eigen::Vector2d(xyz.at(at + first), xyz.at(at + second));
    };
    const auto place = [&](std::size_t end) {
      std::vector<double> xyz;
      gmsh::model::getValue(0, ends[end].second, {}, xyz);
      return in_plane(xyz, 0);
    };
    const Eigen::Vector2d a = place(0), b = place(1);
    if (is_straight(curve, a, b, in_plane)) lines.push_back({curve, a, b});
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

// Gmsh tries to mend such a boundary: 4.8 gives up, 4.13 does
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

// Over what the model itself says of sizes; Gmsh multiplies these bounds by its factor. Numbers of
// edges (transfinite curves) stay.
void set_sizes(const ModelOptions& options, double mm_per_unit) {
  if (options.size_factor)
    gmsh::option::setNumber("Mesh.MeshSizeFactor",
                            option("Mesh.MeshSizeFactor") * *options.size_factor);
  if (!options.longest_edge_mm) return;
  const double longest = *options.longest_edge_mm / (mm_per_unit * option("Mesh.MeshSizeFactor"));
  for (const char* bound : {"Mesh.MeshSizeMax", "Mesh.MeshSizeMin"})
    gmsh::option::setNumber(bound, std::min(option(bound), longest));
}

// At most that of its box, which is all there is of a boundary that does not close.
double area_of(int surface) {
  std::array<double, 6> box;
  gmsh::model::getBoundingBox(2, surface, box[0], box[1], box[2], box[3], box[4], box[5]);
  const Eigen::Vector3d low(box[0], box[1], box[2]), high(box[3], box[4], box[5]);
  Eigen::Index flat = 0;
  (high - low).minCoeff(&flat);
  const Eigen::Index first = flat == 0 ? 1 : 0, second = flat == 2 ? 1 : 2;
  const auto in_plane = [&](const Eigen::Vector3d& x) {
    return Eigen::Vector2d(x[first], x[second]);
  };
  gmsh::vectorpair curves;
  gmsh::model::getBoundary({{2, surface}}, curves, /*combined=*/false, /*oriented=*/true);
  double area = 0;
  std::vector<double> begin, end, parameters, xyz;
  for (const auto& [dimension, curve] : curves) {
    constexpr int parts = 32;
    gmsh::model::getParametrizationBounds(1, std::abs(curve), begin, end);
    parameters.clear();
    for (int k = 0; k <= parts; ++k)
      parameters.push_back(begin.at(0) + (end.at(0) - begin.at(0)) * k / parts);
    gmsh::model::getValue(1, std::abs(curve), parameters, xyz);
    for (std::size_t k = 3; k + 2 < xyz.size(); k += 3)
      area += (curve < 0 ? -1 : 1) * cross_area(in_plane((low + high) / 2),
                                                in_plane(Eigen::Vector3d(&xyz[k - 3])),
                                                in_plane(Eigen::Vector3d(&xyz[k])));
  }
  const Eigen::Vector2d sides = in_plane(high - low);
  return std::min(std::abs(area) / 2, sides.x() * sides.y());
}

// An equilateral triangle has √3/4 of its edge's square.
double triangles_with(double longest_edge) {
  double area = 0;
  for (const int surface : numbers_of(entities(2))) area += area_of(surface);
  return area / (std::sqrt(3) / 4 * longest_edge * longest_edge);
}

// Gmsh's numbers overflow where there are countless edges: it then makes a coarse mesh. Before
// many triangles, which take minutes, says how many; bounds alone are known, no sizes at points.
void estimate_triangles(const std::filesystem::path& file, const ModelOptions& options) {
  constexpr double unbounded = 1e20, many = 1e6, most = 2e7;
  const double longest = option("Mesh.MeshSizeMax") * option("Mesh.MeshSizeFactor");
  if (longest > unbounded) return;
  const double triangles = triangles_with(longest);
  const char* const asked_by =
      options.longest_edge_mm || options.size_factor ? "--mesh-size" : "its Mesh.MeshSizeMax";
  if (triangles > most)
    throw InputError(
        fmt::format("about {:.1g} triangles: {} (allowed: up to {:g})", triangles, asked_by, most));
  if (triangles > many)
    fmt::print(stderr, "note: {}: about {:.1g} triangles: {}\n", file.string(), triangles,
               asked_by);
}

// Transfinite curves keep their edges.
void note_longest_edge(double asked, std::vector<std::string>& notes) {
  std::vector<std::size_t> nodes, elements;
  std::vector<double> xyz, parameters;
  gmsh::model::mesh::getNodes(nodes, xyz, parameters, -1, -1, false, false);
  std::unordered_map<std::size_t, std::size_t> row;
  for (std::size_t k = 0; k < nodes.size(); ++k) row.emplace(nodes[k], 3 * k);
  constexpr int triangle = 2;
  std::vector<std::size_t> corners;
  gmsh::model::mesh::getElementsByType(triangle, elements, corners);
  double longest = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const std::size_t a = row.at(corners[k]), b = row.at(corners[k % 3 == 2 ? k - 2 : k + 1]);
    longest = std::max(
        longest, std::hypot(xyz[a] - xyz[b], xyz[a + 1] - xyz[b + 1], xyz[a + 2] - xyz[b + 2]));
  }
  constexpr double longer = 3;  // than asked for: Gmsh's edges may be half as long again
  if (longest > longer * asked)
    notes.push_back(fmt::format(
        "--mesh-size: its longest edge is {:.3g} times as long as asked for", longest / asked));
}

// Fills the outline of the triangles, which may be as thin as can be.
void fill_outline(std::vector<std::string>& notes) {
  namespace geo = gmsh::model::geo;
  const PlaneModel triangles = read_plane_model(1, notes);
  gmsh::clear();
  gmsh::model::add("outline");
  for (const auto& [node, p] : triangles.position)
    geo::addPoint(p.x(), p.y(), 0, 0, static_cast<int>(node));
  struct Outgoing {
    int curve;
    std::size_t end;
    double twice_area;  // between it and the origin
  };
  std::map<std::size_t, Outgoing> from;
  const auto add = [&](std::span<const std::size_t> walk, int number) {
    geo::addPolyline(std::vector<int>(walk.begin(), walk.end()), number);
    double area = 0;
    for (std::size_t k = 1; k < walk.size(); ++k)
      area +=
          cross_area({0, 0}, triangles.position.at(walk[k - 1]), triangles.position.at(walk[k]));
    from[walk.front()] = {number, walk.back(), area};
  };
  int number = triangles.curves.back().number;
  for (const ModelCurve& curve : triangles.curves)
    for (const std::vector<std::size_t>& nodes : walks_of(curve)) {
      const std::span<const std::size_t> walk(nodes);
      const std::size_t middle = walk.size() / 2;
      const bool is_closed = walk.front() == walk.back();  // which no curve of Gmsh's may be
      add(is_closed ? walk.first(middle + 1) : walk, curve.number);
      if (is_closed) add(walk.subspan(middle), ++number);
    }
  std::vector<int> loops;
  int outer = 0;
  while (!from.empty()) {
    std::vector<int> loop;
    double area = 0;
    for (auto at = from.begin(); at != from.end();) {
      const auto [curve, end, twice_area] = at->second;
      loop.push_back(curve);
      area += twice_area;
      from.erase(at);
      at = from.find(end);
    }
    loops.insert(area > 0 ? loops.begin() : loops.end(), geo::addCurveLoop(loop));
    outer += area > 0;
  }
  if (outer != 1) throw InputError(fmt::format("{} outlines; the body must be one", outer));
  geo::addPlaneSurface(loops, 1);
  geo::synchronize();
}

// Gmsh's complaint names the user's file.
void open_in_gmsh(const GmshInput& input, const std::filesystem::path& file) {
  try {
    gmsh::open(input.file().string());
  } catch (...) {
    std::string message = message_of_gmsh();
    for (const std::string& name :
         {input.file().string(), std::filesystem::absolute(file).string()})
      if (const std::size_t at = message.find(name); at != message.npos && name != file.string())
        message.replace(at, name.size(), file.string());
    throw message;
  }
}

#ifndef AIRYBENCH_HAS_HDF5
void refuse_if_not_built_for(const std::filesystem::path& file) {
  std::string built_with;
  gmsh::option::getString("General.BuildOptions", built_with);
  if (format_of(file) == ModelFormat::med && built_with.find(" Med") == built_with.npos)
    throw InputError(
        fmt::format("neither HDF5 nor a Gmsh with MED was there when this was built (allowed: the "
                    "mesh in another format; that of gmsh.info makes one: gmsh {} -save -o {}.msh)",
                    file.filename().string(), model_name(file)));
}
#endif

double scaling_factor(std::vector<std::string>& notes) {
  const double factor = option("Mesh.ScalingFactor");
  if (!(factor > 0) || !std::isfinite(factor))
    throw InputError(fmt::format("Mesh.ScalingFactor = {} (allowed: > 0)", factor));
  if (factor != 1)
    notes.push_back(fmt::format("lengths are multiplied by its Mesh.ScalingFactor, {}", factor));
  return factor;
}

void generate(const ModelOptions& options, const AboutToMesh& about_to_mesh) {
  if (options.algorithm) {
    gmsh::option::setNumber("Mesh.Algorithm", *options.algorithm);
    for (const int surface : numbers_of(entities(2)))
      gmsh::model::mesh::setAlgorithm(2, surface, *options.algorithm);
  }
  if (about_to_mesh) about_to_mesh(static_cast<int>(option("Mesh.Algorithm")));
  gmsh::model::mesh::generate(2);
}

}  // namespace

OpenModel::Parameters OpenModel::parameters_of(const std::filesystem::path& file,
                                               const ModelOptions& options) {
  Parameters parameters;
  const GeoScript script = what_is_read(file);
  if (script.has_external_process)
    throw InputError("a field ExternalProcess (a model may start no programs)");
  if (format_of(file) != ModelFormat::geo) {
    if (options.parameters.empty()) return parameters;
    throw InputError("--parameter: only a .geo has parameters");
  }
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

OpenModel::OpenModel(const std::filesystem::path& file, const ModelOptions& options,
                     const AboutToMesh& about_to_mesh, std::vector<std::string>& notes)
    : OpenModel(file, options, parameters_of(file, options), about_to_mesh, notes) {}

OpenModel::OpenModel(const std::filesystem::path& file, const ModelOptions& options,
                     const Parameters& parameters, const AboutToMesh& about_to_mesh,
                     std::vector<std::string>& notes)
    : session_(parameters.constants) {
#ifndef AIRYBENCH_HAS_HDF5
  refuse_if_not_built_for(file);
#endif
  const GmshInput input(file);
  for (const auto& [name, value] : parameters.onelab) gmsh::onelab::setNumber(name, {value});
  const QuietStdout quiet;  // parts of Gmsh print there whatever it is told
  open_in_gmsh(input, file);
  if (entities(-1).empty())
    throw InputError(
        fmt::format("it has neither mesh nor geometry (what can be read: {})", model_extensions));
  mm_per_unit_ = options.length_unit_mm * scaling_factor(notes);
  const ModelFormat format = format_of(file);
  if (format == ModelFormat::outline || format == ModelFormat::obj) fill_outline(notes);
  refuse_volumes();
  if (!has_mesh()) {
    set_sizes(options, mm_per_unit_);
    refuse_huge();
    refuse_crossing_lines();
    estimate_triangles(file, options);
    generate(options, about_to_mesh);
    if (options.longest_edge_mm) note_longest_edge(*options.longest_edge_mm / mm_per_unit_, notes);
  } else if (options.size_factor || options.longest_edge_mm) {
    throw InputError(fmt::format("--mesh-size: it has a mesh already ({} --adapt refines one)",
                                 called_as("bench")));
  }
}

}  // namespace airybench
