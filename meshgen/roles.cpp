#include "meshgen/roles.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <set>

#include "mesh/mesh.hpp"
#include "support/errors.hpp"
#include "support/lists.hpp"
#include "support/numbers.hpp"

namespace airybench {
namespace {

enum class Rank { none, rest, name, range, number };

struct Candidate {
  Rank rank = Rank::none;
  std::string label;
};

struct Range {
  std::int64_t first, last;
};
std::optional<Range> range_of(const std::string& text) {
  const std::size_t dash = std::min(text.find('-', 1), text.size());
  const auto first = parse_whole(text.substr(0, dash)),
             last = dash == text.size() ? first : parse_whole(text.substr(dash + 1));
  if (!first || !last || *first > *last) return {};
  return Range{*first, *last};
}

std::string shown(const ModelCurve& curve) {
  return curve.is_named() ? fmt::format("'{}'", fmt::join(curve.names, "', '"))
                          : std::to_string(curve.number);
}

std::string list_of(const std::set<std::string>& names) {
  constexpr std::size_t most = 20;
  std::vector<std::string> first(names.begin(), names.end());
  const bool has_more = first.size() > most;
  first.resize(std::min(first.size(), most));
  return fmt::format("{}{}", fmt::join(first, ", "), has_more ? ", …" : "");
}

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

class Giver {
 public:
  Giver(std::vector<ModelCurve>& curves, const std::map<std::string, std::string>& roles)
      : curves_(curves), roles_(roles), candidates_(curves.size()) {}

  void give(std::vector<std::string>& notes) {
    for (std::size_t k = 0; k < curves_.size(); ++k)
      for (const std::string& name : curves_[k].names)
        if (!roles_.contains(name) && parse_boundary_label(name)) add(k, Rank::name, name);
    for (const auto& [key, label] : roles_)
      if (!add_to_matching(key, label)) refuse(key);
    std::set<std::string> free;
    for (std::size_t k = 0; k < curves_.size(); ++k) {
      curves_[k].label = candidates_[k].label;
      curves_[k].is_unnamed_role = candidates_[k].rank <= Rank::rest;
      if (!curves_[k].label.empty() || curves_[k].sides.empty()) continue;
      curves_[k].label = "force";
      free.insert(shown(curves_[k]));
    }
    if (!free.empty())
      notes.push_back(
          fmt::format("no role is given to its curves {}: they are free (force)", list_of(free)));
  }

 private:
  void add(std::size_t k, Rank rank, const std::string& label) {
    Candidate& now = candidates_[k];
    if (rank == now.rank && label != now.label)
      throw InputError(fmt::format("curve {}: its roles are {} and {}; one is allowed",
                                   curves_[k].number, now.label, label));
    if (rank > now.rank) now = {rank, label};
  }

  bool add_to_matching(const std::string& key, const std::string& label) {
    if (label.find_first_of("\"\n") != label.npos)
      throw InputError(fmt::format("--role: {}: no quotes or line ends are allowed", key));
    bool is_used = false;
    const auto add_where = [&](Rank rank, const auto& belongs) {
      for (std::size_t k = 0; k < curves_.size(); ++k)
        if (belongs(curves_[k])) {
          add(k, rank, label);
          is_used = true;
        }
      return is_used;
    };
    const auto is_on_boundary = [](const ModelCurve& c) { return !c.sides.empty(); };
    if (add_where(Rank::name, [&](const ModelCurve& c) {
          return std::ranges::find(c.names, key) != c.names.end();
        }))
      return true;
    if (key == "rest") {
      add_where(Rank::rest, is_on_boundary);
      return true;
    }
    const std::optional<Range> range = range_of(key);
    return range && add_where(range->first == range->last ? Rank::number : Rank::range,
                              [&](const ModelCurve& c) {
                                return is_on_boundary(c) && c.number >= range->first &&
                                       c.number <= range->last;
                              });
  }

  [[noreturn]] void refuse(const std::string& key) const {
    std::set<std::string> physical;
    std::vector<std::string> all;
    std::string numbers;
    for (const ModelCurve& curve : curves_) {
      for (const std::string& name : curve.names) physical.insert("'" + name + "'");
      all.insert(all.end(), curve.names.begin(), curve.names.end());
      if (!curve.sides.empty())
        numbers += (numbers.empty() ? "" : ", ") + std::to_string(curve.number);
    }
    const std::string nearest = nearest_of(key, all);
    throw InputError(fmt::format(
        "--role: it has no physical curve '{}'{} (its physical curves: {}; its curves: {})", key,
        nearest.empty() ? "" : fmt::format(", perhaps '{}'", nearest),
        physical.empty() ? "none" : list_of(physical), numbers));
  }

  std::vector<ModelCurve>& curves_;
  const std::map<std::string, std::string>& roles_;
  std::vector<Candidate> candidates_;
};

}  // namespace

std::string role_meant_by(const std::string& name) {
  std::vector<std::string> words(1);
  for (const char c : lower(name)) {
    if (is_letter(c))
      words.back() += c;
    else if (!words.back().empty())
      words.emplace_back();
  }
  for (const std::string& word : words)
    for (const std::string_view role : boundary_role_names)
      if (word.starts_with(role) || word.ends_with(role)) return std::string(role);
  return nearest_of(words.front(), {boundary_role_names.begin(), boundary_role_names.end()});
}

void give_roles(PlaneModel& model, const ModelOptions& options, std::vector<std::string>& notes) {
  Giver(model.curves, options.roles).give(notes);
}

void refuse_misspelt_roles(const PlaneModel& model) {
  for (const ModelCurve& curve : model.curves)
    for (const std::string& name : curve.names) {
      if (curve.sides.empty() || !curve.is_unnamed_role) continue;
      const std::string meant = role_meant_by(name);
      if (!meant.empty())
        throw InputError(
            fmt::format("physical curve '{}': no role, perhaps {} (allowed: {}; or --role={}=ROLE)",
                        name, meant, boundary_labels_allowed, name));
    }
}

}  // namespace airybench
