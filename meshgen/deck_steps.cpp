#include "meshgen/deck_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "support/errors.hpp"

namespace airybench {
namespace {

constexpr std::size_t max_steps = 1000;

// Times and factors.
using Amplitude = std::vector<std::array<double, 2>>;
using Amplitudes = std::map<std::string, Amplitude, WithoutCase>;

Amplitudes read_amplitudes(const Deck& deck) {
  Amplitudes amplitudes;
  for (const DeckBlock& block : deck.file.blocks) {
    if (block.keyword != "AMPLITUDE") continue;
    Amplitude& points = amplitudes[block.value("NAME")];
    for (const DeckLine& line : block.data) {
      const std::vector<std::string> fields = line.fields();
      for (std::size_t k = 0; k + 1 < fields.size(); k += 2)
        points.push_back({line.number(fields[k]), line.number(fields[k + 1])});
      if (fields.size() % 2 == 1 && !fields.back().empty()) line.fail("a time without its factor");
    }
    for (std::size_t k = 1; k < points.size(); ++k)
      if (!(points[k][0] > points[k - 1][0])) block.line.fail("times that do not rise");
    if (!points.empty() && points.front()[0] > 0) {
      block.line.fail("an amplitude that begins after 0");
    }
  }
  return amplitudes;
}

// What a load is multiplied by at the end of the step, up to which it grows evenly.
double factor_of(const DeckBlock& block, const Amplitudes& amplitudes, double duration) {
  if (!block.has("AMPLITUDE")) return 1;
  const auto known = amplitudes.find(block.value("AMPLITUDE"));
  if (known == amplitudes.end() || known->second.empty())
    block.line.fail(fmt::format("AMPLITUDE={}: no such *AMPLITUDE", block.value("AMPLITUDE")));
  const Amplitude& points = known->second;
  double value = points.back()[1];
  for (std::size_t k = 1; k < points.size(); ++k) {
    const auto [before, start] = points[k - 1];
    const auto [after, end] = points[k];
    if (before < duration && duration <= after)
      value = start + (end - start) * (duration - before) / (after - before);
  }
  constexpr double rounding = 1e-6;
  for (const auto& [time, factor] : points)
    if (time < duration && std::abs(factor - value * time / duration) > rounding * std::abs(value))
      block.line.fail(fmt::format("AMPLITUDE={} is no ramp (allowed: from 0 evenly up)",
                                  block.value("AMPLITUDE")));
  return value;
}

class StepReader {
 public:
  explicit StepReader(const Deck& deck) : deck_(deck), amplitudes_(read_amplitudes(deck)) {}

  std::vector<StepState> read() {
    std::vector<StepState> states;
    std::size_t steps = 0;
    for (const DeckBlock& block : deck_.file.blocks) {
      if (block.keyword == "STEP") {
        begin_step(block);
        ++steps;
      } else if (block.keyword == "STATIC") {
        if (block.data.empty()) continue;
        const DeckLine& line = block.data.front();
        if (const auto fields = line.fields(); fields.size() > 1 && !fields[1].empty())
          duration_ = line.number(fields[1]);
      } else if (block.keyword == "END STEP") {
        if (states.size() == max_steps)
          block.line.fail(fmt::format("more than {} steps (allowed: up to that)", max_steps));
        states.push_back(state_);
      } else {
        take(block);
      }
    }
    if (states.size() < steps) throw InputError("the last *STEP has no *END STEP");
    if (states.empty()) states.push_back(state_);
    return states;
  }

 private:
  void begin_step(const DeckBlock& block) {
    if (block.has("NLGEOM") && in_capitals(block.value("NLGEOM")) != "NO")
      block.line.fail("*STEP, NLGEOM (allowed: small displacements, without it)");
    if (block.has("PERTURBATION"))
      block.line.fail("*STEP, PERTURBATION (allowed: *STATIC from the state before)");
    given_.clear();
    cleared_.clear();
    duration_ = 1;
  }

  void take(const DeckBlock& block) {
    // The first card of its kind in a step removes those of earlier steps.
    const bool is_new = block.has("OP") && in_capitals(block.value("OP")) == "NEW" &&
                        cleared_.insert(block.keyword).second;
    const auto factor = [&] { return factor_of(block, amplitudes_, duration_); };
    if (block.keyword == "BOUNDARY") {
      if (is_new) state_.held.clear();
      for (const DeckLine& line : block.data) hold(block, line, factor());
    } else if (block.keyword == "CLOAD") {
      if (is_new) state_.force_N.clear();
      for (const DeckLine& line : block.data) push(block, line, factor());
    } else if (block.keyword == "DLOAD" || block.keyword == "DSLOAD") {
      if (is_new) state_.pressures[kind_of(block)].clear();
      if (is_new && block.keyword == "DLOAD") state_.gravity.clear();
      for (const DeckLine& line : block.data) press(block, line, factor());
    }
  }
  static std::size_t kind_of(const DeckBlock& block) { return block.keyword == "DLOAD" ? 0 : 1; }

  void note_set(const std::string& name, const DeckBlock& block) {
    for (const std::string& full : {deck_.full_name(name, block), name})
      if (deck_.node_sets.contains(full)) state_.sets.insert(full);
  }

  // Loads take the place of those of earlier steps, and add to those of the same.
  bool is_first_in_step(const std::string& load) { return given_.insert(load).second; }

  void hold(const DeckBlock& block, const DeckLine& line, double factor) {
    const std::vector<std::string> fields = line.fields();
    const auto field = [&](std::size_t k) { return k < fields.size() ? fields[k] : ""; };
    const std::string word = in_capitals(field(1));
    std::vector<long> components;
    double value = 0;
    if (word == "ENCASTRE" || word == "PINNED") {
      components = {1, 2};
    } else if (word == "XSYMM" || word == "YASYMM") {
      components = {1};
    } else if (word == "YSYMM" || word == "XASYMM") {
      components = {2};
    } else if (word != "ZSYMM") {
      const long first = line.whole(word), last = field(2).empty() ? first : line.whole(field(2));
      if (!field(3).empty()) value = factor * line.number(field(3));
      for (long k = first; k <= std::min(last, 6L); ++k) components.push_back(k);
    }
    for (const long component : components) {
      if (component > 2 && value != 0)
        line.fail(fmt::format("component {} is {} (allowed: x and y, 1 and 2)", component, value));
      if (component < 1 || component > 2) continue;
      note_set(fields[0], block);
      for (const long node : deck_.members(deck_.node_sets, fields[0], block, line)) {
        if (!deck_.nodes.contains(node)) line.fail(fmt::format("node {} does not exist", node));
        state_.held[node][static_cast<std::size_t>(component) - 1] = value;
      }
    }
  }

  void push(const DeckBlock& block, const DeckLine& line, double factor) {
    const std::vector<std::string> fields = line.fields();
    if (fields.size() < 3) line.fail("*CLOAD: a node or a set, 1 or 2, and a force");
    const long component = line.whole(fields[1]);
    if (component != 1 && component != 2)
      line.fail(fmt::format("component {} (allowed: 1, 2)", component));
    const double force = factor * line.number(fields[2]);
    note_set(fields[0], block);
    for (const long node : deck_.members(deck_.node_sets, fields[0], block, line)) {
      if (!deck_.nodes.contains(node)) line.fail(fmt::format("node {} does not exist", node));
      double& value =
          state_.force_N.emplace(node, Eigen::Vector2d::Zero()).first->second[component - 1];
      if (is_first_in_step(fmt::format("node {} {}", node, component))) value = 0;
      value += force;
    }
  }

  void press(const DeckBlock& block, const DeckLine& line, double factor) {
    const std::vector<std::string> fields = line.fields();
    if (fields.size() < 3)
      line.fail(fmt::format("*{}: a set, P or GRAV, and a value", block.keyword));
    const std::string kind = in_capitals(fields[1]);
    const double value = factor * line.number(fields[2]);
    if (kind == "GRAV" && block.keyword == "DLOAD") {
      if (fields.size() < 5) line.fail("GRAV: a set, GRAV, acceleration and direction");
      const double z = fields.size() > 5 && !fields[5].empty() ? line.number(fields[5]) : 0;
      const Eigen::Vector2d direction(line.number(fields[3]), line.number(fields[4]));
      if (z != 0 || direction.isZero(0)) line.fail("GRAV across the plane (allowed: in x and y)");
      Eigen::Vector2d& acceleration =
          state_.gravity.emplace(deck_.full_name(fields[0], block), Eigen::Vector2d::Zero())
              .first->second;
      if (is_first_in_step("GRAV " + in_capitals(fields[0]))) acceleration.setZero();
      acceleration += value * direction.normalized();
      return;
    }
    const bool is_of_side =
        block.keyword == "DLOAD" && kind.size() == 2 && kind[0] == 'P' && std::isdigit(kind[1]);
    if (!is_of_side && !(block.keyword == "DSLOAD" && kind == "P"))
      line.fail(fmt::format("*{}, {} (allowed: {})", block.keyword, kind,
                            block.keyword == "DLOAD" ? "P1 to P4, GRAV" : "P"));
    std::vector<DeckEdge> edges;
    if (is_of_side) {
      for (const long element : deck_.members(deck_.element_sets, fields[0], block, line)) {
        edges.push_back(deck_.side(element, kind, line));
        if (deck_.elements.at(element).is_shell)
          line.fail(fmt::format("*DLOAD, {} of a shell (allowed: *DSLOAD on its edges)", kind));
      }
    } else {
      const auto& of_surface =
          deck_.surfaces.at(deck_.face(deck_.full_name(fields[0], block), line));
      edges.assign(of_surface.begin(), of_surface.end());
    }
    for (const DeckEdge& edge : edges) {
      if (!deck_.boundary.contains(edge))
        line.fail(fmt::format("a side between elements, at {} (allowed: of the boundary)",
                              deck_.shown(edge[0])));
      StepState::Pressure& pressure = state_.pressures[kind_of(block)][edge];
      if (is_first_in_step(fmt::format("{} {} {}", block.keyword, edge[0], edge[1])))
        pressure = {is_of_side ? fmt::format("{}_{}", fields[0], kind) : fields[0], 0};
      pressure.value_MPa += value;
    }
  }

  const Deck& deck_;
  const Amplitudes amplitudes_;
  StepState state_;
  std::set<std::string> given_, cleared_;  // in this step: loads; keywords, by OP=NEW
  double duration_ = 1;
};

}  // namespace

std::vector<StepState> read_steps(const Deck& deck) { return StepReader(deck).read(); }

Eigen::Vector2d weight_N_per_mm3(const Deck& deck, const DeckProperties& properties,
                                 const StepState& state) {
  if (state.gravity.empty()) return Eigen::Vector2d::Zero();
  std::map<std::string, Eigen::Vector2d> of_body;
  for (const auto& [set, acceleration] : state.gravity) {
    const auto members = deck.element_sets.find(set);
    if (members == deck.element_sets.end())
      throw InputError(fmt::format("GRAV: {}: no such set", set));
    const std::set<long> with(members->second.begin(), members->second.end());
    for (const auto& [body, material] : properties.materials) {
      if (!std::ranges::all_of(deck.element_sets.at(body),
                               [&](long e) { return with.contains(e); }))
        continue;
      if (!material.density)
        throw InputError(fmt::format("GRAV: the material of {} has no *DENSITY", body));
      of_body.emplace(body, Eigen::Vector2d::Zero()).first->second +=
          *material.density * acceleration;
    }
  }
  for (const auto& [body, material] : properties.materials)
    if (!of_body.contains(body) || of_body.at(body) != of_body.begin()->second)
      throw InputError("GRAV: bodies of different weight per volume (allowed: the same in all)");
  return of_body.begin()->second;
}

}  // namespace airybench
