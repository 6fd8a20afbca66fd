#include "solvers/general_names.hpp"

#include <charconv>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>

#include "solvers/condensation/condensation_methods.hpp"
#include "solvers/uzawa/alm_methods.hpp"

namespace airybench {
namespace {

[[noreturn]] void refuse(const std::string& name, const std::string& why) {
  throw std::invalid_argument("method '" + name + "': " + why);
}

// The parts of "family:first,key=value,…".
struct Parts {
  std::string family, first;
  std::map<std::string, std::string> options;
};

Parts split(const std::string& name) {
  Parts parts;
  const std::size_t colon = name.find(':');
  parts.family = name.substr(0, colon);
  std::istringstream items(colon == name.npos ? "" : name.substr(colon + 1));
  for (std::string item; std::getline(items, item, ',');) {
    const std::size_t equals = item.find('=');
    const std::string key = item.substr(0, equals);
    if (equals == item.npos) {
      if (!parts.first.empty()) refuse(name, "'" + item + "' has no '='");
      parts.first = item;
    } else if (!parts.options.emplace(key, item.substr(equals + 1)).second) {
      refuse(name, "'" + key + "' is there twice");
    }
  }
  return parts;
}

// Takes an option out; its default where it is not there.
std::string take(Parts& parts, const std::string& key, const std::string& otherwise) {
  const auto found = parts.options.find(key);
  if (found == parts.options.end()) return otherwise;
  std::string value = found->second;
  parts.options.erase(found);
  return value;
}

void refuse_rest(const std::string& name, const Parts& parts, const std::string& valid) {
  if (!parts.options.empty())
    refuse(name, "unknown option '" + parts.options.begin()->first + "' (valid: " + valid + ")");
}

int lanes_of(const std::string& name, Parts& parts) {
  const std::string lanes = take(parts, "lanes", "16");
  if (lanes != "1" && lanes != "16") refuse(name, "lanes=" + lanes + " (allowed: 1, 16)");
  return lanes == "1" ? 1 : most_lanes;
}

Refine refine_of(const std::string& name, Parts& parts) {
  const std::string refine = take(parts, "refine", "no");
  if (refine != "yes" && refine != "no") refuse(name, "refine=" + refine + " (allowed: yes, no)");
  return refine == "yes" ? Refine::yes : Refine::no;
}

double positive(const std::string& name, Parts& parts, const std::string& key) {
  const std::string text = take(parts, key, "");
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value > 0) ||
      !std::isfinite(value))
    refuse(name, key + "='" + text + "' (allowed: a number above 0)");
  return value;
}

MakePreconditioner preconditioner_of(const std::string& name, const Parts& parts) {
  try {
    return preconditioner_named(parts.first);
  } catch (const std::invalid_argument& error) {
    refuse(name, error.what());
  }
}

Method krylov_method(std::string summary) {
  Method method;
  method.summary = std::move(summary);
  method.stages = {"precondition", "condense", "contact", "recover", "check"};
  method.knob = AccuracyKnob::krylov_tolerance;
  // Tight from the start: where the preconditioner is poor the residual stays long and then falls
  // fast, so that two digits more cost some per cent, and a second run all of it.
  method.first_tolerance = 1e-4;
  method.paper_tolerance = 1e-6;  // the paper does not print its own; a usual one
  return method;
}

Method three_step_cg(const std::string& name, Parts parts) {
  Method method = krylov_method("three-step condensation, conjugate gradients with " + parts.first);
  const auto make = preconditioner_of(name, parts);
  const int lanes = lanes_of(name, parts);
  const Refine refine = refine_of(name, parts);
  refuse_rest(name, parts, "lanes, refine");
  method.solve = [make, lanes, refine](const DualSystem& s, const RunControl& c) {
    return solve_three_step_cg(s, c, make, lanes, refine);
  };
  return method;
}

Method symmlq(const std::string& name, Parts parts) {
  Method method = krylov_method("SYMMLQ condensation, block preconditioner with " + parts.first);
  const auto make = preconditioner_of(name, parts);
  const std::string schur = take(parts, "schur", "dense");
  if (schur != "dense" && schur != "sparse")
    refuse(name, "schur=" + schur + " (allowed: dense, sparse)");
  const int lanes = lanes_of(name, parts);
  const Refine refine = refine_of(name, parts);
  refuse_rest(name, parts, "schur, lanes, refine");
  method.condenses_contact_only = true;
  const SchurBlock block = schur == "dense" ? SchurBlock::dense : SchurBlock::sparse;
  method.solve = [make, block, lanes, refine](const DualSystem& s, const RunControl& c) {
    return solve_symmlq_condensation(s, c, make, block, lanes, refine);
  };
  return method;
}

Method augmented_lagrangian(const std::string& name, Parts parts) {
  Method method;
  method.summary = "augmented Lagrangian, Uzawa's algorithm with given parameters";
  method.stages = {"factor", "contact", "recover", "check"};
  method.first_tolerance = 2e-2;
  method.knob = AccuracyKnob::uzawa_iterations;
  if (!parts.first.empty()) refuse(name, "'" + parts.first + "' is no parameter (valid: r, rho)");
  const double r = positive(name, parts, "r"), rho = positive(name, parts, "rho");
  refuse_rest(name, parts, "r, rho");
  method.solve = [r, rho](const DualSystem& s, const RunControl& c) {
    return solve_augmented_lagrangian(s, c, r, rho);
  };
  return method;
}

using Make = Method (*)(const std::string&, Parts);
const std::map<std::string, Make>& families() {
  static const std::map<std::string, Make> table = {
      {"3STEPCG", three_step_cg}, {"SYMMLQ", symmlq}, {"ALM", augmented_lagrangian}};
  return table;
}

}  // namespace

bool is_general_name(const std::string& name) {
  return name.find(':') != name.npos && families().contains(name.substr(0, name.find(':')));
}

Method method_of_general_name(const std::string& name) {
  Parts parts = split(name);
  Method method = families().at(parts.family)(name, std::move(parts));
  method.name = name;
  return method;
}

}  // namespace airybench
