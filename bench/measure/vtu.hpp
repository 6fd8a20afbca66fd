// VTK's unstructured grids as XML (.vtu), for ParaView. Arrays are base64 of their memory, so that
// every number is exact.
#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace airybench {

enum class VtuCell : std::uint8_t {  // VTK's own numbers
  poly_line = 4,
  triangle = 5,
  lagrange_triangle = 69
};

// Weights of a Lagrange triangle's corners at its points, in VTK's order, times the degree: the
// corners, the sides 01, 12, 20 without them, then the same of the triangle inside.
std::vector<std::array<int, 3>> lagrange_points(int degree);

// Cells share no points, so that values at points may jump between cells.
struct VtuGrid {
  VtuCell cell = VtuCell::triangle;
  std::vector<Eigen::Vector2d> points;  // mm, cell by cell
  std::string of_points, of_cells;      // arrays
  std::size_t per_cell = 3;             // points
};

std::string base64(std::string_view bytes);

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

// values: component by component.
template <typename Number>
std::string vtu_array(const std::string& name, const std::vector<Number>& values,
                      const std::vector<std::string>& components = {}) {
  std::string attributes = fmt::format("Name=\"{}\"", name);
  if (!components.empty())
    attributes += fmt::format(" NumberOfComponents=\"{}\"", components.size());
  for (std::size_t k = 0; k < components.size(); ++k)
    attributes += fmt::format(" ComponentName{}=\"{}\"", k, components[k]);
  return data_array(attributes, values);
}

std::string vtu_vectors(const std::string& name, const std::vector<Eigen::Vector2d>& vectors);

std::string vtu_text(const VtuGrid& grid);

}  // namespace airybench
