#include "meshgen/gmsh_mesher.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <stdexcept>
#include <unordered_map>

#include "support/errors.hpp"

namespace airybench {
namespace {

void build_model(const BoundaryPolygon& polygon) {
  namespace geo = gmsh::model::geo;
  const int n = static_cast<int>(polygon.vertices.size());
  gmsh::clear();
  gmsh::model::add("airybench");
  for (int i = 0; i < n; ++i)
    geo::addPoint(polygon.vertices[i].x(), polygon.vertices[i].y(), 0, 0, i + 1);
  std::vector<int> loop;
  for (int i = 0; i < n; ++i) {
    const int curve = geo::addLine(i + 1, (i + 1) % n + 1, i + 1);
    geo::mesh::setTransfiniteCurve(curve, 2);
    loop.push_back(curve);
  }
  geo::addCurveLoop(loop, 1);
  geo::addPlaneSurface({1}, 1);
  geo::synchronize();
}

// The polygon's vertices first, then the inner ones in Gmsh's order.
Mesh extract_mesh(const BoundaryPolygon& polygon, const std::string& name) {
  Mesh mesh;
  mesh.name = name;
  mesh.vertices = polygon.vertices;
  mesh.body_names = {"body"};
  std::unordered_map<std::size_t, int> vertex_of_node;
  std::vector<std::size_t> nodes;
  std::vector<double> xyz, parameters;
  const int n = static_cast<int>(polygon.vertices.size());
  for (int i = 0; i < n; ++i) {
    gmsh::model::mesh::getNodes(nodes, xyz, parameters, 0, i + 1, false, false);
    if (nodes.size() != 1) throw MeshError(name + ": Gmsh lost a boundary vertex");
    vertex_of_node.emplace(nodes[0], i);
    mesh.boundary.push_back({{i, (i + 1) % n}, polygon.roles[i]});
  }
  gmsh::model::mesh::getNodes(nodes, xyz, parameters, 2, 1, false, false);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    vertex_of_node.emplace(nodes[k], static_cast<int>(mesh.vertices.size()));
    mesh.vertices.emplace_back(rounded_coordinate(xyz[3 * k]), rounded_coordinate(xyz[3 * k + 1]));
  }
  constexpr int gmsh_triangle = 2;
  std::vector<std::size_t> elements, corners;
  gmsh::model::mesh::getElementsByType(gmsh_triangle, elements, corners, 1);
  for (std::size_t t = 0; t < elements.size(); ++t) {
    std::array<int, 3> triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto found = vertex_of_node.find(corners[3 * t + k]);
      if (found == vertex_of_node.end())
        throw MeshError(name + ": Gmsh put a vertex on a boundary edge");
      triangle[k] = found->second;
    }
    mesh.triangles.push_back(triangle);
  }
  mesh.triangle_body.assign(mesh.triangles.size(), 0);
  return mesh;
}

}  // namespace

GmshSession::GmshSession(const std::map<std::string, double>& constants) {
  std::vector<std::string> arguments = {"meshgen"};
  for (const auto& [name, value] : constants)
    for (std::string& argument :
         std::array{std::string("-setnumber"), name, fmt::format("{}", value)})
      arguments.push_back(std::move(argument));
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  gmsh::initialize(static_cast<int>(argv.size()), argv.data(), false);
  for (const auto& [option, value] :
       {std::pair("General.Terminal", 0.0), std::pair("General.NumThreads", 1.0),
        std::pair("Mesh.RandomSeed", 1.0), std::pair("Mesh.RandomFactor", 1e-9)})
    gmsh::option::setNumber(option, value);
}

GmshSession::~GmshSession() { gmsh::finalize(); }

std::string gmsh_version() {
  std::string version;
  gmsh::option::getString("General.Version", version);
  return version;
}

std::string version_of_gmsh() {
  const GmshSession session;
  return gmsh_version();
}

std::string message_of_gmsh() {
  try {
    throw;
  } catch (const std::string& message) {
    return message;
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    return error.what();
  } catch (const std::exception&) {
    throw;
  } catch (...) {
    return "OpenCASCADE cannot read it";  // throws what is no std::exception
  }
}

Mesh mesh_interior(const BoundaryPolygon& polygon, const SizeField& size,
                   const InteriorRecipe& recipe, const std::string& name) {
  try {
    build_model(polygon);
    for (const auto option : {"Mesh.MeshSizeFromPoints", "Mesh.MeshSizeFromCurvature",
                              "Mesh.MeshSizeExtendFromBoundary"})
      gmsh::option::setNumber(option, 0);  // the callback alone says
    gmsh::option::setNumber("Mesh.Algorithm", static_cast<int>(recipe.algorithm));
    gmsh::model::mesh::setSizeCallback([&](int, int, double x, auto...) {
      return recipe.size_factor * size.at(x, recipe.grading_exponent);
    });
    gmsh::model::mesh::generate(2);
    gmsh::model::mesh::removeSizeCallback();
    return extract_mesh(polygon, name);
  } catch (...) {
    throw MeshError(name + ": Gmsh: " + message_of_gmsh());
  }
}

}  // namespace airybench
