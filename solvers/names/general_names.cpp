#include "solvers/names/general_names.hpp"

#include <sstream>
#include <stdexcept>

#include "support/numbers.hpp"

namespace airybench {

GeneralName::GeneralName(const std::string& name) : name_(name) {
  const std::size_t colon = name.find(':');
  family_ = name.substr(0, colon);
  std::istringstream items(colon == name.npos ? "" : name.substr(colon + 1));
  for (std::string item; std::getline(items, item, ',');) {
    const std::size_t equals = item.find('=');
    const std::string key = item.substr(0, equals);
    if (equals == item.npos) {
      if (!first_.empty()) refuse("'" + item + "' has no '='");
      first_ = item;
    } else if (!options_.emplace(key, item.substr(equals + 1)).second) {
      refuse("'" + key + "' is there twice");
    }
  }
}

void GeneralName::refuse(const std::string& why) const {
  throw std::invalid_argument("method '" + name_ + "': " + why);
}

MakePreconditioner GeneralName::preconditioner() const {
  try {
    return preconditioner_named(first_);
  } catch (const std::invalid_argument& error) {
    refuse(error.what());
  }
}

std::string GeneralName::take(const std::string& key, const std::string& otherwise) {
  const auto found = options_.find(key);
  if (found == options_.end()) return otherwise;
  std::string value = found->second;
  options_.erase(found);
  return value;
}

std::string GeneralName::one_of(const std::string& key, const std::string& otherwise,
                                std::initializer_list<const char*> allowed) {
  const std::string value = take(key, otherwise);
  std::string names;
  for (const char* name : allowed) {
    if (value == name) return value;
    names += (names.empty() ? "" : ", ") + std::string(name);
  }
  refuse(key + "=" + value + " (allowed: " + names + ")");
}

double GeneralName::positive(const std::string& key) {
  const std::string text = take(key, "");
  const std::optional<double> value = parse_number(text);
  if (!value || !(*value > 0)) refuse(key + "='" + text + "' (allowed: a number above 0)");
  return *value;
}

int GeneralName::whole(const std::string& key, int otherwise, int least, int most) {
  const std::string text = take(key, std::to_string(otherwise));
  const std::optional<std::int64_t> value = parse_whole(text);
  if (!value || *value < least || *value > most)
    refuse(key + "='" + text + "' (allowed: a whole number from " + std::to_string(least) + " to " +
           std::to_string(most) + ")");
  return static_cast<int>(*value);
}

void GeneralName::refuse_rest(const std::string& valid) const {
  if (!options_.empty())
    refuse("unknown option '" + options_.begin()->first + "' (valid: " + valid + ")");
}

Method krylov_method(const GeneralName& name, const std::string& summary) {
  Method method;
  method.name = name.name();
  method.summary = summary + name.first();
  method.family = name.family();
  method.preconditioner = canonical_preconditioner_name(name.first());
  method.stages = {Stage::precondition, Stage::condense, Stage::contact, Stage::recover,
                   Stage::check};
  method.knob = AccuracyKnob::krylov_tolerance;
  // Tight from the start: where the preconditioner is poor the residual stays long and then falls
  // fast, so that two digits more cost some per cent, and a second run all of it.
  method.first_tolerance = 1e-4;
  method.paper_tolerance = 1e-6;  // the paper does not print its own; a usual one
  return method;
}

}  // namespace airybench
