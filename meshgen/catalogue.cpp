#include "meshgen/catalogue.hpp"

#include <algorithm>
#include <stdexcept>

#include "meshgen/tooth_mesh.hpp"

namespace airybench {

const CatalogueRow& catalogue_row(std::string_view name) {
  const auto found = std::find_if(catalogue.begin(), catalogue.end(),
                                  [&](const auto& r) { return r.name == name; });
  if (found == catalogue.end())
    throw std::invalid_argument("mesh '" + std::string(name) +
                                "': not in the catalogue (valid: Mesh0..Mesh7)");
  return *found;
}

Mesh make_catalogue_mesh(const CatalogueRow& row) {
  ToothDimensions dimensions;
  dimensions.teeth = row.teeth;
  return tooth_mesh(dimensions, row.edges, row.vertices, std::string(row.name));
}

}  // namespace airybench
