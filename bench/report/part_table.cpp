#include "bench/report/part_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "bench/records/summary.hpp"
#include "support/text_table.hpp"

namespace airybench {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string number(double value) { return fmt::format("{:.5g}", value); }
std::string place(const Json& x) {
  return fmt::format("({:.5g}, {:.5g})", x[0].get<double>(), x[1].get<double>());
}
// What is small next to the largest force is the solver's rounding.
class Forces {
 public:
  explicit Forces(const Json& part) {
    for (const char* kind : {"faces", "supports"})
      for (const Json& one : part[kind])
        for (const Json& component : one["force_N"])
          largest_ = std::max(largest_, std::abs(component.get<double>()));
  }
  std::string text(double force) const {
    constexpr double rounding = 1e-6;
    return number(std::abs(force) <= rounding * largest_ ? 0 : force);
  }
  std::string both(const Json& of) const {
    return fmt::format("{}, {}", text(of[0].get<double>()), text(of[1].get<double>()));
  }

 private:
  double largest_ = 0;
};

std::string within(const std::optional<double>& low, const std::optional<double>& high) {
  return low && high ? fmt::format(" in [{:.5g}, {:.5g}]", *low, *high) : "";
}

// " ± 2.3": no end of the interval is farther from the value; empty: there is none.
std::string off(const Json& of, const char* interval, double value) {
  if (!of.contains(interval)) return "";
  const double low = of[interval][0], high = of[interval][1];
  return fmt::format(" ± {:.2g}", std::max(high - value, value - low));
}
std::string peak(const Json& pressure) {
  const double value = pressure["value"];
  if (!(value > 0)) return "-";
  const std::string is = pressure.value("is", "");
  if (is == "unbounded") return is;
  return number(value) + (is == "not seen" ? " or unbounded" : off(pressure, "in", value));
}

Rows faces_table(const Json& part, const Forces& forces) {
  if (part["faces"].empty()) return {};
  Rows rows = {{"contact", "force x, y N", "F_n N", "F_t N", "peak MPa", "at mm", "closed mm",
                "of that slips mm"}};
  const auto force = [&](const Json& face, const char* value, const char* interval) {
    return forces.text(face[value].get<double>()) + off(face, interval, face[value].get<double>());
  };
  for (const Json& face : part["faces"]) {
    const double closed = face["closed_mm"], length = face["length_mm"];
    const Json& pressure = face["pressure_MPa"];
    rows.push_back({face["name"], forces.both(face["force_N"]),
                    force(face, "normal_N", "normal_in_N"),
                    force(face, "tangential_N", "tangential_in_N"), peak(pressure),
                    pressure["value"] > 0. ? place(pressure["at_mm"]) : "-",
                    fmt::format("{:.4g} of {:.4g}", closed, length),
                    closed > 0 ? fmt::format("{:.4g}", face["slipping_mm"].get<double>()) : "-"});
  }
  return rows;
}

Rows supports_table(const Json& part, const Forces& forces) {
  if (part["supports"].empty()) return {};
  Rows rows = {{"support", "force x, y N", ""}};
  for (const Json& support : part["supports"])
    rows.push_back({support["name"], forces.both(support["force_N"]), ""});
  return rows;
}

std::string value_and_off(const Json& largest) {
  return fmt::format(
      "{:.5g}{}", largest["value"].get<double>(),
      largest.contains("off") ? fmt::format(" ± {:.2g}", largest["off"].get<double>()) : "");
}

Rows bodies_table(const Json& part) {
  if (part["bodies"].empty()) return {};
  Rows rows = {{"body", "von Mises MPa", "at mm", "principal MPa", "at mm", ""}};
  for (const Json& body : part["bodies"]) {
    std::vector<std::string> row = {body["name"]};
    for (const char* key : {"von_mises_MPa", "principal_MPa"})
      row.insert(row.end(), {value_and_off(body[key]), place(body[key]["at_mm"])});
    row.emplace_back();
    rows.push_back(std::move(row));
  }
  return rows;
}

void add_contact_lines(const Record& r, PartReport& report) {
  if (!r.largest_pressure_MPa || *r.largest_pressure_MPa <= 0) return;
  if (r.normal_resultant_N)
    report.emplace_back(fmt::format("Σ F_n {:.5g} N{}{}", *r.normal_resultant_N,
                                    within(r.normal_resultant_low_N, r.normal_resultant_high_N),
                                    r.normal_resultant_low_N ? ", " + r.intervals : ""));
  if (r.largest_pressure_is == "unbounded") {
    report.emplace_back("largest pressure: unbounded, at a sharp edge");
    return;
  }
  std::string text = fmt::format("largest pressure {:.5g} MPa{}", *r.largest_pressure_MPa,
                                 within(r.largest_pressure_low_MPa, r.largest_pressure_high_MPa));
  if (r.largest_pressure_is != "bounded")
    text += ": where contact ends sharply the exact one may be infinite";
  report.emplace_back(std::move(text));
}

constexpr double seen_of_path = 1e-3;

void add_path_line(const Record& r, PartReport& report) {
  if (!r.change_in_eight_steps) return;
  if (*r.change_in_eight_steps <= seen_of_path) {
    report.emplace_back(fmt::format("in eight load steps the stresses are the same to {:.1g} %",
                                    100 * seen_of_path));
    return;
  }
  const StepResult& last = r.in_eight_steps.back();
  report.emplace_back(fmt::format(
      "in eight load steps the stresses are {:.2g} % off in energy, Σ F_n {:.5g} N, F_t {:.5g} N, "
      "largest pressure {}: friction depends on the path of the load",
      100 * *r.change_in_eight_steps, *last.normal_resultant_N, *last.tangential_resultant_N,
      r.largest_pressure_is == "unbounded"
          ? "unbounded"
          : fmt::format("{:.5g} MPa", *last.largest_pressure_MPa)));
}

// By what they are, the first three of each.
void add_unbounded_line(const Json& places, PartReport& report) {
  constexpr std::size_t max_named = 3;
  std::map<std::string, std::vector<std::string>> by_what;
  double within_mm = 0;
  for (const Json& one : places) {
    by_what[one["what"]].push_back(place(one["at_mm"]));
    within_mm = std::max(within_mm, one["within_mm"].get<double>());
  }
  if (by_what.empty()) return;
  std::string text;
  for (auto& [what, all] : by_what) {
    const std::size_t more = all.size() - std::min(all.size(), max_named);
    all.resize(all.size() - more);
    text += fmt::format("{}{}{}: {}", text.empty() ? "" : "; ", fmt::join(all, ", "),
                        more > 0 ? fmt::format(" and {} more", more) : "", what);
  }
  report.emplace_back(
      fmt::format("stress unbounded at {} (largest: outside circles of up to {:.2g} mm there)",
                  text, within_mm));
}

void add_stress_lines(const Json& part, PartReport& report) {
  if (part.contains("free_motion"))
    report.emplace_back(
        fmt::format("largest displacement: not determined, {} (point_supports hold it)",
                    part["free_motion"].get<std::string>()));
  if (part.contains("displacement_mm"))
    report.emplace_back(fmt::format("largest displacement {:.5g} mm at {}",
                                    part["displacement_mm"]["value"].get<double>(),
                                    place(part["displacement_mm"]["at_mm"])));
  for (const auto& [name, key] :
       {std::pair("von Mises", "von_mises_MPa"), {"principal", "principal_MPa"}}) {
    const Json& largest = part[key];
    report.emplace_back(fmt::format("largest {} stress {} MPa at {}", name, value_and_off(largest),
                                    place(largest["at_mm"])));
  }
  add_unbounded_line(part["unbounded"], report);
}

std::string percent(const std::optional<double>& share) {
  return share ? fmt::format("{:.2g} %", 100 * *share) : "-";
}

// Of a face that nothing touches it is rounding.
std::string peak_of_step(const StepResult& step) {
  return step.largest_pressure_MPa && step.normal_resultant_N != 0.
             ? number(*step.largest_pressure_MPa)
             : "-";
}

Rows steps_table(const Record& record) {
  if (record.steps.size() < 2) return {};
  Rows rows = {{"step", "F_n N", "F_t N", "peak MPa", "energy N mm", "dissipation N mm",
                "error of the mesh", ""}};
  const auto cell = [](const std::optional<double>& value) {
    return value ? number(*value) : std::string("-");
  };
  for (std::size_t k = 0; k < record.steps.size(); ++k) {
    const StepResult& step = record.steps[k];
    rows.push_back({std::to_string(k + 1), cell(step.normal_resultant_N),
                    cell(step.tangential_resultant_N), peak_of_step(step),
                    cell(step.strain_energy_Nmm), cell(step.dissipation_Nmm),
                    percent(step.of_mesh.error_discretisation), ""});
  }
  return rows;
}

// Friction remembers: where a face slips, several load steps have another answer than one.
bool depends_on_path(const Record& record, const Json& part) {
  return record.tangential_resultant_N && record.steps.size() < 2 && !part.is_null() &&
         std::ranges::any_of(
             part["faces"], [](const Json& face) { return face["slipping_mm"].get<double>() > 0; });
}

// What the total error does not contain.
std::string words_of_path(const Record& r, const Json& part) {
  if (!depends_on_path(r, part)) return "";
  const std::optional<double>& change = r.change_in_eight_steps;
  if (!change) return "the path of the load (faces slip; this is one step, --steps=N makes more), ";
  return *change > seen_of_path ? "the path of the load, " : "";
}

std::string error_line(const Record& r, const Json& part) {
  if (!r.error_total)
    return fmt::format("total error unknown{}{}", r.no_discretisation_error.empty() ? "" : ": ",
                       r.no_discretisation_error);
  return fmt::format(
      "total error {:.2g} % in energy: mesh, curves and solver; not included: {}large strains, "
      "other laws of friction, errors of loads and supports",
      100 * *r.error_total, words_of_path(r, part));
}

}  // namespace

PartReport part_report(const Record& record, const Json& part) {
  PartReport report;
  const auto add_table = [&](Rows rows) {
    if (!rows.empty()) report.emplace_back(std::move(rows));
  };
  if (!part.is_null()) {
    const Forces forces(part);
    add_table(faces_table(part, forces));
    add_table(supports_table(part, forces));
    add_table(bodies_table(part));
    if (!part["faces"].empty()) {
      add_contact_lines(record, report);
      add_path_line(record, report);
    }
    add_stress_lines(part, report);
  }
  add_table(steps_table(record));
  if (record.strain_energy_Nmm)
    report.emplace_back(fmt::format("strain energy {:.5g} N mm", *record.strain_energy_Nmm));
  report.emplace_back(error_line(record, part));
  if (record.status != Status::ok)
    report.emplace_back(fmt::format("{}: {}", name_of(record.status), record.status_reason));
  else if (!record.status_reason.empty())
    report.emplace_back(fmt::format("note: {}", record.status_reason));
  return report;
}

std::string text_of(const PartReport& report) {
  std::string text;
  for (const auto& part : report)
    text += (part.index() == 0 ? std::get<0>(part) : aligned_table(std::get<1>(part), 1)) + "\n";
  return text;
}

Json to_json(const PartReport& report) {
  Json json = Json::array();
  for (const auto& part : report)
    std::visit([&](const auto& value) { json.push_back(value); }, part);
  return json;
}

}  // namespace airybench
