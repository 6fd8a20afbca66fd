#include "bench/report/tracker_formats.hpp"

#include <fmt/format.h>

#include <array>
#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <map>
#include <set>
#include <sstream>

#include "bench/records/numbers.hpp"

namespace airybench {
namespace {

using Tree = boost::property_tree::ptree;

// XML 1.0 allows no other control characters, not even escaped.
std::string allowed_in_xml(const std::string& text) {
  std::string allowed;
  for (const char c : text)
    if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t')
      allowed += "\uFFFD";
    else
      allowed += c;
  return allowed;
}

Tree element(const std::vector<std::pair<std::string, std::string>>& attributes) {
  Tree tree;
  for (const auto& [name, value] : attributes) tree.put("<xmlattr>." + name, allowed_in_xml(value));
  return tree;
}

const char* outcome_of(Status status) {
  switch (status) {
    case Status::ok:
      return "";
    case Status::skipped:
    case Status::unstressed:
      return "skipped";
    case Status::crashed:
    case Status::machine_fault:
    case Status::timeout:
    case Status::out_of_memory:
      return "error";
    default:
      return "failure";
  }
}

std::string seconds(double value) { return fmt::format("{:.9f}", value); }

Tree testcase(const Record& record) {
  Tree test = element({{"name", variant_of(record)},
                       {"classname", record.mesh + "." + record.scene},
                       {"time", seconds(record.time_s.value_or(0))}});
  if (const std::string outcome = outcome_of(record.status); !outcome.empty()) {
    Tree reason = element({{"message", record.status_reason}});
    if (outcome != "skipped") reason.put("<xmlattr>.type", std::string(name_of(record.status)));
    test.add_child(outcome, reason);
  }
  return test;
}

Tree testsuite(const std::vector<Record>& cases, const Record& first) {
  Tree tests, properties;
  std::map<std::string, int> outcomes;
  double total_s = 0;
  for (const Record& record : cases) {
    if (record.mesh != first.mesh || record.scene != first.scene) continue;
    ++outcomes[outcome_of(record.status)];
    total_s += record.time_s.value_or(0);
    tests.push_back({"testcase", testcase(record)});
  }
  Tree suite = element({{"name", first.mesh + "/" + first.scene},
                        {"tests", std::to_string(tests.size())},
                        {"failures", std::to_string(outcomes["failure"])},
                        {"errors", std::to_string(outcomes["error"])},
                        {"skipped", std::to_string(outcomes["skipped"])},
                        {"time", seconds(total_s)}});
  if (const auto date = first.context.find("date"); date != first.context.end())
    suite.put("<xmlattr>.timestamp", allowed_in_xml(date->second));
  for (const auto& [key, value] : first.context)
    properties.push_back({"property", element({{"name", key}, {"value", value}})});
  if (!properties.empty()) suite.push_back({"properties", properties});
  suite.insert(suite.end(), tests.begin(), tests.end());
  return suite;
}

// What trackers get; github_units and bencher_units convert from the record's units.
struct Measure {
  const char *field, *github_name, *github_unit, *bencher_name;
  double github_units, bencher_units;
};
constexpr std::array<Measure, 4> measures = {
    {{"time_s", "time", "ms", "latency", 1e3, 1e9},
     {"peak_heap_bytes", "peak heap", "B", "peak-heap", 1, 1},
     {"error_stress", "error of the stresses", "relative", "error-stress", 1, 1},
     {"error_force", "error of the contact forces", "relative", "error-force", 1, 1}}};

// Of an answer: counts of a run that was stopped are lower bounds.
std::optional<double> value_in(const Record& record, const Measure& measure) {
  if (!has_answer(record.status)) return {};
  return number_in(record, field_named(measure.field));
}

std::optional<Interval> interval_in(const Record& record, const Measure& measure) {
  if (measure.field != std::string_view("time_s") || record.repetitions < 2) return {};
  return time_interval(record);
}

}  // namespace

std::string junit_xml(const std::vector<Record>& cases) {
  Tree suites;
  std::set<std::pair<std::string, std::string>> begun;
  for (const Record& record : cases)
    if (begun.insert({record.mesh, record.scene}).second)
      suites.push_back({"testsuite", testsuite(cases, record)});
  Tree document;
  document.push_back({"testsuites", suites});
  std::ostringstream text;
  boost::property_tree::write_xml(text, document,
                                  boost::property_tree::xml_writer_settings<std::string>(' ', 2));
  return text.str();
}

std::string github_action_json(const std::vector<Record>& cases) {
  Json entries = Json::array();
  for (const Record& record : cases) {
    std::string extra = fmt::format("status: {}", name_of(record.status));
    if (!record.status_reason.empty()) extra += "\n" + record.status_reason;
    for (const char* key : {"git_revision", "cpu"})
      if (const std::string word = context_word(record, key); !word.empty())
        extra += fmt::format("\n{}: {}", key, word);
    for (const Measure& measure : measures) {
      const auto value = value_in(record, measure);
      if (!value) continue;
      Json& entry = entries.emplace_back();
      entry["name"] = name_of(record).text() + " " + measure.github_name;
      entry["unit"] = measure.github_unit;
      entry["value"] = *value * measure.github_units;
      if (const auto interval = interval_in(record, measure))
        entry["range"] = fmt::format("{:.4g} to {:.4g}", interval->low * measure.github_units,
                                     interval->high * measure.github_units);
      entry["extra"] = extra;
    }
  }
  return indented_json_text(entries, 2) + "\n";
}

std::string bencher_json(const std::vector<Record>& cases) {
  Json all = Json::object();
  for (const Record& record : cases)
    for (const Measure& measure : measures) {
      const auto value = value_in(record, measure);
      if (!value) continue;
      Json& entry = all[name_of(record).text()][measure.bencher_name];
      entry["value"] = *value * measure.bencher_units;
      const auto interval = interval_in(record, measure);
      if (!interval) continue;
      entry["lower_value"] = interval->low * measure.bencher_units;
      entry["upper_value"] = interval->high * measure.bencher_units;
    }
  return indented_json_text(all, 2) + "\n";
}

}  // namespace airybench
