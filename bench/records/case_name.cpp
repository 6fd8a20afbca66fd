#include "bench/records/case_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "bench/records/json.hpp"
#include "support/numbers.hpp"

namespace airybench {
namespace {

std::vector<std::string_view> parts_of(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('/', begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

}  // namespace

std::string CaseName::suffix() const {
  std::string text;
  if (!study.empty()) text += "/study=" + study;
  if (knob_value) {
    std::string word = knob;
    std::replace(word.begin(), word.end(), ' ', '_');
    text += fmt::format("/{}={}", word, *knob_value);
  }
  if (stop == Stop::paper) text += "/stop=paper";
  if (contact) text += fmt::format("/contact={}", name_of(*contact));
  return text;
}

std::string CaseName::text() const { return mesh + "/" + scene + "/" + method + suffix(); }

std::string CaseName::file() const {
  const std::string whole = text();
  const auto is_dash = [&](std::size_t i) { return whole[i] == '-' || whole[i] == '/'; };
  std::string name;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const char c = whole[i];
    if (c == '/')
      name += "--";
    else if (c == ':')
      name += '+';
    else if (c == '+' && i > 0)
      name += '~';
    else if (c == '%' || c == '+' || c == '~' ||
             (c == '-' && (i == 0 || is_dash(i - 1) || i + 1 == whole.size() || is_dash(i + 1))))
      name += fmt::format("%{:02X}", c);
    else
      name += c;
  }
  return name;
}

ContactSolver implied_contact_solver(Stop stop, std::string_view knob) {
  return stop == Stop::paper || knob == sweeps_knob ? ContactSolver::gauss_seidel
                                                    : ContactSolver::newton;
}

std::optional<ContactSolver> unless_implied(std::optional<ContactSolver> solver, Stop stop,
                                            std::string_view knob) {
  return solver == implied_contact_solver(stop, knob) ? std::nullopt : solver;
}

bool is_name(std::string_view text) {
  const auto is_refused = [](char c) { return c == '/' || static_cast<unsigned char>(c) < ' '; };
  return !text.empty() && std::none_of(text.begin(), text.end(), is_refused) && is_utf8(text);
}

std::optional<CaseName> case_name_of(std::string_view text) {
  const std::vector<std::string_view> parts = parts_of(text);
  if (parts.size() < 3) return {};
  CaseName name;
  name.mesh = parts[0];
  name.scene = parts[1];
  name.method = parts[2];
  for (std::size_t k = 3; k < parts.size(); ++k) {
    const std::size_t equals = std::min(parts[k].find('='), parts[k].size());
    const std::string_view key = parts[k].substr(0, equals);
    const std::string_view value = parts[k].substr(std::min(equals + 1, parts[k].size()));
    if (parts[k] == "stop=paper") {
      name.stop = Stop::paper;
    } else if (key == "contact") {
      name.contact = unless_implied(contact_solver_of(value), name.stop, name.knob);
    } else if (key == "study") {
      name.study = value;
    } else {
      name.knob = key;
      name.knob_value = parse_number(value);
      if (!name.knob_value) return {};
    }
  }
  // text() fixes the order of the parts and excludes repetition.
  if (name.mesh.empty() || name.scene.empty() || name.method.empty() || name.text() != text)
    return {};
  return name;
}

}  // namespace airybench
