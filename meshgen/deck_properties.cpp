#include "meshgen/deck_properties.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "support/errors.hpp"
#include "support/lists.hpp"

namespace airybench {
namespace {

template <std::size_t n>
using Words = std::array<std::string_view, n>;

// What is read of a keyword, and what of it changes nothing that is solved here.
struct ReadKeyword {
  std::string_view name, parameters, idle = "";
};
constexpr auto read_keywords = std::to_array<ReadKeyword>({
    {"NODE", "NSET,SYSTEM"},
    {"ELEMENT", "TYPE,ELSET"},
    {"NSET", "NSET,GENERATE,INSTANCE", "INTERNAL,UNSORTED"},
    {"ELSET", "ELSET,GENERATE,INSTANCE", "INTERNAL,UNSORTED"},
    {"SURFACE", "NAME,TYPE", "INTERNAL"},
    {"MATERIAL", "NAME"},
    {"ELASTIC", "TYPE"},
    {"DENSITY", ""},
    {"SOLID SECTION", "ELSET,MATERIAL", "CONTROLS"},
    {"SHELL SECTION", "ELSET,MATERIAL", "CONTROLS"},
    {"MEMBRANE SECTION", "ELSET,MATERIAL", "CONTROLS"},
    {"SURFACE INTERACTION", "NAME"},
    {"SURFACE BEHAVIOR", "PRESSURE-OVERCLOSURE"},
    {"FRICTION", "", "SLIP TOLERANCE"},
    {"CONTACT PAIR", "INTERACTION,ADJUST", "TYPE,SMALL SLIDING"},
    {"TIE", "", "NAME,ADJUST,POSITION TOLERANCE,TYPE"},
    {"AMPLITUDE", "NAME,DEFINITION,TIME,VALUE"},
    {"STEP", "NLGEOM,PERTURBATION", "INC,NAME,AMPLITUDE,UNSYMM,EXTRAPOLATION"},
    {"STATIC", "", "DIRECT,SOLVER"},
    {"END STEP", ""},
    {"BOUNDARY", "AMPLITUDE,OP,TYPE"},
    {"CLOAD", "AMPLITUDE,OP"},
    {"DLOAD", "AMPLITUDE,OP"},
    {"DSLOAD", "AMPLITUDE,OP"},
    {"HEADING", ""},
});
// Where only these values of a parameter are read.
struct ReadValues {
  std::string_view keyword, parameter, values;
};
constexpr auto read_values = std::to_array<ReadValues>({
    {"SURFACE", "TYPE", "ELEMENT,NODE"},
    {"ELASTIC", "TYPE", "ISO,ISOTROPIC"},
    {"SURFACE BEHAVIOR", "PRESSURE-OVERCLOSURE", "HARD,LINEAR,EXPONENTIAL"},
    {"AMPLITUDE", "DEFINITION", "TABULAR"},
    {"AMPLITUDE", "TIME", "STEP TIME"},
    {"AMPLITUDE", "VALUE", "RELATIVE"},
    {"BOUNDARY", "TYPE", "DISPLACEMENT"},
    {"BOUNDARY", "OP", "MOD,NEW"},
    {"CLOAD", "OP", "MOD,NEW"},
    {"DLOAD", "OP", "MOD,NEW"},
    {"DSLOAD", "OP", "MOD,NEW"},
});
// They change nothing in what is solved here.
constexpr Words<30> idle_keywords = {"OUTPUT",
                                     "NODE OUTPUT",
                                     "ELEMENT OUTPUT",
                                     "CONTACT OUTPUT",
                                     "ENERGY OUTPUT",
                                     "NODE FILE",
                                     "EL FILE",
                                     "ELEMENT FILE",
                                     "NODE PRINT",
                                     "EL PRINT",
                                     "ELEMENT PRINT",
                                     "ENERGY PRINT",
                                     "CONTACT FILE",
                                     "CONTACT PRINT",
                                     "SECTION PRINT",
                                     "FILE FORMAT",
                                     "FILTER",
                                     "TIME POINTS",
                                     "MONITOR",
                                     "PREPRINT",
                                     "PRINT",
                                     "RESTART",
                                     "CONTROLS",
                                     "CONTACT CONTROLS",
                                     "SOLUTION TECHNIQUE",
                                     "PHYSICAL CONSTANTS",
                                     "EXPANSION",
                                     "CONDUCTIVITY",
                                     "SPECIFIC HEAT",
                                     "SECTION CONTROLS"};
constexpr std::array<std::pair<std::string_view, std::string_view>, 25> refused_keywords = {
    {{"PLASTIC", "the material yields"},
     {"CYCLIC HARDENING", "the material yields"},
     {"HYPERELASTIC", "the material is not linear"},
     {"HYPERFOAM", "the material is not linear"},
     {"CREEP", "the material creeps"},
     {"VISCOELASTIC", "the material creeps"},
     {"USER MATERIAL", "the material is a program's"},
     {"ORIENTATION", "axes of a material's own"},
     {"TRANSFORM", "axes of nodes' own"},
     {"TEMPERATURE", "thermal strain"},
     {"INITIAL CONDITIONS", "initial stress or temperature"},
     {"EQUATION", "coupled displacements"},
     {"MPC", "coupled displacements"},
     {"COUPLING", "coupled displacements"},
     {"DISTRIBUTING COUPLING", "coupled displacements"},
     {"KINEMATIC COUPLING", "coupled displacements"},
     {"RIGID BODY", "a rigid body"},
     {"SPRING", "springs"},
     {"DASHPOT", "dashpots"},
     {"MASS", "point masses"},
     {"GAP", "gap elements"},
     {"CLEARANCE", "a gap that is not the coordinates'"},
     {"CHANGE FRICTION", "friction that changes"},
     {"MODEL CHANGE", "parts that come and go"},
     {"CONTACT", "contact of all faces with each other"}}};

bool contains(const auto& words, std::string_view word) {
  return std::ranges::find(words, word) != words.end();
}

// ", perhaps *DLOAD", or empty.
std::string perhaps_keyword(const std::string& word) {
  std::vector<std::string> names(idle_keywords.begin(), idle_keywords.end());
  for (const ReadKeyword& read : read_keywords) names.emplace_back(read.name);
  for (const auto& [name, why] : refused_keywords) names.emplace_back(name);
  const std::string nearest = nearest_of(word, names);
  return nearest.empty() ? "" : ", perhaps *" + nearest;
}

const DeckLine& only_line(const DeckBlock& block, const char* what) {
  if (block.data.size() != 1)
    block.line.fail(fmt::format("*{} with {} lines (allowed: one, {})", block.keyword,
                                block.data.size(), what));
  return block.data.front();
}

void check_parameters(const DeckBlock& block, const ReadKeyword& read) {
  const auto is_one_of = [](std::string_view list, const std::string& word) {
    return contains(split_list(list), word);
  };
  for (const auto& [name, value] : block.parameters) {
    if (!is_one_of(read.parameters, name) && !is_one_of(read.idle, name))
      block.line.fail(fmt::format("*{}, {} (allowed: {}{}{})", block.keyword, name, read.parameters,
                                  read.parameters.empty() || read.idle.empty() ? "" : ",",
                                  read.idle));
    for (const auto& [keyword, parameter, values] : read_values)
      if (keyword == block.keyword && parameter == name && !is_one_of(values, in_capitals(value)))
        block.line.fail(
            fmt::format("*{}, {}={} (allowed: {})", block.keyword, name, value, values));
  }
}

class PropertyReader {
 public:
  explicit PropertyReader(const Deck& deck) : deck_(deck) {}

  DeckProperties read() {
    refuse_what_changes_the_answer();
    read_materials();
    for (const DeckBlock& block : deck_.file.blocks)
      if (block.keyword.ends_with(" SECTION")) read_section(block);
    check_elements();
    read_pairs();
    return std::move(properties_);
  }

 private:
  void refuse_what_changes_the_answer() {
    std::map<std::string, std::string> unused;  // keywords, where first
    for (const DeckBlock& block : deck_.file.blocks) {
      if (const auto read = std::ranges::find(read_keywords, block.keyword, &ReadKeyword::name);
          read != read_keywords.end()) {
        check_parameters(block, *read);
        continue;
      }
      if (contains(idle_keywords, block.keyword)) {
        if (block.keyword == "RESTART" && block.has("READ"))
          block.line.fail("*RESTART, READ (allowed: a deck that begins from nothing)");
        unused.emplace(block.keyword, block.line.place);
        continue;
      }
      const auto known =
          std::ranges::find(refused_keywords, block.keyword, [](const auto& r) { return r.first; });
      block.line.fail(fmt::format(
          "*{}{} (allowed in a deck without --scene: linear elasticity, supports, loads, contact "
          "pairs with friction, static steps; with one its mesh alone is read)",
          block.keyword,
          known == refused_keywords.end() ? perhaps_keyword(block.keyword)
                                          : fmt::format(": {}", known->second)));
    }
    if (unused.empty()) return;
    std::vector<std::string> all;
    for (const auto& [keyword, at] : unused) all.push_back(fmt::format("*{} ({})", keyword, at));
    properties_.notes.push_back(fmt::format("not used: {}", fmt::join(all, ", ")));
  }

  void read_materials() {
    DeckMaterial* material = nullptr;
    for (const DeckBlock& block : deck_.file.blocks) {
      if (block.keyword == "MATERIAL") material = &materials_[block.value("NAME")];
      if (block.keyword != "ELASTIC" && block.keyword != "DENSITY") continue;
      if (material == nullptr) block.line.fail(fmt::format("*{} before *MATERIAL", block.keyword));
      const DeckLine& line = only_line(block, "the same at every temperature");
      const std::vector<std::string> fields = line.fields();
      if (block.keyword == "DENSITY") {
        material->density = line.number(fields[0]);
      } else {
        if (fields.size() < 2) line.fail("*ELASTIC: Young's modulus and Poisson's ratio");
        material->young_MPa = line.number(fields[0]);
        material->poisson = line.number(fields[1]);
      }
    }
  }

  void read_section(const DeckBlock& block) {
    const std::string set = deck_.full_name(block.value("ELSET"), block);
    const auto members = deck_.element_sets.find(set);
    if (members == deck_.element_sets.end())
      block.line.fail(fmt::format("ELSET={}: no such set", block.value("ELSET")));
    for (const long number : members->second)
      if (!has_section_.insert(number).second)
        block.line.fail(fmt::format("element {} has two sections (allowed: one)", number));
    for (const long number : members->second)
      if (const auto found = deck_.elements.find(number);
          found != deck_.elements.end() && !found->second.is_plane())
        block.line.fail(fmt::format("element {} is a {} with a section (allowed: of plane bodies)",
                                    number, found->second.type));
    const auto material = materials_.find(block.value("MATERIAL"));
    if (material == materials_.end() || material->second.young_MPa == 0)
      block.line.fail(
          fmt::format("MATERIAL={}: no *MATERIAL with *ELASTIC", block.value("MATERIAL")));
    double thickness = 1;
    if (!block.data.empty())
      if (const auto fields = block.data.front().fields(); !fields[0].empty())
        thickness = block.data.front().number(fields[0]);
    if (!(thickness > 0)) block.line.fail(fmt::format("thickness {} (allowed: > 0)", thickness));
    if (!properties_.materials.empty() && properties_.thickness_mm != thickness)
      block.line.fail(fmt::format("a thickness of {}, elsewhere {} (allowed: one)", thickness,
                                  properties_.thickness_mm));
    properties_.thickness_mm = thickness;
    properties_.materials[members->first] = material->second;
  }

  void check_elements() {
    std::optional<DeckElement::Kind> kind;
    for (const auto& [number, element] : deck_.elements) {
      if (!element.is_plane()) continue;
      if (!properties_.materials.contains(deck_.body.at(number)))
        throw InputError(
            fmt::format("element {} has no section (allowed: *SOLID SECTION)", number));
      if (kind && *kind != element.kind)
        throw InputError(fmt::format(
            "elements of plane strain and of plane stress, as {} of element {} (allowed: one)",
            element.type, number));
      kind = element.kind;
    }
    properties_.is_plane_stress = kind == DeckElement::Kind::plane_stress;
    if (properties_.thickness_mm != 1)
      properties_.notes.push_back(fmt::format(
          "thickness {}: forces are those of a thickness of 1 mm", properties_.thickness_mm));
  }

  void read_pairs() {
    std::map<std::string, double, WithoutCase> friction;
    std::string interaction;
    for (const DeckBlock& block : deck_.file.blocks) {
      if (block.keyword == "SURFACE INTERACTION") {
        interaction = block.value("NAME");
        friction.emplace(interaction, 0);
      } else if (block.keyword == "FRICTION") {
        const std::string coefficient = only_line(block, "μ").fields()[0];
        if (block.data.front().fields().size() > 2)
          block.data.front().fail("*FRICTION with more than μ and a slope of sticking");
        friction[interaction] = block.data.front().number(coefficient);
      } else if (block.keyword == "SURFACE BEHAVIOR") {
        const std::string law = in_capitals(block.value("PRESSURE-OVERCLOSURE"));
        if (law == "LINEAR" || law == "EXPONENTIAL")
          properties_.notes.push_back(
              fmt::format("{}: contact is hard here, not {}", block.line.place, law));
      }
    }
    const auto friction_of = [&](const DeckBlock& block) {
      const auto known = friction.find(block.value("INTERACTION"));
      if (known == friction.end())
        block.line.fail(fmt::format("INTERACTION={}: no such *SURFACE INTERACTION",
                                    block.value("INTERACTION")));
      if (block.has("ADJUST"))
        properties_.notes.push_back(fmt::format(
            "{}: ADJUST is not used: the gap is that of the coordinates", block.line.place));
      return std::optional(known->second);
    };
    std::map<std::string, std::string, WithoutCase> place_of;  // faces' pairs
    for (const DeckBlock& block : deck_.file.blocks) {
      const bool is_tied = block.keyword == "TIE";
      if (!is_tied && block.keyword != "CONTACT PAIR") continue;
      const std::optional<double> mu = is_tied ? std::nullopt : friction_of(block);
      for (const DeckLine& line : block.data) {
        const std::vector<std::string> names = line.fields();
        if (names.size() < 2 || names[1].empty() || in_capitals(names[0]) == in_capitals(names[1]))
          line.fail(fmt::format("*{} (allowed: two surfaces)", block.keyword));
        DeckPair pair{{}, mu};
        for (std::size_t side = 0; side < 2; ++side) {
          pair.faces[side] = deck_.face(deck_.full_name(names[side], block), line);
          if (!place_of.emplace(pair.faces[side], line.place).second)
            line.fail(fmt::format("surface {} is in two pairs (allowed: one)", names[side]));
        }
        properties_.pairs.push_back(pair);
      }
    }
  }

  const Deck& deck_;
  std::map<std::string, DeckMaterial, WithoutCase> materials_;
  std::set<long> has_section_;
  DeckProperties properties_;
};

}  // namespace

bool is_analysis(const Deck& deck) {
  return std::ranges::any_of(deck.file.blocks, [](const DeckBlock& block) {
    return contains(Words<6>{"MATERIAL", "BOUNDARY", "STEP", "CONTACT PAIR", "TIE", "DLOAD"},
                    block.keyword);
  });
}

DeckProperties read_properties(const Deck& deck) { return PropertyReader(deck).read(); }

}  // namespace airybench
