#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <sstream>

#include "bench/commands/command_line.hpp"
#include "bench/commands/commands.hpp"
#include "bench/commands/part_solution.hpp"
#include "bench/commands/planned_cases.hpp"
#include "bench/commands/run_parts.hpp"
#include "bench/measure/environment.hpp"
#include "bench/plan/published_case.hpp"
#include "bench/records/case_name.hpp"
#include "bench/records/json_value.hpp"
#include "solvers/methods.hpp"
#include "support/atomic_file.hpp"
#include "support/errors.hpp"
#include "support/file_text.hpp"
#include "support/folder_lock.hpp"
#include "support/lagrange.hpp"
#include "support/lists.hpp"
#include "support/text_table.hpp"
#include "support/this_process.hpp"

namespace airybench {
namespace {

constexpr const char* validate_footer = R"(
HYBRID adapts the mesh of each case to a total error. The table has the published values, ours with their intervals, the deviation, and
what is allowed and why. --method and --external run more methods on the adapted meshes; displacement methods have values at points only.
Without EXTERNAL:NAME in --method all programs of --external run.
In OUT: records, fields, meshes, and validation.json with the table.

Exit status  0  every value of the method that adapted the mesh agrees
             1  some do not, or a case is not solved
             2  wrong usage, or a file that cannot be used: one line on standard error

Examples
  {bench} validate
  {bench} validate 'hertz*,kirsch*' --external=mine.json
)";

// Our numbers for those published, and half the width of the interval of a single one, or of the
// largest pressure of a profile.
struct Found {
  std::vector<double> values;  // none: it is not known
  std::optional<double> off = {};
};

// Rows of an edge in NAME.faces.csv, at s = 0, 1/4 … 1 along it.
constexpr std::size_t per_edge = 5;
struct FaceEdge {
  std::array<Eigen::Vector2d, per_edge> at_mm;
  std::array<double, per_edge> value;

  // The polynomial through these, which the column is.
  double operator()(double s) const {
    const LagrangeBasis<double> basis(per_edge - 1, s);
    return std::inner_product(value.begin(), value.end(), basis.value.begin(), 0.);
  }
};

// A column of a face; empty: there is none.
std::vector<FaceEdge> edges_of(const std::string& csv, const std::string& face,
                               const std::string& name) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> header = split_list(line);
  const auto column = static_cast<std::size_t>(std::ranges::find(header, name) - header.begin());
  std::vector<FaceEdge> edges;
  for (std::size_t row = 0; std::getline(lines, line);) {
    const std::vector<std::string> cells = split_list(line);
    if (cells[0] != face || cells[column].empty()) continue;
    const std::size_t place = row++ % per_edge;
    if (place == 0) edges.emplace_back();
    edges.back().at_mm[place] = {std::stod(cells[2]), std::stod(cells[3])};
    edges.back().value[place] = std::stod(cells[column]);
  }
  return edges;
}

// The column of a face at points, of its polyline the nearest.
Found on_face(const std::string& csv, const PublishedQuantity& asked) {
  const std::vector<FaceEdge> edges = edges_of(csv, asked.face, asked.of);
  if (edges.empty()) return {};
  const auto value_at = [&](const Eigen::Vector2d& x) {
    double nearest = std::numeric_limits<double>::infinity(), value = 0;
    for (const FaceEdge& edge : edges)
      for (std::size_t k = 1; k < per_edge; ++k) {
        const Eigen::Vector2d side = edge.at_mm[k] - edge.at_mm[k - 1],
                              from = x - edge.at_mm[k - 1];
        const double t = std::clamp(from.dot(side) / side.squaredNorm(), 0., 1.);
        if (const double distance = (from - t * side).norm(); distance < nearest) {
          nearest = distance;
          value = edge((static_cast<double>(k - 1) + t) / (per_edge - 1));
        }
      }
    return value;
  };
  Found found;
  std::ranges::transform(asked.at_mm, std::back_inserter(found.values), value_at);
  return found;
}

Found of_face(const Json& part, const PublishedQuantity& asked) {
  for (const Json& face : part.at("faces")) {
    const auto labels = face.at("labels").get<std::vector<std::string>>();
    if (face.at("name") != asked.face && std::ranges::count(labels, asked.face) == 0) continue;
    const Json& value = face.at(asked.of);
    const Json* interval = nullptr;
    if (asked.of == "pressure_MPa" && value.contains("in")) interval = &value["in"];
    if (asked.of == "normal_N" && face.contains("normal_in_N")) interval = &face["normal_in_N"];
    Found found{{(value.is_object() ? value.at("value") : value).get<double>()}};
    if (interval != nullptr)
      found.off = ((*interval)[1].get<double>() - (*interval)[0].get<double>()) / 2;
    return found;
  }
  return {};
}

// points: NAME.points.json, those of all quantities of the case.
Found at_points(const Json& points, const PublishedQuantity& asked) {
  static const std::map<std::string, std::pair<const char*, std::size_t>> places = {
      {"sxx_MPa", {"stress_MPa", 0}},
      {"syy_MPa", {"stress_MPa", 1}},
      {"sxy_MPa", {"stress_MPa", 2}},
      {"ux_mm", {"displacement_mm", 0}},
      {"uy_mm", {"displacement_mm", 1}}};
  const auto& [member, component] = places.at(asked.of);
  Found found;
  for (const Eigen::Vector2d& x : asked.at_mm)
    for (const Json& point : points)
      if (point.at("at_mm") == Json{x.x(), x.y()} && point.contains(member) &&
          !point[member].is_null()) {
        found.values.push_back(point[member][component].get<double>());
        break;
      }
  return found.values.size() == asked.values.size() ? found : Found();
}

Found of_part(const Record& record, const Json& part, const PublishedQuantity& asked) {
  if (asked.of == "strain_energy_Nmm")
    return record.strain_energy_Nmm ? Found{{*record.strain_energy_Nmm}} : Found();
  if (part.is_null() || !part.contains(asked.of)) return {};
  const Json& value = part[asked.of];
  Found found{{value.at("value").get<double>()}};
  if (value.contains("off")) found.off = value["off"].get<double>();
  return found;
}

// fields: of the case, without extensions.
Found found(const Record& record, const std::filesystem::path& fields,
            const PublishedQuantity& asked) {
  const auto text_of = [&](const char* ending) -> std::string {
    const std::string file = fields.string() + ending;
    std::error_code error;
    return std::filesystem::exists(file, error) ? file_text(file) : "";
  };
  const auto json_in = [&](const char* ending) {
    const std::string text = text_of(ending);
    return text.empty() ? Json() : parse_json(text);
  };
  const bool is_of_face = !asked.face.empty(), is_at_points = !asked.at_mm.empty();
  const Json part = is_at_points && !is_of_face ? Json() : json_in(".answer.json");
  Found found;
  if (is_of_face && is_at_points) {
    found = on_face(text_of(".faces.csv"), asked);
    if (asked.is_profile() && asked.of == "pressure_MPa" && !part.is_null())
      found.off = of_face(part, asked).off;
  } else if (is_at_points) {
    found = at_points(json_in(".points.json"), asked);
  } else if (!is_of_face) {
    found = of_part(record, part, asked);
  } else if (!part.is_null()) {
    found = of_face(part, asked);
  }
  for (double& value : found.values) value *= asked.times;
  if (found.off) *found.off *= std::abs(asked.times);
  return found;
}

struct Judged {
  const PublishedCase* of;
  const PublishedQuantity* quantity;
  std::string method;
  Record record;
  Found ours;
  bool is_of_adaptation;  // by the method that adapted the mesh, whose values decide

  // The largest, with its sign, relative to the largest value; where all are zero absolute.
  std::optional<double> deviation() const {
    std::optional<double> worst;
    const double size = quantity->largest() > 0 ? quantity->largest() : 1;
    for (std::size_t k = 0; k < ours.values.size(); ++k) {
      const double off = (ours.values[k] - quantity->values[k]) / size;
      if (!worst || !(std::abs(off) <= std::abs(*worst))) worst = off;
    }
    return worst;
  }
  bool agrees() const {
    const std::optional<double> off = deviation();
    return off && std::abs(*off) <= quantity->allowed;
  }
  std::string verdict() const {
    if (!has_answer(record.status)) return std::string(name_of(record.status));
    return ours.values.empty() ? "not known" : agrees() ? "agrees" : "differs";
  }
};

std::string table_of(const std::vector<Judged>& all) {
  std::vector<std::vector<std::string>> rows = {{"case", "method", "quantity", "published", "ours",
                                                 "±", "deviation", "allowed", "error total",
                                                 "verdict"}};
  const auto number = [](const std::optional<double>& x) {
    return x ? fmt::format("{:.2g}", *x) : std::string("-");
  };
  const auto values = [](const std::vector<double>& of) {
    return of.empty()      ? std::string("-")
           : of.size() > 1 ? fmt::format("{} points", of.size())
                           : fmt::format("{:.6g}", of.front());
  };
  for (const Judged& j : all) {
    const std::optional<double> deviation = j.deviation();
    rows.push_back(
        {j.of->name, j.method, j.quantity->name,
         fmt::format("{} {}", values(j.quantity->values), j.quantity->unit), values(j.ours.values),
         number(j.ours.off), deviation ? fmt::format("{:+.3f} %", 100 * *deviation) : "-",
         fmt::format("{:g} %", 100 * j.quantity->allowed),
         j.record.error_total ? fmt::format("{:.2g} %", 100 * *j.record.error_total) : "-",
         j.verdict()});
  }
  return aligned_table(rows, 3);
}

Json json_of(const PublishedCase& of) {
  Json quantities = Json::array();
  for (const PublishedQuantity& quantity : of.quantities) {
    Json points = Json::array();
    for (const Eigen::Vector2d& x : quantity.at_mm) points.push_back({x.x(), x.y()});
    quantities.push_back({{"name", quantity.name},
                          {"unit", quantity.unit},
                          {"formula", quantity.formula},
                          {"at_mm", points},
                          {"published", quantity.values},
                          {"allowed", quantity.allowed},
                          {"because", quantity.because}});
  }
  return {{"case", of.name},
          {"title", of.title},
          {"source", of.source},
          {"quantities", quantities},
          {"answers", Json::array()}};
}

// Per case its quantities, and the answers of methods, with a value per quantity.
Json json_of(const std::vector<Judged>& all) {
  Json cases = Json::array();
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Judged& j = all[k];
    const bool is_new_case = k == 0 || all[k - 1].of != j.of;
    if (is_new_case) cases.push_back(json_of(*j.of));
    Json& answers = cases.back()["answers"];
    if (is_new_case || all[k - 1].method != j.method)
      answers.push_back({{"method", j.method},
                         {"case_name", j.record.case_name},
                         {"status", name_of(j.record.status)},
                         {"reason", j.record.status_reason},
                         {"error_total", or_null(j.record.error_total)},
                         {"time_s", or_null(j.record.time_s)},
                         {"loop_time_s", or_null(j.record.adapt_time_s)},
                         {"values", Json::array()}});
    answers.back()["values"].push_back({{"ours", j.ours.values},
                                        {"off", or_null(j.ours.off)},
                                        {"deviation", or_null(j.deviation())},
                                        {"verdict", j.verdict()}});
  }
  return cases;
}

struct AskedCases {
  std::string cases;
  std::string methods;  // besides HYBRID
  std::vector<std::filesystem::path> externals;
  Options options = options_of_part();
};

AskedCases parse(int argc, const char* const* argv) {
  AskedCases asked;
  asked.options.output.folder = "results/validate";
  CLI::App app("Compares airybench with published closed forms and benchmarks.",
               "{bench} validate");
  app.footer(validate_footer);
  app.add_option("CASE", asked.cases, "names or globs, separated by commas; default: all");
  app.add_option("--method", asked.methods, "more methods, on the adapted meshes");
  add_files(app, "--external", asked.externals, "declarations of other programs");
  add_number(app, "--timeout", Least::above_zero, max_limit, asked.options.limits.timeout_s,
             "limit of one solve in seconds");
  app.add_option("--out", asked.options.output.folder, "folder of the output files")
      ->capture_default_str();
  parse_command_line(app, argc, argv);
  return asked;
}

// Of one case: HYBRID on adapted meshes, then the others on the last.
void judge(const PublishedCase& of, const AskedCases& asked, std::vector<Judged>& all) {
  Options options = asked.options;
  options.run.meshes = of.model.string();
  options.run.cases.points_mm = of.points_mm();
  const PartGoal goal{of.error, PartQuantity::energy};
  ask_for(goal, of.degree, options);
  if (!of.asks_largest_stress()) options.run.adapt.stress_error.reset();
  std::vector<SceneFile> scenes =
      of.scene ? std::vector<SceneFile>{*of.scene} : read_scenes(options.run);
  const std::vector<PosedScene> posed = posed_scenes(options, std::move(scenes));
  // Levels of the run that this one replaces, which the records so far would seem to need.
  std::filesystem::remove_all(options.output.folder / "meshes" / posed.front().scene_name);
  const auto add = [&](const Record& record, const std::filesystem::path& fields, bool is_first) {
    for (const PublishedQuantity& quantity : of.quantities)
      all.push_back(
          {&of, &quantity, record.method, record, found(record, fields, quantity), is_first});
  };
  const std::vector<Method> others = other_programs(asked.externals, options.limits);
  const bool takes_all = !others.empty() && asked.methods.find("EXTERNAL:") == std::string::npos;
  const std::string names = asked.methods + (!takes_all              ? ""
                                             : asked.methods.empty() ? "EXTERNAL:*"
                                                                     : ",EXTERNAL:*");
  std::vector<Method> more = names.empty() ? std::vector<Method>() : select_methods(names, others);
  std::erase_if(more, [&](const Method& m) { return m.name == options.run.methods; });
  const std::optional<SolvedPart> solved = solved_part(posed.front(), options, goal, more);
  if (!solved) {
    Record none;
    none.conclude({Status::breakdown, "no level has an answer"});
    return add(none, {}, true);
  }
  for (std::size_t k = 0; k < solved->result.names.size(); ++k) {
    const Record record = solved->result.record(k);
    add(record, options.output.folder / "fields" / name_of(record).file(), k == 0);
  }
}

}  // namespace

int validate_command(int argc, const char* const* argv) {
  AskedCases asked = parse(argc, argv);
  const std::vector<PublishedCase> cases = published_cases(asked.cases);
  check_takes_records(asked.options.output.folder);
  catch_interrupts();
  make_folder(asked.options.output.folder);
  const FolderLock lock(asked.options.output.folder);  // its meshes and fields are read again
  set_threads(asked.options.run.cases.threads);
  std::vector<Judged> all;
  for (const PublishedCase& of : cases) {
    judge(of, asked, all);
    asked.options.output.append = true;  // to the records of the first
  }
  fmt::print("\n{}\n", table_of(all));
  write_file_atomically(asked.options.output.folder / "validation.json",
                        indented_json_text(json_of(all), 1) + "\n");
  const auto differs = [](const Judged& j) { return j.is_of_adaptation && !j.agrees(); };
  const auto count = std::ranges::count_if(all, differs);
  fmt::print("{} cases, {} values; {} of the adapting method's differ\n", cases.size(), all.size(),
             count);
  return count == 0 ? all_ok : some_case_failed;
}

}  // namespace airybench
