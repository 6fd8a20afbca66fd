#include "bench/commands/own_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/records/case_name.hpp"
#include "mesh/selection.hpp"

namespace airybench {
namespace {

namespace fs = std::filesystem;

// Also when adapted or refined: Mesh0+adapt3.
bool is_named_after_catalogue(const std::string& mesh) {
  const std::string body = mesh.substr(0, mesh.find('+'));
  return std::ranges::find(catalogue_mesh_names, body) != catalogue_mesh_names.end();
}

bool is_newer(const fs::path& file, const fs::path& than) {
  std::error_code error;
  return fs::exists(file, error) &&
         fs::last_write_time(file, error) >= fs::last_write_time(than, error);
}

}  // namespace

std::string picture_line(const std::vector<Record>& records, const fs::path& out, bool has_fields) {
  const auto last = std::find_if(records.rbegin(), records.rend(), [](const Record& r) {
    return r.n_phi && !is_named_after_catalogue(r.mesh);
  });
  if (last == records.rend()) return "";
  for (const Record& record : records) {
    if (!has_fields || record.mesh != last->mesh) continue;
    const std::string name = name_of(record).file();
    const fs::path grid = out / "fields" / (name + ".vtu"),
                   picture = out / "figures" / ("fields_" + name + ".png");
    std::error_code error;
    if (!fs::exists(grid, error)) continue;
    return is_newer(picture, grid)
               ? fmt::format("picture: {}  (ParaView: {})", picture.string(), grid.string())
               : fmt::format("ParaView: {}  (a picture: ./run figures {})", grid.string(),
                             out.string());
  }
  return fmt::format("for a picture of {}: --fields", last->mesh);
}

}  // namespace airybench
