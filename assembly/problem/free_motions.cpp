#include "assembly/problem/free_motions.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "assembly/elements/edge_forces.hpp"
#include "assembly/problem/problem.hpp"
#include "mesh/transform_error.hpp"

namespace airybench {
namespace {

struct PlaneArea {
  double mm2 = 0;
  Eigen::Vector2d centroid = {0, 0};
  double gyration_mm = 0;  // √(∫|x − c|²/A)
};

PlaneArea plane_area(const Mesh& mesh, const std::vector<int>& piece_of_vertex, int piece) {
  PlaneArea area;
  const auto sum = [&](const auto& add) {
    for (const auto& [a, b, c] : mesh.triangles)
      if (piece_of_vertex[a] == piece) {
        const auto &x = mesh.vertices[a], &y = mesh.vertices[b], &z = mesh.vertices[c];
        add(cross_area(x, y, z) / 2, x, y, z);
      }
  };
  using Corner = const Eigen::Vector2d&;
  sum([&](double mm2, Corner x, Corner y, Corner z) {
    area.mm2 += mm2;
    area.centroid += mm2 * (x + y + z) / 3;
  });
  area.centroid /= area.mm2;
  double inertia = 0;
  sum([&](double mm2, Corner x, Corner y, Corner z) {
    const auto& o = area.centroid;
    inertia += mm2 / 12 *
               ((x - o).squaredNorm() + (y - o).squaredNorm() + (z - o).squaredNorm() +
                (x + y + z - 3 * o).squaredNorm());
  });
  area.gyration_mm = std::sqrt(inertia / area.mm2);
  return area;
}

std::vector<RigidMotion> motions_of(const PieceSupport& support, const PlaneArea& area) {
  const Eigen::Vector2d& c = area.centroid;
  if (support.along) return {{c, *support.along, 0}};
  return {{c, {1, 0}, 0}, {c, {0, 1}, 0}, {c, {0, 0}, 1 / area.gyration_mm}};
}

int larger_component(const Eigen::Vector2d& v) {
  return std::abs(v.x()) >= std::abs(v.y()) ? 0 : 1;
}

// Far from each other, so that pins are no hinge: the second holds the turn about the first.
void add_pins(const Mesh& mesh, const std::vector<int>& rows, const PieceSupport& support,
              const Eigen::Vector2d& centre, std::vector<Pin>& pins) {
  const auto start = [&](int row) { return mesh.vertices[mesh.boundary[row].vertices[0]]; };
  const auto farthest_from = [&](const Eigen::Vector2d& x) {
    return *std::ranges::max_element(rows, {},
                                     [&](int row) { return (start(row) - x).squaredNorm(); });
  };
  if (rows.empty()) return;
  const int first = farthest_from(centre);
  if (support.along) {
    pins.push_back({first, larger_component(*support.along)});
    return;
  }
  const int second = farthest_from(start(first));
  if (second == first) return;
  const Eigen::Vector2d d = start(second) - start(first);
  pins.push_back({first, 0});
  pins.push_back({first, 1});
  pins.push_back({second, larger_component({-d.y(), d.x()})});
}

}  // namespace

std::vector<PieceSupport> supports_of(const Mesh& mesh, const std::vector<bool>& rollers,
                                      const std::vector<PointSupport>& points,
                                      const MeshPieces& pieces) {
  std::vector<PieceSupport> supports(static_cast<std::size_t>(pieces.count));
  for (const PointSupport& point : points)
    if (const auto place = place_in_mesh(mesh, point))
      supports[pieces.of_vertex[mesh.triangles[place->triangle][0]]].has_points = true;
  for (std::size_t row = 0; row < mesh.boundary.size(); ++row) {
    const auto [a, b] = mesh.boundary[row].vertices;
    PieceSupport& own = supports[pieces.of_vertex[a]];
    own.in_contact |= mesh.boundary[row].role == BoundaryRole::contact;
    if (mesh.boundary[row].role != BoundaryRole::displacement || !own.is_free) continue;
    if (rollers.empty() || !rollers[row]) {
      own.is_free = false;
      continue;
    }
    const EdgeFrame frame = edge_frame(mesh.vertices[a], mesh.vertices[b]);
    if (!own.along) own.along = frame.tangent;
    own.is_free = std::abs(frame.normal.dot(*own.along)) <= straight_roller;
  }
  return supports;
}

Eigen::Vector2d FreeMotions::at(const Eigen::Vector2d& x, int vertex) const {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (Eigen::Index m = 0; m < amounts_mm.size(); ++m)
    if (motions[m].piece == piece_of_vertex[vertex])
      sum += amounts_mm(m) * motions[m].of_one_mm.at(x);
  return sum;
}

bool FreeMotions::pins_down(int row, int end, int component) const {
  return end == 0 && std::ranges::any_of(pins, [&](const Pin& pin) {
           return pin.row == row && pin.component == component;
         });
}

FreeMotions free_motions(const Mesh& mesh, const std::vector<bool>& rollers,
                         const std::vector<PointSupport>& points, const MeshPieces& pieces) {
  FreeMotions result;
  const std::vector<PieceSupport> supports = supports_of(mesh, rollers, points, pieces);
  const auto is_free = [](const PieceSupport& own) {
    return own.is_free && (own.in_contact || own.has_points);
  };
  if (std::ranges::none_of(supports, is_free)) return result;
  result.piece_of_vertex = pieces.of_vertex;
  for (int piece = 0; piece < pieces.count; ++piece) {
    const PieceSupport& own = supports[piece];
    if (!is_free(own)) continue;
    const PlaneArea area = plane_area(mesh, pieces.of_vertex, piece);
    for (const RigidMotion& motion : motions_of(own, area))
      result.motions.push_back({piece, motion, area.mm2});
    std::vector<int> rows;
    for (int row = 0; row < static_cast<int>(mesh.boundary.size()); ++row)
      if (const BoundaryEdge& edge = mesh.boundary[row];
          edge.role == BoundaryRole::force && pieces.of_vertex[edge.vertices[0]] == piece)
        rows.push_back(row);
    add_pins(mesh, rows, own, area.centroid, result.pins);
  }
  return result;
}

std::string place_of_piece(const Mesh& mesh, const std::vector<int>& piece_of_vertex, int piece) {
  const auto v = std::ranges::find(piece_of_vertex, piece) - piece_of_vertex.begin();
  return "the piece at the vertex " + shown(mesh.vertices[static_cast<std::size_t>(v)]);
}

std::string name_of_piece(const Mesh& mesh, const std::vector<int>& piece_of_vertex, int piece) {
  std::set<int> bodies, of_others;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    (piece_of_vertex[mesh.triangles[t][0]] == piece ? bodies : of_others)
        .insert(mesh.triangle_body[t]);
  if (bodies.size() == 1 && !of_others.contains(*bodies.begin()))
    return "the body " + mesh.body_names[*bodies.begin()];
  return place_of_piece(mesh, piece_of_vertex, piece);
}

}  // namespace airybench
