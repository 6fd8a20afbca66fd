#include "meshgen/deck_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "meshgen/deck_properties.hpp"
#include "meshgen/deck_steps.hpp"
#include "support/errors.hpp"
#include "support/lists.hpp"

namespace airybench {
namespace {

using Json = nlohmann::ordered_json;

// On an edge of the boundary, per step.
struct EdgeState {
  Held held;
  std::optional<double> pressure_MPa;
  std::optional<Eigen::Vector2d> traction_MPa;
  bool operator==(const EdgeState&) const = default;
  bool is_held() const { return held[0] || held[1]; }
  bool is_held_fully() const { return held[0] && held[1]; }
};

class SceneReader {
 public:
  explicit SceneReader(const Deck& deck)
      : deck_(deck), properties_(read_properties(deck)), states_(read_steps(deck)) {
    check_plane();
    for (const auto& [edge, element] : deck.boundary)
      for (const long node : nodes_of(edge)) edges_of_[node].push_back(edge);
  }

  DeckScene read() {
    read_supports();
    for (std::size_t step = 0; step < states_.size(); ++step) take_forces(step);
    DeckScene scene;
    label_edges();
    scene.curve = curves();
    try {
      scene.json = json(scene.curve).dump(2) + "\n";
    } catch (const Json::type_error&) {
      throw InputError("a name that is no UTF-8 (allowed: UTF-8)");
    }
    scene.notes = std::move(properties_.notes);
    return scene;
  }

 private:
  void check_plane() const {
    std::optional<double> z;
    for (const auto& [number, element] : deck_.elements)
      for (const long node : element.nodes) {
        const Eigen::Vector3d& x = deck_.nodes.at(node);
        if (!z) z = x.z();
        constexpr double rounding = 1e-6;
        if (element.is_plane() && std::abs(x.z() - *z) > rounding * (1 + x.head<2>().norm()))
          throw InputError(fmt::format("{} has z = {}, others {} (allowed: a plane z = constant)",
                                       deck_.shown(node), x.z(), *z));
      }
  }

  // Corners, and the node between them if there is one.
  std::vector<long> nodes_of(const DeckEdge& edge) const {
    std::vector<long> nodes = {edge[0], edge[1]};
    const DeckElement& element = deck_.elements.at(deck_.boundary.at(edge));
    const std::size_t n = element.corner_count;
    for (std::size_t k = 0; k < n && element.nodes.size() == 2 * n; ++k)
      if (deck_edge(element.nodes[k], element.nodes[(k + 1) % n]) == edge)
        nodes.push_back(element.nodes[n + k]);
    return nodes;
  }
  Eigen::Vector2d place(long node) const { return deck_.place(node); }
  double length(const DeckEdge& edge) const { return (place(edge[1]) - place(edge[0])).norm(); }
  // What all nodes of an edge have in common.
  Held held_on(const StepState& state, const DeckEdge& edge) const {
    const std::vector<long> nodes = nodes_of(edge);
    Held held;
    for (std::size_t k = 0; k < 2; ++k) {
      const auto value_at = [&](long node) -> std::optional<double> {
        const auto found = state.held.find(node);
        return found == state.held.end() ? std::nullopt : found->second[k];
      };
      if (!std::ranges::all_of(nodes, [&](long node) { return value_at(node).has_value(); }))
        continue;
      held[k] = value_at(nodes.front());
      for (const long node : nodes)
        if (*value_at(node) != *held[k])
          throw InputError(
              fmt::format("*BOUNDARY: {} and {} are moved differently (allowed: "
                          "sides that keep their shape)",
                          deck_.shown(nodes.front()), deck_.shown(node)));
    }
    return held;
  }

  // Nodes that are held, and no side of theirs so.
  std::map<long, Held> held_alone(const StepState& state) const {
    std::map<long, Held> alone;
    for (const auto& [node, held] : state.held) {
      const auto edges = edges_of_.find(node);
      for (std::size_t k = 0; k < 2; ++k) {
        const auto is_held = [&](const auto& edge) { return held_on(state, edge)[k].has_value(); };
        if (held[k] && (edges == edges_of_.end() || std::ranges::none_of(edges->second, is_held)))
          alone[node][k] = held[k];
      }
    }
    return alone;
  }

  // Points are the same in every step; sides may be held in some.
  void read_supports() {
    points_ = held_alone(states_.front());
    for (const StepState& state : states_) {
      const std::map<long, Held> points = held_alone(state);
      for (const auto* of : {&points, &std::as_const(points_)})
        for (const auto& [node, held] : *of)
          if (!points.contains(node) || !points_.contains(node) ||
              points.at(node) != points_.at(node))
            throw InputError(fmt::format(
                "*BOUNDARY: {} is held in this node alone, and moved differently in the steps "
                "(allowed: the same in all)",
                deck_.shown(node)));
    }
    for (const auto& [node, held] : points_)
      properties_.notes.push_back(
          fmt::format("*BOUNDARY: {} is held alone: it takes out a rigid motion, and no force",
                      deck_.shown(node)));
  }

  // Nodal forces as even tractions with the same resultant on connected sides.
  void take_forces(std::size_t step) {
    std::map<long, Eigen::Vector2d> forces = states_[step].force_N;
    std::erase_if(forces, [](const auto& force) { return force.second.isZero(0); });
    const auto is_loaded = [&](const DeckEdge& edge) {
      return std::ranges::all_of(nodes_of(edge), [&](long n) { return forces.contains(n); });
    };
    std::set<long> left;
    for (const auto& [node, force] : forces) left.insert(node);
    while (!left.empty()) {
      std::vector<long> chain = {*left.begin()};
      std::set<DeckEdge> edges;
      left.erase(left.begin());
      for (std::size_t k = 0; k < chain.size(); ++k)
        if (const auto found = edges_of_.find(chain[k]); found != edges_of_.end())
          for (const DeckEdge& edge : found->second)
            if (is_loaded(edge) && edges.insert(edge).second)
              for (const long node : nodes_of(edge))
                if (left.erase(node) > 0) chain.push_back(node);
      if (edges.empty())
        throw InputError(fmt::format(
            "*CLOAD: {}: a force in this node alone, where stress is infinite (allowed: on all "
            "nodes of sides of the boundary, or *DLOAD, *DSLOAD)",
            deck_.shown(chain.front())));
      Eigen::Vector2d total = Eigen::Vector2d::Zero();
      double whole = 0;
      for (const DeckEdge& edge : edges) whole += length(edge);
      for (const long node : chain) total += forces.at(node);
      std::map<long, Eigen::Vector2d> even;  // what an even traction gives each node
      for (const DeckEdge& edge : edges) {
        const std::vector<long> nodes = nodes_of(edge);
        for (std::size_t k = 0; k < nodes.size(); ++k) {
          const double share = nodes.size() == 2 ? 1. / 2 : k < 2 ? 1. / 6 : 4. / 6;
          even.emplace(nodes[k], Eigen::Vector2d::Zero()).first->second +=
              share * length(edge) / whole * total;
        }
      }
      double largest = 0, off_even = 0, off_equal = 0;
      for (const long node : chain) {
        const Eigen::Vector2d& force = forces.at(node);
        largest = std::max(largest, force.norm());
        off_even = std::max(off_even, (force - even.at(node)).norm());
        off_equal = std::max(off_equal, (force - total / static_cast<double>(chain.size())).norm());
      }
      constexpr double uneven = 0.02;
      const bool are_equal = off_even > uneven * largest;
      if (are_equal && off_equal > uneven * largest)
        throw InputError(
            fmt::format("*CLOAD: forces from {} on are not even along their sides (allowed: even "
                        "ones, or the same on each node; *DLOAD and *DSLOAD give pressures)",
                        deck_.shown(chain.front())));
      for (const DeckEdge& edge : edges)
        traction_[step][edge] = total / (whole * properties_.thickness_mm);
      if (noted_.insert(chain.front()).second)
        properties_.notes.push_back(fmt::format(
            "*CLOAD on {} nodes from {} on{}: as an even traction with the same "
            "resultant",
            chain.size(), deck_.shown(chain.front()), are_equal ? ", the same on each" : ""));
    }
  }

  EdgeState state_on(std::size_t step, const DeckEdge& edge) const {
    EdgeState state{held_on(states_[step], edge), {}, {}};
    for (const auto& of_kind : states_[step].pressures)
      if (const auto found = of_kind.find(edge); found != of_kind.end())
        state.pressure_MPa = state.pressure_MPa.value_or(0) + found->second.value_MPa;
    if (const auto of_step = traction_.find(step); of_step != traction_.end())
      if (const auto found = of_step->second.find(edge); found != of_step->second.end())
        state.traction_MPa = found->second;
    return state;
  }

  std::string face_of(const DeckEdge& edge) const {
    std::string face;
    for (const DeckPair& pair : properties_.pairs)
      for (const std::string& name : pair.faces)
        if (deck_.surfaces.at(name).contains(edge)) {
          if (!face.empty())
            throw InputError(fmt::format("surfaces {} and {} of contact pairs share the side at {}",
                                         face, name, deck_.shown(edge[0])));
          face = name;
        }
    return face;
  }

  std::string name_of_set(const DeckEdge& edge, const char* otherwise) const {
    if (const auto names = deck_.names.find(edge); names != deck_.names.end())
      for (const std::string& name : names->second)
        if (states_.back().sets.contains(name)) return name;
    return otherwise;
  }

  // The first that is given.
  std::optional<std::string> name_of_pressure(const DeckEdge& edge) const {
    for (const StepState& state : states_)
      for (const auto& of_kind : state.pressures)
        if (const auto found = of_kind.find(edge); found != of_kind.end())
          return found->second.name;
    return {};
  }

  void check_roller(const DeckEdge& edge, const EdgeState& state, const auto& refuse) const {
    if (state.pressure_MPa || state.traction_MPa)
      refuse("held in one direction, and loaded (allowed: one)");
    const Eigen::Vector2d along = (place(edge[1]) - place(edge[0])) / length(edge);
    if (std::abs(along[state.held[0] ? 0 : 1]) > 1e-6)
      refuse(state.held[0] ? "x alone is held (allowed: on sides along y, or x and y)"
                           : "y alone is held (allowed: on sides along x, or x and y)");
  }

  void label_edges() {
    std::map<std::string, std::string> label_of;  // by what is prescribed in all steps
    std::set<std::string> taken;
    for (const auto& entry : deck_.boundary) {
      const DeckEdge& edge = entry.first;
      const std::string face = face_of(edge);
      std::string key;
      const auto refuse = [&](const char* what) {
        throw InputError(fmt::format("the side at {}: {}", deck_.shown(edge[0]), what));
      };
      bool is_loaded = false, is_held = false, adds_to_reaction = false;
      for (std::size_t step = 0; step < states_.size(); ++step) {
        const EdgeState state = state_on(step, edge);
        const bool has_load = state.pressure_MPa || state.traction_MPa;
        is_loaded |= has_load;
        is_held |= state.is_held();
        adds_to_reaction |= has_load && state.is_held();
        if (state.is_held() && !state.is_held_fully()) check_roller(edge, state, refuse);
        if (state.pressure_MPa && state.traction_MPa)
          throw InputError(fmt::format("a pressure and *CLOAD on the side at {} (allowed: one)",
                                       deck_.shown(edge[0])));
        for (const std::optional<double>& x :
             {state.held[0], state.held[1], state.pressure_MPa,
              state.traction_MPa ? std::optional(state.traction_MPa->x()) : std::nullopt,
              state.traction_MPa ? std::optional(state.traction_MPa->y()) : std::nullopt})
          key += x ? fmt::format("{} ", *x) : "- ";
      }
      if (!face.empty()) {
        if (is_held || is_loaded) refuse("in a contact pair, and held or loaded (allowed: one)");
        label_[edge] = "contact:" + face;
        continue;
      }
      if (!is_held && !is_loaded) continue;
      if (adds_to_reaction)
        properties_.notes.push_back(fmt::format(
            "the load on the held side at {} only adds to its reaction", deck_.shown(edge[0])));
      const bool is_held_first = state_on(0, edge).is_held();
      std::string& label = label_of[key];
      if (label.empty()) {
        std::string name = name_of_set(edge, is_held ? "held" : "loaded");
        if (!is_held) name = name_of_pressure(edge).value_or(name);
        const char* const role = is_held_first ? "displacement" : "force";
        label = fmt::format("{}:{}", role, name);
        for (int k = 2; !taken.insert(label).second; ++k)
          label = fmt::format("{}:{}_{}", role, name, k);
        example_[label] = edge;
      }
      label_[edge] = label;
    }
    for (const DeckPair& pair : properties_.pairs)
      for (const std::string& name : pair.faces)
        if (std::ranges::none_of(label_,
                                 [&](const auto& l) { return l.second == "contact:" + name; }))
          throw InputError(fmt::format("surface {} has no edge of the boundary", name));
  }

  std::map<DeckEdge, int> curves() const {
    std::map<std::string, int> numbers;
    std::map<DeckEdge, int> curve;
    const auto add = [&](const DeckEdge& edge) {
      std::string key;
      if (const auto names = deck_.names.find(edge); names != deck_.names.end())
        key = joined(names->second, "\n");
      if (const auto label = label_.find(edge); label != label_.end())
        key += "\n\n" + label->second;
      curve[edge] = numbers.emplace(key, static_cast<int>(numbers.size()) + 1).first->second;
    };
    for (const auto& [edge, names] : deck_.names) add(edge);
    for (const auto& [edge, label] : label_) add(edge);
    return curve;
  }

  // null: as before.
  Json values(std::size_t step, const DeckEdge& edge) const {
    const EdgeState state = state_on(step, edge);
    Json values = Json::object();
    if (state.is_held()) {
      values["displacement_mm"] = {state.held[0].value_or(0), state.held[1].value_or(0)};
      const auto has_changed = [&](const EdgeState& before) {
        return !before.is_held() || before.is_held_fully() != state.is_held_fully();
      };
      if (step == 0 || has_changed(state_on(step - 1, edge)))
        values["support"] = state.is_held_fully() ? "full" : "normal";
    } else if (state.traction_MPa) {
      values["traction_MPa"] = {state.traction_MPa->x(), state.traction_MPa->y()};
    } else {
      values["pressure_MPa"] = state.pressure_MPa.value_or(0);
    }
    return values;
  }

  Json body_force(std::size_t step) const {
    const Eigen::Vector2d force = weight_N_per_mm3(deck_, properties_, states_[step]);
    return {force.x(), force.y()};
  }

  Json points() const {
    Json points = Json::array();
    for (const auto& [node, held] : points_) {
      Json displacement = {nullptr, nullptr};
      for (std::size_t k = 0; k < 2; ++k)
        if (held[k]) displacement[k] = *held[k];
      points.push_back({{"at_mm", {place(node).x(), place(node).y()}},
                        {"displacement_mm", displacement},
                        {"body", body_at(node)}});
    }
    return points;
  }

  std::string body_at(long node) const {
    for (const auto& [number, body] : deck_.body)
      if (std::ranges::count(deck_.elements.at(number).nodes, node) > 0) return body;
    throw InputError(fmt::format("*BOUNDARY: {} is of no element", deck_.shown(node)));
  }

  Json json(const std::map<DeckEdge, int>& curve) const {
    Json scene = {{"plane", properties_.is_plane_stress ? "stress" : "strain"}};
    Json roles = Json::object(), boundary = Json::object();
    std::map<int, std::string> role;
    for (const auto& [edge, number] : curve) {
      const auto label = label_.find(edge);
      if (label != label_.end())
        role[number] = label->second;
      else
        role.emplace(number, "force");
    }
    for (const auto& [number, label] : role) roles[std::to_string(number)] = label;
    roles["rest"] = "force";
    scene["roles"] = roles;
    for (const auto& [body, material] : properties_.materials)
      scene["materials"][body] = {{"young_MPa", material.young_MPa}, {"poisson", material.poisson}};
    scene["displacement_mm"] = {0, 0};
    scene["body_force_N_per_mm3"] = body_force(0);
    for (const auto& [label, edge] : example_) {
      boundary[label] = values(0, edge);
    }
    if (!boundary.empty()) scene["boundary"] = boundary;
    if (!points_.empty()) scene["point_supports"] = points();
    for (const DeckPair& pair : properties_.pairs) {
      Json both = {{"between", {"contact:" + pair.faces[0], "contact:" + pair.faces[1]}}};
      if (pair.friction)
        both["friction"] = *pair.friction;
      else
        both["law"] = "bonded";
      scene["contacts"].push_back(std::move(both));
    }
    for (std::size_t step = 1; step < states_.size(); ++step) {
      Json change = Json::object();
      for (const auto& [label, edge] : example_)
        if (state_on(step, edge) != state_on(step - 1, edge))
          change["boundary"][label] = values(step, edge);
      if (const Json now = body_force(step); now != body_force(step - 1))
        change["body_force_N_per_mm3"] = now;
      scene["load_steps"].push_back(change);
    }
    return scene;
  }

  const Deck& deck_;
  DeckProperties properties_;
  const std::vector<StepState> states_;
  std::map<long, std::vector<DeckEdge>> edges_of_;  // of the boundary, by their nodes
  std::map<std::size_t, std::map<DeckEdge, Eigen::Vector2d>> traction_;  // of *CLOAD, per step
  std::map<long, Held> points_;                                          // by their nodes
  std::set<long> noted_;  // where chains of *CLOAD begin
  std::map<DeckEdge, std::string> label_;
  std::map<std::string, DeckEdge> example_;  // an edge of each label
};

}  // namespace

std::optional<DeckScene> scene_of(const Deck& deck) {
  if (!is_analysis(deck)) return {};
  return SceneReader(deck).read();
}

std::map<DeckEdge, int> curves_of(const Deck& deck) {
  try {
    if (const std::optional<DeckScene> scene = scene_of(deck)) return scene->curve;
  } catch (const InputError&) {  // its mesh can still be taken
  }
  return curves_by_names(deck);
}

}  // namespace airybench
