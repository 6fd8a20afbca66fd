#include "mesh/msh_format.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <istream>
#include <map>
#include <ostream>
#include <set>
#include <sstream>

#include "mesh/mend.hpp"
#include "support/called_as.hpp"
#include "support/errors.hpp"
#include "support/file_text.hpp"

namespace airybench {
namespace {

constexpr int gmsh_triangle = 2;
constexpr std::array gmsh_line_of_degree = {0, 1, 8, 26, 27, 28, 62, 63};
static_assert(gmsh_line_of_degree.size() == EdgeCurve::max_degree + 1);

// Reads a text file line by line and field by field; every complaint names file and line.
class LineReader {
 public:
  LineReader(std::istream& in, std::string file_name) : in_(in), file_(std::move(file_name)) {}

  // The next non-empty line; fails at the end of the file.
  std::string_view next_line(std::string_view expected) {
    while (std::getline(in_, line_)) {
      ++number_;
      while (!line_.empty() && std::isspace(static_cast<unsigned char>(line_.back())))
        line_.pop_back();
      rest_ = line_;
      skip_blanks();
      if (!rest_.empty()) return rest_;
    }
    fail("the file ends where " + std::string(expected) + " should come; is it truncated?");
  }
  bool at_end() { return (in_ >> std::ws).peek() == std::istream::traits_type::eof(); }

  template <typename Number>
  Number field(std::string_view what) {
    Number value{};
    if (rest_.starts_with("+")) rest_.remove_prefix(1);
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error != std::errc() ||
        (end != rest_.data() + rest_.size() && !std::isspace(static_cast<unsigned char>(*end))))
      fail(std::string(what) + " expected, found '" + shown() + "'");
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    skip_blanks();
    return value;
  }
  bool is_at(char c) const { return rest_.starts_with(c); }
  std::string quoted_name() {
    const auto close = rest_.size() >= 2 && rest_[0] == '"' ? rest_.find('"', 1) : rest_.npos;
    if (close == rest_.npos) fail("a name in double quotes expected, found '" + shown() + "'");
    std::string name(rest_.substr(1, close - 1));
    rest_.remove_prefix(close + 1);
    skip_blanks();
    return name;
  }
  void end_of_line() {
    if (!rest_.empty()) fail("unexpected '" + shown() + "' at the end of the line");
  }
  // Another section may come before it in a foreign mesh.
  void expect(std::string_view section) {
    const std::string_view line = next_line(section);
    const std::string what = std::string(section) + " expected, found '" + shown() + "'";
    if (line != section && line.starts_with("$")) fail<ForeignMeshError>(what);
    if (line != section) fail(what);
  }
  template <typename Error = MeshError>
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(file_ + ":" + std::to_string(number_) + ": " + what);
  }
  const std::string& file() const { return file_; }

 private:
  void skip_blanks() {
    while (!rest_.empty() && std::isspace(static_cast<unsigned char>(rest_.front())))
      rest_.remove_prefix(1);
  }
  std::string shown() const {
    std::string text(rest_.substr(0, 40));
    for (char& c : text)
      if (!std::isprint(static_cast<unsigned char>(c))) c = '?';
    return text;
  }

  std::istream& in_;
  std::string file_;
  std::string line_;
  std::string_view rest_;
  int number_ = 0;
};

int read_count(LineReader& reader, std::string_view what) {
  reader.next_line(what);
  const int count = reader.field<int>(what);
  reader.end_of_line();
  if (count < 0) reader.fail(std::string(what) + " must not be negative");
  return count;
}

struct PhysicalGroups {
  struct Curve {
    BoundaryRole role;
    int group;  // row of Mesh::boundary_groups
  };
  std::map<int, Curve> curves;  // by Gmsh tag
  std::map<int, int> bodies;    // Gmsh tag to row of Mesh::body_names
};

PhysicalGroups read_physical_names(LineReader& reader, Mesh& mesh) {
  PhysicalGroups groups;
  const int count = read_count(reader, "the number of physical names");
  for (int i = 0; i < count; ++i) {
    reader.next_line("a physical name");
    const int dimension = reader.field<int>("a dimension");
    if (reader.is_at('"')) reader.fail<ForeignMeshError>("MSH 2.0: a name without dimension");
    const int tag = reader.field<int>("a physical group's number");
    const std::string name = reader.quoted_name();
    reader.end_of_line();
    if (dimension == 1) {
      const std::optional<BoundaryLabel> label = parse_boundary_label(name);
      if (!label)
        reader.fail<ForeignMeshError>(
            "physical curve '" + name +
            "': unknown boundary role (allowed: " + std::string(boundary_labels_allowed) + ")");
      const PhysicalGroups::Curve curve{label->role, boundary_group(mesh, label->name)};
      if (!groups.curves.emplace(tag, curve).second)
        reader.fail("physical curve " + std::to_string(tag) + " is named twice");
    } else if (dimension == 2) {
      if (!groups.bodies.emplace(tag, static_cast<int>(mesh.body_names.size())).second)
        reader.fail("physical surface " + std::to_string(tag) + " is named twice");
      mesh.body_names.push_back(name);
    } else {
      reader.fail<ForeignMeshError>("physical group '" + name + "' of dimension " +
                                    std::to_string(dimension) +
                                    " (allowed: 1, boundary roles; 2, bodies)");
    }
  }
  reader.expect("$EndPhysicalNames");
  return groups;
}

// Nodes inside curved lines are no vertices of the mesh, unless a triangle has them.
void drop_nodes(const std::vector<bool>& is_inside_line, Mesh& mesh) {
  std::vector<bool> is_kept(mesh.vertices.size());
  for (std::size_t v = 0; v < is_kept.size(); ++v) is_kept[v] = !is_inside_line[v];
  for (const auto& triangle : mesh.triangles)
    for (const int v : triangle) is_kept[v] = true;
  std::vector<int> number(mesh.vertices.size());
  int kept = 0;
  for (std::size_t v = 0; v < is_kept.size(); ++v) {
    number[v] = kept;
    if (is_kept[v]) mesh.vertices[kept++] = mesh.vertices[v];
  }
  mesh.vertices.resize(kept);
  for (auto& triangle : mesh.triangles)
    for (int& v : triangle) v = number[v];
  for (BoundaryEdge& edge : mesh.boundary)
    for (int& v : edge.vertices) v = number[v];
}

// Returns the vertex number of every Gmsh node number.
std::map<long, int> read_nodes(LineReader& reader, Mesh& mesh) {
  std::map<long, int> vertex_of_node;
  const int count = read_count(reader, "the number of nodes");
  double plane = 0;
  for (int i = 0; i < count; ++i) {
    reader.next_line("a node (" + std::to_string(count) + " announced, " + std::to_string(i) +
                     " found)");
    const long node = reader.field<long>("a node's number");
    const std::string name = "node " + std::to_string(node);
    const double x = reader.field<double>(name + ": x, a number,");
    const double y = reader.field<double>(name + ": y, a number,");
    const double z = reader.field<double>(name + ": z, a number,");
    reader.end_of_line();
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z))
      reader.fail(name + ": coordinates must be finite numbers");
    if (i == 0) plane = z;
    if (!(z == plane))
      reader.fail<ForeignMeshError>(
          name + ": z is not that of the first node; the body must lie in one plane");
    if (!vertex_of_node.emplace(node, static_cast<int>(mesh.vertices.size())).second)
      reader.fail(name + " is given twice");
    mesh.vertices.emplace_back(x, y);
  }
  reader.expect("$EndNodes");
  return vertex_of_node;
}

void read_elements(LineReader& reader, const PhysicalGroups& groups,
                   const std::map<long, int>& vertex_of_node, Mesh& mesh) {
  const int count = read_count(reader, "the number of elements");
  std::vector<bool> is_inside_line(mesh.vertices.size(), false);
  for (int i = 0; i < count; ++i) {
    reader.next_line("an element (" + std::to_string(count) + " announced, " + std::to_string(i) +
                     " found)");
    const std::string name = "element " + std::to_string(reader.field<long>("an element's number"));
    const int type = reader.field<int>(name + ": a type");
    const auto line = std::ranges::find(gmsh_line_of_degree, type);
    if (line == gmsh_line_of_degree.end() && type != gmsh_triangle)
      reader.fail<ForeignMeshError>(name + ": type " + std::to_string(type) +
                                    " (allowed: 1, 8, 26, 27, 28, 62, 63, lines of 2 to 8 nodes; "
                                    "2, 3-node triangle)");
    const int tags = reader.field<int>(name + ": the number of tags");
    if (tags < 1) reader.fail<ForeignMeshError>(name + ": needs a first tag, its physical group");
    const int group = reader.field<int>(name + ": a physical group");
    for (int tag = 1; tag < tags; ++tag) reader.field<int>(name + ": a tag");
    const auto vertex = [&] {
      const long node = reader.field<long>(name + ": a node's number");
      const auto found = vertex_of_node.find(node);
      if (found == vertex_of_node.end())
        reader.fail(name + ": node " + std::to_string(node) + " does not exist");
      return found->second;
    };
    if (type != gmsh_triangle) {
      const auto curve = groups.curves.find(group);
      if (curve == groups.curves.end())
        reader.fail<ForeignMeshError>(
            name + ": physical group " + std::to_string(group) +
            " is no boundary role (allowed: displacement, force, contact)");
      const int start = vertex(), end = vertex();
      mesh.boundary.push_back({{start, end}, curve->second.role, curve->second.group});
      std::vector<Eigen::Vector2d> points = {mesh.vertices[start]};
      for (auto inside = line - gmsh_line_of_degree.begin(); inside > 1; --inside) {
        const int v = vertex();
        is_inside_line[v] = true;
        points.push_back(mesh.vertices[v]);
      }
      points.push_back(mesh.vertices[end]);
      if (points.size() > 2) mesh.boundary.back().curve = EdgeCurve{points};
    } else {
      const auto body = groups.bodies.find(group);
      if (body == groups.bodies.end())
        reader.fail<ForeignMeshError>(name + ": physical group " + std::to_string(group) +
                                      " is no named body");
      const int a = vertex(), b = vertex(), c = vertex();
      mesh.triangles.push_back({a, b, c});
      mesh.triangle_body.push_back(body->second);
    }
    reader.end_of_line();
  }
  reader.expect("$EndElements");
  if (std::ranges::count(is_inside_line, true) > 0) drop_nodes(is_inside_line, mesh);
}

// The roles, then the named groups that have edges, by name.
std::vector<std::string> physical_curves(const Mesh& mesh) {
  std::vector<std::string> curves(boundary_role_names.begin(), boundary_role_names.end());
  std::set<std::string> named;
  for (const BoundaryEdge& edge : mesh.boundary)
    if (edge.group != BoundaryEdge::no_group) named.insert(boundary_label(mesh, edge));
  curves.insert(curves.end(), named.begin(), named.end());
  return curves;
}

}  // namespace

Mesh read_msh(std::istream& in, const std::string& file_name, std::vector<std::string>* notes) {
  LineReader reader(in, file_name);
  Mesh mesh;
  if (reader.next_line("$MeshFormat") != "$MeshFormat")
    reader.fail<ForeignMeshError>("not a mesh file: the first line must be $MeshFormat");
  reader.next_line("the format's version");
  const double version = reader.field<double>("the format's version");
  const int binary = reader.field<int>("the file type");
  if (!(version >= 2 && version < 3) || binary != 0)
    reader.fail<ForeignMeshError>("only MSH 2 in ASCII is read here; convert with `" +
                                  called_as("meshgen") + " --convert`");
  reader.expect("$EndMeshFormat");
  reader.expect("$PhysicalNames");
  const PhysicalGroups groups = read_physical_names(reader, mesh);
  reader.expect("$Nodes");
  const std::map<long, int> vertex_of_node = read_nodes(reader, mesh);
  reader.expect("$Elements");
  read_elements(reader, groups, vertex_of_node, mesh);
  if (!reader.at_end()) {
    reader.next_line("the end of the file");
    reader.fail<ForeignMeshError>("unexpected section after $EndElements; convert with `" +
                                  called_as("meshgen") + " --convert`");
  }
  mesh.name = file_name;  // until it is known to be good, the file is the name to complain about
  try {
    validate(mesh);
    std::vector<std::string> mended = mend(mesh);
    if (notes) *notes = std::move(mended);
  } catch (const MeshError& error) {  // clockwise, or without a role: converted by --convert
    throw ForeignMeshError(error.what());
  }
  mesh.name = std::filesystem::path(file_name).stem().string();
  return mesh;
}

Mesh read_msh(const std::filesystem::path& file, std::vector<std::string>* notes) {
  std::string text;
  try {
    text = file_text(file);
  } catch (const FileError& error) {
    throw MeshError(error.what());
  }
  std::istringstream in(std::move(text));
  return read_msh(in, file.string(), notes);
}

void write_msh(std::ostream& out, const Mesh& mesh) {
  const auto number = [](double value) {
    std::array<char, 32> text;
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return std::string(text.data(), end);
  };
  const std::vector<std::string> curves = physical_curves(mesh);
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  out << "$PhysicalNames\n" << curves.size() + mesh.body_names.size() << "\n";
  for (std::size_t k = 0; k < curves.size(); ++k)
    out << "1 " << k + 1 << " \"" << curves[k] << "\"\n";
  const std::size_t first_body = curves.size() + 1;
  for (std::size_t body = 0; body < mesh.body_names.size(); ++body)
    out << "2 " << first_body + body << " \"" << mesh.body_names[body] << "\"\n";
  std::vector<Eigen::Vector2d> nodes = mesh.vertices;
  for (const BoundaryEdge& edge : mesh.boundary)
    if (const auto& points = edge.curve.points_mm; !points.empty())
      nodes.insert(nodes.end(), points.begin() + 1, points.end() - 1);
  out << "$EndPhysicalNames\n$Nodes\n" << nodes.size() << "\n";
  for (std::size_t v = 0; v < nodes.size(); ++v)
    out << v + 1 << " " << number(nodes[v].x()) << " " << number(nodes[v].y()) << " 0\n";
  out << "$EndNodes\n$Elements\n" << mesh.boundary.size() + mesh.triangles.size() << "\n";
  std::size_t element = 0, node = mesh.vertices.size();  // inside a curved line
  for (const BoundaryEdge& edge : mesh.boundary) {
    const auto tag = std::ranges::find(curves, boundary_label(mesh, edge)) - curves.begin() + 1;
    const int degree = edge.curve.is_straight() ? 1 : edge.curve.degree();
    out << ++element << " " << gmsh_line_of_degree[degree] << " 2 " << tag << " " << tag << " "
        << edge.vertices[0] + 1 << " " << edge.vertices[1] + 1;
    for (int inside = 1; inside < degree; ++inside) out << " " << ++node;
    out << "\n";
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto tag = first_body + static_cast<std::size_t>(mesh.triangle_body[t]);
    out << ++element << " 2 2 " << tag << " " << tag;
    for (const int v : mesh.triangles[t]) out << " " << v + 1;
    out << "\n";
  }
  out << "$EndElements\n";
}

std::string msh_text(const Mesh& mesh) {
  std::ostringstream text;
  write_msh(text, mesh);
  return text.str();
}

}  // namespace airybench
