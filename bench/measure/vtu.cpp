#include "bench/measure/vtu.hpp"

#include <bit>
#include <numeric>

namespace airybench {

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const std::string_view three = bytes.substr(k, 3);
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 3; ++i)
      bits = bits << 8 | (i < three.size() ? static_cast<unsigned char>(three[i]) : 0U);
    for (std::size_t i = 0; i < 4; ++i)
      text += i <= three.size() ? digits[bits >> (18 - 6 * i) & 63] : '=';
  }
  return text;
}

namespace {

std::vector<double> with_z(const std::vector<Eigen::Vector2d>& vectors) {
  std::vector<double> xyz;
  for (const Eigen::Vector2d& vector : vectors) xyz.insert(xyz.end(), {vector.x(), vector.y(), 0});
  return xyz;
}

}  // namespace

std::vector<std::array<int, 3>> lagrange_points(int degree) {
  std::vector<std::array<int, 3>> points;
  for (int outside = 0; 3 * outside <= degree; ++outside) {
    const int n = degree - 3 * outside;  // of the triangle that remains
    const auto add = [&](int a, int b, int c) {
      points.push_back({outside + a, outside + b, outside + c});
    };
    add(n, 0, 0);
    if (n == 0) break;
    add(0, n, 0);
    add(0, 0, n);
    for (int i = 1; i < n; ++i) add(n - i, i, 0);
    for (int i = 1; i < n; ++i) add(0, n - i, i);
    for (int i = 1; i < n; ++i) add(i, 0, n - i);
  }
  return points;
}

std::string vtu_vectors(const std::string& name, const std::vector<Eigen::Vector2d>& vectors) {
  return vtu_array(name, with_z(vectors), {"x", "y", "z"});
}

static std::string cells_text(VtuCell cell, std::size_t points, std::size_t corners) {
  std::vector<std::int64_t> connectivity(points), offsets;
  std::iota(connectivity.begin(), connectivity.end(), 0);
  for (std::size_t end = corners; end <= points; end += corners)
    offsets.push_back(static_cast<std::int64_t>(end));
  const std::vector<std::uint8_t> types(offsets.size(), static_cast<std::uint8_t>(cell));
  return "<Cells>\n" + data_array("Name=\"connectivity\"", connectivity) +
         data_array("Name=\"offsets\"", offsets) + data_array("Name=\"types\"", types) +
         "</Cells>\n";
}

std::string vtu_text(const VtuGrid& grid) {
  const std::size_t points = grid.points.size(), corners = grid.per_cell;
  constexpr bool is_little = std::endian::native == std::endian::little;
  return fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"{}\" "
      "header_type=\"UInt64\">\n"
      "<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n"
      "<PointData>\n{}</PointData>\n<CellData>\n{}</CellData>\n"
      "<Points>\n{}</Points>\n{}</Piece>\n</UnstructuredGrid>\n</VTKFile>\n",
      is_little ? "LittleEndian" : "BigEndian", points, points / corners, grid.of_points,
      grid.of_cells, data_array("NumberOfComponents=\"3\"", with_z(grid.points)),
      cells_text(grid.cell, points, corners));
}

}  // namespace airybench
