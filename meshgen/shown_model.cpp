#include "meshgen/shown_model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "meshgen/roles.hpp"
#include "support/text_table.hpp"

namespace airybench {

std::string table_of(const PlaneModel& model) {
  constexpr std::size_t most = 40;
  const auto place = [&](const Eigen::Vector2d& p) {
    const auto zero = [](double x) { return x == 0 ? 0. : x; };  // no "-0"
    return fmt::format("({:.4g}, {:.4g})", zero(p.x()), zero(p.y()));
  };
  std::vector<std::vector<std::string>> rows = {
      {"curve", "names", "role", "length mm", "from", "by", "to"}};
  std::size_t left_out = 0;
  for (const ModelCurve& curve : model.curves) {
    if (curve.sides.empty()) continue;
    if (rows.size() > most) {
      ++left_out;
      continue;
    }
    double length = 0;
    for (const auto& [a, b] : curve.sides)
      length += (model.position.at(b) - model.position.at(a)).norm();
    const std::vector<std::size_t> walk = walks_of(curve).front();
    const auto at = [&](std::size_t k) { return model.position.at(walk[k]); };
    const std::size_t middle = walk.size() / 2;
    const Eigen::Vector2d by =
        walk.size() % 2 == 0 ? Eigen::Vector2d((at(middle - 1) + at(middle)) / 2) : at(middle);
    rows.push_back({std::to_string(curve.number),
                    curve.is_named() ? fmt::format("{}", fmt::join(curve.names, ", ")) : "-",
                    curve.label.empty() ? "-" : curve.label, fmt::format("{:.4g}", length),
                    place(at(0)), place(by), place(at(walk.size() - 1))});
  }
  std::string table;
  std::istringstream lines(aligned_table(rows, rows.front().size()));
  for (std::string line; std::getline(lines, line);)
    table += (table.empty() ? "  " : "\n  ") + line;
  if (left_out > 0) table += fmt::format("\n  … and {} more", left_out);
  return table;
}

// The role that its names may mean, if it is given none.
static std::string perhaps_of(const ModelCurve& curve) {
  if (curve.is_unnamed_role)
    for (const std::string& name : curve.names)
      if (const std::string role = role_meant_by(name); !role.empty()) return role;
  return "";
}

std::string json_of(const PlaneModel& model, const std::string& name) {
  using Json = nlohmann::ordered_json;
  const auto pair = [](const Eigen::Vector2d& p) { return Json::array({p.x(), p.y()}); };
  Json json = {{"model", name},
               {"bodies", model.body_names},
               {"vertices_mm", Json::array()},
               {"triangles", Json::array()},
               {"curves", Json::array()}};
  std::map<std::size_t, int> row;
  for (const auto& [node, p] : model.position) {
    row.emplace(node, static_cast<int>(row.size()));
    json["vertices_mm"].push_back(pair(p));
  }
  for (const ModelTriangle& triangle : model.triangles) {
    const auto& [a, b, c] = triangle.nodes;
    json["triangles"].push_back({row[a], row[b], row[c]});
  }
  for (const ModelCurve& curve : model.curves) {
    if (curve.sides.empty()) continue;
    Json walks = Json::array();
    for (const std::vector<std::size_t>& walk : walks_of(curve)) {
      Json& places = walks.emplace_back(Json::array());
      for (const std::size_t node : walk) places.push_back(pair(model.position.at(node)));
    }
    json["curves"].push_back({{"number", curve.number},
                              {"names", curve.names},
                              {"role", curve.label},
                              {"perhaps", perhaps_of(curve)},
                              {"walks_mm", std::move(walks)}});
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace airybench
