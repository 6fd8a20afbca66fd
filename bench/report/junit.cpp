#include "bench/report/junit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <sstream>

#include "bench/records/numbers.hpp"

namespace airybench {
namespace {

using Tree = boost::property_tree::ptree;

// XML 1.0 has no other control characters, not even escaped.
std::string allowed_in_xml(const std::string& text) {
  std::string allowed;
  for (const char c : text) {
    const bool control = static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t';
    if (control)
      allowed += "\uFFFD";
    else
      allowed += c;
  }
  return allowed;
}

void set_attribute(Tree& element, const std::string& name, const std::string& value) {
  element.put("<xmlattr>." + name, allowed_in_xml(value));
}

const char* element_for(Status status) {
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
  Tree test;
  set_attribute(test, "name", variant_of(record));
  set_attribute(test, "classname", record.mesh + "." + record.scene);
  set_attribute(test, "time", seconds(record.time_s.value_or(0)));
  if (const std::string element = element_for(record.status); !element.empty()) {
    Tree outcome;
    set_attribute(outcome, "message", record.status_reason);
    if (element != "skipped") set_attribute(outcome, "type", std::string(name_of(record.status)));
    test.add_child(element, outcome);
  }
  return test;
}

Tree testsuite(const std::vector<Record>& cases, const Record& first) {
  Tree suite, tests, properties;
  std::map<std::string, int> outcomes;
  int count = 0;
  double total_s = 0;
  for (const Record& record : cases) {
    if (record.mesh != first.mesh || record.scene != first.scene) continue;
    ++count;
    ++outcomes[element_for(record.status)];
    total_s += record.time_s.value_or(0);
    tests.push_back({"testcase", testcase(record)});
  }
  set_attribute(suite, "name", first.mesh + "/" + first.scene);
  set_attribute(suite, "tests", std::to_string(count));
  set_attribute(suite, "failures", std::to_string(outcomes["failure"]));
  set_attribute(suite, "errors", std::to_string(outcomes["error"]));
  set_attribute(suite, "skipped", std::to_string(outcomes["skipped"]));
  set_attribute(suite, "time", seconds(total_s));
  if (const auto date = first.context.find("date"); date != first.context.end())
    set_attribute(suite, "timestamp", date->second);
  for (const auto& [key, value] : first.context) {
    Tree property;
    set_attribute(property, "name", key);
    set_attribute(property, "value", value);
    properties.push_back({"property", property});
  }
  if (!properties.empty()) suite.push_back({"properties", properties});
  suite.insert(suite.end(), tests.begin(), tests.end());
  return suite;
}

}  // namespace

std::string junit_xml(const std::vector<Record>& cases) {
  Tree suites;
  for (auto first = cases.begin(); first != cases.end(); ++first) {
    const bool begins = std::none_of(cases.begin(), first, [&](const Record& other) {
      return other.mesh == first->mesh && other.scene == first->scene;
    });
    if (begins) suites.push_back({"testsuite", testsuite(cases, *first)});
  }
  Tree document;
  document.push_back({"testsuites", suites});
  std::ostringstream text;
  boost::property_tree::write_xml(text, document,
                                  boost::property_tree::xml_writer_settings<std::string>(' ', 2));
  return text.str();
}

}  // namespace airybench
