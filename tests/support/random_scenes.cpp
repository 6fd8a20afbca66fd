#include "tests/support/random_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <sstream>

#include "tests/support/dice.hpp"

namespace airybench::testing {
namespace {

using Change = std::function<std::string(Scene&, Dice&)>;

std::string soft_and_stiff_layers(Scene& s, Dice& dice) {
  s.layers.count = 2 + dice.below(4);
  s.layers.normal = dice.below(2) == 0 ? Eigen::Vector2d(1, 0) : Eigen::Vector2d(0, 1);
  const double contrast = dice.log_between(1e-8, 1e8);
  Material other = s.material;
  other.young_MPa *= contrast;
  s.layer_materials = {s.material, other};
  return fmt::format("{} layers, {:.1e}", s.layers.count, contrast);
}

const std::vector<Change>& changes() {
  static const std::vector<Change> all = {
      [](Scene& s, Dice& dice) {
        s.material.young_MPa = dice.log_between(1e-6, 1e12);
        return fmt::format("E {:.1e}", s.material.young_MPa);
      },
      [](Scene& s, Dice& dice) {
        s.material.poisson = 0.5 - dice.log_between(1e-7, 0.1);
        return fmt::format("nu 0.5 - {:.1e}", 0.5 - s.material.poisson);
      },
      [](Scene& s, Dice& dice) {
        s.friction = dice.below(4) == 0 ? 0 : dice.log_between(1e-8, 10);
        return fmt::format("mu {:.1e}", s.friction);
      },
      [](Scene& s, Dice& dice) {
        s.displacement_mm = {dice.sign() * dice.log_between(1e-9, 1e3),
                             dice.sign() * dice.log_between(1e-9, 1e6)};
        return fmt::format("u0 {:.1e} {:.1e}", s.displacement_mm.x(), s.displacement_mm.y());
      },
      [](Scene& s, Dice& dice) {
        if (dice.below(2) == 0)
          s.crown_radius_mm.reset();
        else
          s.crown_radius_mm = dice.log_between(1, 1e6);
        return fmt::format("R {:.1e}", s.crown_radius_mm.value_or(0));
      },
      [](Scene& s, Dice& dice) {
        s.clearance_mm = s.displacement_mm.x() * dice.between(0.5, 1.1);
        if (!(s.clearance_mm > 0)) s.clearance_mm = 0.01;
        return fmt::format("clearance {:.1e}", s.clearance_mm);
      },
      [](Scene& s, Dice& dice) {
        s.body_force_N_per_mm3 = {dice.sign() * dice.log_between(1e-6, 1e3),
                                  dice.sign() * dice.log_between(1e-6, 1e3)};
        return fmt::format("b {:.1e} {:.1e}", s.body_force_N_per_mm3.x(),
                           s.body_force_N_per_mm3.y());
      },
      soft_and_stiff_layers,
      [](Scene& s, Dice& dice) {
        Grading& grade = s.mesh.grade.emplace();
        grade.at_mm = {dice.between(0, 10), dice.between(-4, 4)};
        grade.ratio = dice.log_between(2, 1e4);
        return fmt::format("grade {:.1e}", grade.ratio);
      },
      [](Scene& s, Dice& dice) {
        Slivers& slivers = s.mesh.slivers.emplace();
        slivers.aspect = dice.log_between(5, 1e5);
        slivers.count = 1 + dice.below(20);
        return fmt::format("{} slivers {:.1e}", slivers.count, slivers.aspect);
      },
      [](Scene& s, Dice& dice) {
        s.mesh.scale = dice.log_between(1e-6, 1e6);
        return fmt::format("scale {:.1e}", s.mesh.scale);
      },
      [](Scene& s, Dice& dice) {
        s.mesh.stretch = {dice.log_between(1e-2, 1e2), dice.log_between(1e-2, 1e2)};
        return fmt::format("stretch {:.1e} {:.1e}", s.mesh.stretch.x(), s.mesh.stretch.y());
      },
      [](Scene& s, Dice& dice) {
        s.mesh.move_mm = {dice.sign() * dice.log_between(1, 1e6),
                          dice.sign() * dice.log_between(1, 1e6)};
        return fmt::format("moved {:.1e} {:.1e}", s.mesh.move_mm.x(), s.mesh.move_mm.y());
      },
      [](Scene& s, Dice& dice) {
        s.mesh.keep_contact_edges = dice.below(5);
        return fmt::format("{} contact edges", *s.mesh.keep_contact_edges);
      },
      [](Scene& s, Dice& dice) {
        s.mesh.keep_displacement_edges = 1 + dice.below(2);
        return fmt::format("{} displacement edges", *s.mesh.keep_displacement_edges);
      },
      [](Scene& s, Dice& dice) {
        s.mesh.keep_force_edges = dice.below(4);
        return fmt::format("{} force edges", *s.mesh.keep_force_edges);
      },
      [](Scene& s, Dice&) {
        s.plane = Plane::stress;
        return std::string("plane stress");
      },
  };
  return all;
}

}  // namespace

Scene random_scene(unsigned seed, int number) {
  Dice dice(seed * 1000003u + static_cast<unsigned>(number));
  Scene scene;
  scene.name = fmt::format("random_{}_{}", seed, number);
  scene.source = scene.name;
  std::vector<int> left(changes().size());
  for (std::size_t k = 0; k < left.size(); ++k) left[k] = static_cast<int>(k);
  const int extremes = 2 + dice.below(3);
  std::vector<int> taken;
  for (int k = 0; k < extremes; ++k) {
    const int at = dice.below(static_cast<int>(left.size()));
    taken.push_back(left[at]);
    left.erase(left.begin() + at);
  }
  std::sort(taken.begin(), taken.end());  // what is relative to another comes after it
  for (const int k : taken)
    scene.about += (scene.about.empty() ? "" : ", ") + changes()[k](scene, dice);
  return scene;
}

Campaign campaign(int own_count) {
  Campaign campaign{.count = own_count};
  if (const char* given = std::getenv("AIRYBENCH_RANDOM_SCENES")) {
    std::istringstream text(given);
    char comma = 0;
    text >> campaign.first >> comma >> campaign.count >> comma >> campaign.mesh;
    if (campaign.mesh.empty()) campaign.mesh = "Mesh0";
    campaign.is_asked_for = true;
  }
  return campaign;
}

}  // namespace airybench::testing
