#include "solvers/methods.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <stdexcept>

#include "assembly/elements/equilibrium_element.hpp"
#include "solvers/names/general_names.hpp"
#include "support/lists.hpp"
#include "support/shortened.hpp"

namespace airybench {

// A method is a function of a file in methods/, and so is a family of general names.
#define METHOD(function)      \
  [] {                        \
    extern Method function(); \
    return function();        \
  }()
#define FAMILY(function)                 \
  [] {                                   \
    extern Method function(GeneralName); \
    return function;                     \
  }()

struct Family {
  Method (*make)(GeneralName);
  const char* names;  // as users are told them
};

static const std::map<std::string, Family>& families() {
  static const std::map<std::string, Family> all = {
      {"3STEPCG", {FAMILY(three_step_cg), "3STEPCG:<preconditioner>[,refine=yes]"}},
      {"ALM", {FAMILY(alm), "ALM:r=<r>,rho=<rho>"}},
      {"HYBRID", {FAMILY(hybrid_of_degree), "HYBRID:k=<degree>"}},
      {"SYMMLQ", {FAMILY(symmlq), "SYMMLQ:<preconditioner>[,refine=yes]"}},
  };
  return all;
}

std::vector<std::string> general_names() {
  std::vector<std::string> names;
  for (const auto& [name, family] : families()) names.emplace_back(family.names);
  return names;
}

bool is_general_name(const std::string& name) {
  return name.find(':') != name.npos && families().contains(name.substr(0, name.find(':')));
}

// SYMMLQ:SSOR1 is an alias of SYMMLQ:SSOR1.0.
static Method method_of_general_name(const std::string& text) {
  const GeneralName name(text);
  Method method = families().at(name.family()).make(name);
  std::string general = text;
  if (!method.preconditioner.empty())
    general.replace(name.family().size() + 1, name.first().size(), method.preconditioner);
  if (general != text) method.general_name = general;
  return method;
}

const int highest_degree = highest_stress_degree;
std::string hybrid_of_degree(int degree) {
  return degree == 1 ? "HYBRID" : "HYBRID:k=" + std::to_string(degree);
}
std::string displacements_of_degree(int degree) { return "P" + std::to_string(degree); }

// One of the paper's names for a method that has a general one.
static Method alias(const char* name, const char* general_name) {
  Method method = method_of_general_name(general_name);
  method.name = name;
  method.general_name = general_name;
  method.in_paper = true;
  return method;
}

const std::vector<Method>& methods() {
  static const std::vector<Method> all = [] {
    std::vector<Method> table = {
        alias("SDTIC3", "SYMMLQ:DTIC3"),
        alias("3STEPCG3", "3STEPCG:DTIC3"),
        alias("SDTIC6", "SYMMLQ:DTIC6"),
        alias("3STEPCG6", "3STEPCG:DTIC6"),
        alias("SSKY", "SYMMLQ:SKY"),
        METHOD(three_step),
        METHOD(tuned_alm),
        METHOD(automatic_alm),
        METHOD(blind),
        METHOD(blind_schur),
        METHOD(blind_schur_refined),
        METHOD(blind_skyline),
        METHOD(three_step_refined),
        METHOD(three_step_file),
        METHOD(three_step_lean),
        METHOD(three_step_cholmod),
        METHOD(hybrid),
        METHOD(hybrid_cholmod),
        METHOD(hybrid_mumps),
        METHOD(hybrid_pdas),
        METHOD(hybrid_cg),
        METHOD(p2),
        METHOD(p3),
        METHOD(p4),
    };
    for (const char* family : {"SYMMLQ:", "3STEPCG:"})
      for (const std::string& preconditioner : preconditioner_names())
        table.push_back(method_of_general_name(family + preconditioner));
    return table;
  }();
  return all;
}

std::vector<std::string> split_method_list(std::string_view list) {
  std::vector<std::string> items;
  std::istringstream parts{std::string(list)};
  for (std::string part; std::getline(parts, part, ',');) {
    const bool goes_on = part.find('=') != part.npos && part.find(':') == part.npos;
    if (goes_on && !items.empty())
      items.back() += "," + part;
    else
      items.push_back(part);
  }
  return items;
}

static Method at_degree(const Method& method, int degree) {
  const std::string& name = method.name;
  const bool has_degrees = name == "HYBRID" || name == "HYBRID:CHOLMOD" || name == "HYBRID:MUMPS" ||
                           name == "HYBRID:PDAS";
  return degree == 1 || !has_degrees
             ? method
             : method_of_general_name(name + (name == "HYBRID" ? ":k=" : ",k=") +
                                      std::to_string(degree));
}

namespace {

std::vector<std::string> valid_names(const std::vector<Method>& table) {
  std::vector<std::string> names;
  for (const Method& method : table)
    if (method.preconditioner.empty() || !is_general_name(method.name))
      names.push_back(method.name);
  return names;
}

}  // namespace

std::vector<Method> select_methods(std::string_view selection, const std::vector<Method>& others,
                                   int degree) {
  std::vector<Method> table = methods();
  table.insert(table.end(), others.begin(), others.end());
  std::vector<bool> selected(table.size(), false);
  std::vector<Method> more;
  for (const std::string& item : split_method_list(selection)) {
    bool matched = false;
    for (std::size_t i = 0; i < table.size(); ++i)
      if (fnmatch(item.c_str(), table[i].name.c_str(), 0) == 0) selected[i] = matched = true;
    if (matched) continue;
    if (!is_general_name(item))
      throw std::invalid_argument("no method matches '" + shortened(item) + "'" +
                                  perhaps(item, valid_names(table)) +
                                  " (valid: " + joined(valid_names(table)) + ", " +
                                  joined(general_names()) + "; globs like '3STEP*')");
    more.push_back(method_of_general_name(item));
  }
  std::vector<Method> result;
  const auto add = [&](const Method& method) {
    const bool there = std::any_of(result.begin(), result.end(), [&](const Method& other) {
      return other.identity() == method.identity();
    });
    if (!there) result.push_back(method);
  };
  for (std::size_t i = 0; i < selected.size(); ++i)
    if (selected[i]) add(at_degree(table[i], degree));
  for (const Method& method : more) add(method);
  if (result.empty()) throw std::invalid_argument("no method is named");
  return result;
}

}  // namespace airybench
