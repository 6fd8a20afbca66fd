#include "solvers/preconditioners/preconditioner.hpp"

#include <charconv>
#include <sstream>
#include <stdexcept>

namespace airybench {

// A kind is a function of a file in this folder.
#define KIND(function)                    \
  [] {                                    \
    extern PreconditionerKind function(); \
    return function();                    \
  }()

static const std::vector<PreconditionerKind>& kinds() {
  static const std::vector<PreconditionerKind> all = {
      KIND(drop_tolerance_kind),  // DTIC
      KIND(fill_level_kind),      // FLIC
      KIND(ssor_kind),            // SSOR
      KIND(exact_kind),           // SKY
      KIND(identity_kind),        // NONE
  };
  return all;
}

namespace {

// The number that follows `prefix`, if that is all of the name; 0 where nothing does.
std::optional<double> number_after(std::string_view prefix, std::string_view name) {
  if (!name.starts_with(prefix)) return {};
  double value = 0;
  const char *const begin = name.data() + prefix.size(), *const end = name.data() + name.size();
  if (begin == end) return value;
  const auto [stopped, error] = std::from_chars(begin, end, value, std::chars_format::fixed);
  if (error != std::errc() || stopped != end) return {};
  return value;
}

struct Found {
  const PreconditionerKind* kind;
  double number;
  std::string name;  // canonical
};

std::optional<Found> find(const PreconditionerKind& kind, std::string_view name) {
  const std::optional<double> number = number_after(kind.prefix, name);
  if (!number || kind.numbers.front().empty() != (name == kind.prefix)) return {};
  for (const std::string& listed : kind.numbers)
    if (number_after("", listed) == number) return Found{&kind, *number, kind.prefix + listed};
  if (kind.allows == nullptr || !kind.allows(*number)) return {};
  char text[400];  // also of 1e-300
  const auto end = std::to_chars(text, text + sizeof text, *number, std::chars_format::fixed).ptr;
  return Found{&kind, *number, kind.prefix + std::string(text, end)};
}

Found find(std::string_view name) {
  std::string valid;
  for (const PreconditionerKind& kind : kinds()) {
    if (const std::optional<Found> found = find(kind, name)) return *found;
    valid += (valid.empty() ? "" : ", ") + kind.valid;
  }
  throw std::invalid_argument("'" + std::string(name) + "' is no preconditioner (valid: " + valid +
                              ")");
}

}  // namespace

MakePreconditioner preconditioner_named(std::string_view name) {
  return [found = find(name)](const SparseColumns& lower, const Deadline& deadline) {
    return found.kind->make(lower, found.number, deadline);
  };
}

std::string canonical_preconditioner_name(std::string_view name) { return find(name).name; }

const std::vector<std::string>& preconditioner_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const PreconditionerKind& kind : kinds())
      for (const std::string& number : kind.numbers) all.push_back(kind.prefix + number);
    return all;
  }();
  return names;
}

void note_preconditioner(const Preconditioner& preconditioner, Solution& solution) {
  solution.storage[MemoryOwner::preconditioner] = preconditioner.bytes;
  if (preconditioner.bytes > 0) solution.factor_entries = preconditioner.entries;
  solution.factor_flops = preconditioner.flops;
  if (preconditioner.shift == 0) return;
  std::ostringstream text;
  text << "shift=" << preconditioner.shift;
  solution.parameters = text.str();
}

}  // namespace airybench
