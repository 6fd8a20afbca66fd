#include "bench/measure/vtu_file.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <numeric>
#include <string_view>
#include <type_traits>

namespace airybench {
namespace {

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

template <typename Number>
std::string type_name() {
  const char* kind = std::is_floating_point_v<Number> ? "Float"
                     : std::is_signed_v<Number>       ? "Int"
                                                      : "UInt";
  return fmt::format("{}{}", kind, 8 * sizeof(Number));
}

template <typename Number>
std::string data_array(const std::string& attributes, const std::vector<Number>& values) {
  const std::uint64_t size = values.size() * sizeof(Number);
  std::string bytes(sizeof size + size, '\0');
  std::memcpy(bytes.data(), &size, sizeof size);
  if (size > 0) std::memcpy(bytes.data() + sizeof size, values.data(), size);
  return fmt::format("<DataArray type=\"{}\" {} format=\"binary\">{}</DataArray>\n",
                     type_name<Number>(), attributes, base64(bytes));
}

std::string attributes_of(const VtuArray& array) {
  std::string text = fmt::format("Name=\"{}\"", array.name);
  if (array.components.empty()) return text;
  text += fmt::format(" NumberOfComponents=\"{}\"", array.components.size());
  for (std::size_t k = 0; k < array.components.size(); ++k)
    text += fmt::format(" ComponentName{}=\"{}\"", k, array.components[k]);
  return text;
}

std::string data_arrays(const char* where, const std::vector<VtuArray>& arrays) {
  std::string text = fmt::format("<{}>\n", where);
  for (const VtuArray& array : arrays)
    text += std::visit([&](const auto& values) { return data_array(attributes_of(array), values); },
                       array.values);
  return text + fmt::format("</{}>\n", where);
}

std::string cells_text(VtuCell cell, std::size_t points, std::size_t corners) {
  std::vector<std::int64_t> connectivity(points), offsets;
  std::iota(connectivity.begin(), connectivity.end(), 0);
  for (std::size_t end = corners; end <= points; end += corners)
    offsets.push_back(static_cast<std::int64_t>(end));
  const std::vector<std::uint8_t> types(offsets.size(), static_cast<std::uint8_t>(cell));
  return "<Cells>\n" + data_array("Name=\"connectivity\"", connectivity) +
         data_array("Name=\"offsets\"", offsets) + data_array("Name=\"types\"", types) +
         "</Cells>\n";
}

}  // namespace

VtuArray vtu_vectors(const std::string& name, const std::vector<Eigen::Vector2d>& vectors) {
  std::vector<double> xyz;
  for (const Eigen::Vector2d& vector : vectors) xyz.insert(xyz.end(), {vector.x(), vector.y(), 0});
  return {name, {"x", "y", "z"}, std::move(xyz)};
}

std::string vtu_text(const VtuGrid& grid) {
  const std::size_t points = grid.points.size(), corners = grid.cell == VtuCell::line ? 2 : 3;
  const auto xyz = std::get<std::vector<double>>(vtu_vectors("points", grid.points).values);
  constexpr bool is_little = std::endian::native == std::endian::little;
  return fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"{}\" "
      "header_type=\"UInt64\">\n"
      "<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n"
      "{}{}<Points>\n{}</Points>\n{}</Piece>\n</UnstructuredGrid>\n</VTKFile>\n",
      is_little ? "LittleEndian" : "BigEndian", points, points / corners,
      data_arrays("PointData", grid.of_points), data_arrays("CellData", grid.of_cells),
      data_array("NumberOfComponents=\"3\"", xyz), cells_text(grid.cell, points, corners));
}

}  // namespace airybench
