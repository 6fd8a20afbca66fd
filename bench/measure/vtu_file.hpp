// VTK's unstructured grids as XML, which ParaView opens. Arrays are in base64, as they are in
// memory, so that every number comes back to the last bit.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "assembly/problem.hpp"

namespace airybench {

struct VtuArray {
  std::string name;                     // with its unit
  std::vector<std::string> components;  // their names; empty: one component
  std::variant<std::vector<double>, std::vector<std::int32_t>> values;  // component by component
};
// With a z that is 0.
VtuArray vtu_vectors(const std::string& name, const std::vector<Eigen::Vector2d>& vectors);

enum class VtuCell : std::uint8_t { line = 3, triangle = 5 };  // VTK's own numbers

// Cells that share no points: what is given at points may jump between cells.
struct VtuGrid {
  VtuCell cell = VtuCell::triangle;
  std::vector<Eigen::Vector2d> points;  // mm; two of a line, three of a triangle, cell by cell
  std::vector<VtuArray> of_points, of_cells;
};

std::string vtu_text(const VtuGrid& grid);

}  // namespace airybench
