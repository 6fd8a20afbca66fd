// VTK's unstructured grids as XML, for ParaView. Arrays are base64 of their memory, so that every
// number is exact.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "assembly/problem.hpp"

namespace airybench {

struct VtuArray {
  std::string name;                     // with its unit
  std::vector<std::string> components;  // names; empty: one component
  std::variant<std::vector<double>, std::vector<std::int32_t>> values;  // component by component
};
// Adds z = 0.
VtuArray vtu_vectors(const std::string& name, const std::vector<Eigen::Vector2d>& vectors);

enum class VtuCell : std::uint8_t { line = 3, triangle = 5 };  // VTK's own numbers

// Cells share no points, so that values at points may jump between cells.
struct VtuGrid {
  VtuCell cell = VtuCell::triangle;
  std::vector<Eigen::Vector2d> points;  // mm; two per line, three per triangle, cell by cell
  std::vector<VtuArray> of_points, of_cells;
};

std::string vtu_text(const VtuGrid& grid);

}  // namespace airybench
