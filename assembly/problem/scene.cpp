#include "assembly/problem/scene.hpp"

#include <algorithm>

#include "assembly/problem/magnitudes.hpp"
#include "assembly/problem/scene_errors.hpp"
#include "support/lists.hpp"

namespace airybench {
namespace {

void check_material(const Scene& scene, const std::string& prefix, const Material& material) {
  if (!(material.young_MPa >= 1e-30 && material.young_MPa <= 1e30))
    fail(scene, prefix + "young_MPa", material.young_MPa, "(allowed: 1e-30 to 1e30)");
  if (!(material.poisson > -1 && material.poisson < 0.5))
    fail(scene, prefix + "poisson", material.poisson,
         "(allowed: between -1 and 0.5, both excluded)");
  if (const double expansion = material.expansion_per_K.value_or(0); !(std::abs(expansion) <= 1))
    fail(scene, prefix + "expansion_per_K", expansion, "(allowed: -1 to 1)");
}

void check_friction(const Scene& scene, const std::string& key, double friction) {
  if (!(friction >= 0 && friction <= max_friction))
    fail(scene, key, friction, "(allowed: 0 to 1e6)");
}

void check_loads(const Scene& scene, const std::string& prefix, const Temperatures& temperature_K,
                 double clearance_mm, const Eigen::Vector2d& displacement_mm,
                 const Eigen::Vector2d& body_force_N_per_mm3) {
  for (const auto& of_body : temperature_K)
    of_scene(scene, prefix + "temperature_K",
             [&] { check(of_body.first, std::optional(of_body.second), temperature_magnitude); });
  if (!(clearance_mm >= 0 && length_magnitude.has(clearance_mm)))
    fail(scene, prefix + "clearance_mm", clearance_mm, "(allowed: 0 to 1e15 mm)");
  if (!length_magnitude.has(displacement_mm))
    fail(scene, prefix + "displacement_mm", shown(displacement_mm), length_magnitude.allowed);
  if (!body_force_magnitude.has(body_force_N_per_mm3))
    fail(scene, prefix + "body_force_N_per_mm3", shown(body_force_N_per_mm3),
         body_force_magnitude.allowed);
}

void check_clearance(const Scene& scene, const std::string& prefix, const ContactPair& pair) {
  if (pair.clearance_mm && !length_magnitude.has(*pair.clearance_mm))
    fail(scene, prefix + "contacts: clearance_mm", *pair.clearance_mm, length_magnitude.allowed);
}

void check_contacts(const Scene& scene) {
  for (const ContactPair& pair : scene.contacts) {
    if (pair.is_bonded() && (pair.friction || pair.clearance_mm))
      fail(scene, "contacts", names_of(pair),
           "bonded (allowed: without friction, clearance_mm; an interference is a temperature)");
    if (pair.friction) check_friction(scene, "contacts: friction", *pair.friction);
    check_clearance(scene, "", pair);
  }
  for (const auto& [label, values] : scene.boundary)
    if (is_paired(scene, label))
      for (const auto& [key, is_given] :
           {std::pair("friction", values.contact.friction.has_value()),
            {"clearance_mm", values.contact.clearance_mm.has_value()},
            {"wall", values.contact.wall.has_value()}})
        if (is_given)
          fail(scene, "boundary: " + label, key,
               "of a group in contacts (allowed: face; friction and clearance_mm of the pair)");
}

void check_common_face(const Scene& scene) {
  const auto has_wall = [](const auto& group) { return group.second.contact.wall.has_value(); };
  if (scene.face && !scene.wall && std::ranges::none_of(scene.boundary, has_wall))
    fail(scene, "face", "given", "without a wall (allowed: with one)");
}

void check_contacts_of_step(const Scene& scene, std::size_t k) {
  const std::vector<ContactPair>& contacts = scene.later_steps[k].contacts;
  for (const ContactPair& pair : contacts) {
    if (std::ranges::count(contacts, pair.between, &ContactPair::between) > 1)
      fail(scene, key_of_step(k) + "contacts: between", names_of(pair),
           "twice (allowed: every pair once)");
    const auto own = std::ranges::find(scene.contacts, pair.between, &ContactPair::between);
    if (own == scene.contacts.end() || own->is_bonded())
      fail(scene, key_of_step(k) + "contacts: between", names_of(pair),
           "(allowed: as in contacts of the scene, not bonded)");
    if (pair.friction || !pair.clearance_mm || pair.is_bonded())
      fail(scene, key_of_step(k) + "contacts", names_of(pair),
           "(allowed: clearance_mm, and no friction)");
    check_clearance(scene, key_of_step(k), pair);
  }
}

void check_steps(const Scene& scene) {
  if (scene.equal_steps < 1 || scene.equal_steps > max_load_steps)
    fail(scene, "load_steps", scene.equal_steps,
         "(allowed: from 1 to " + std::to_string(max_load_steps) + ")");
  if (scene.equal_steps > 1 && !scene.later_steps.empty())
    fail(scene, "load_steps", scene.equal_steps, "and a list (allowed: one of them)");
  for (std::size_t k = 0; k < scene.later_steps.size(); ++k) {
    const LoadStep& step = scene.later_steps[k];
    of_scene(scene, key_of_step(k) + "boundary", [&] { check_values_of_step(step.boundary); });
    check_loads(scene, key_of_step(k), step.temperature_K, step.clearance_mm.value_or(0),
                step.displacement_mm.value_or(Eigen::Vector2d::Zero()),
                step.body_force_N_per_mm3.value_or(Eigen::Vector2d::Zero()));
    for (const auto& [label, values] : step.boundary) {
      if (values.contact.clearance_mm && is_paired(scene, label))
        fail(scene, key_of_step(k) + "boundary: " + label, "clearance_mm",
             "of a group in contacts (allowed: clearance_mm of the pair, in contacts)");
      for (const auto& [key, is_given] :
           {std::pair("friction", values.contact.friction.has_value()),
            {"wall", values.contact.wall.has_value()},
            {"face", values.contact.face.has_value()}})
        if (is_given)
          fail(scene, key_of_step(k) + "boundary: " + label, key,
               "(allowed: traction_MPa, pressure_MPa, displacement_mm, support, clearance_mm)");
    }
    check_contacts_of_step(scene, k);
  }
}

}  // namespace

std::string names_of(const ContactPair& pair) {
  return joined(pair.between[0]) + " and " + joined(pair.between[1]);
}

bool is_paired(const Scene& scene, const std::string& label) {
  return std::ranges::any_of(scene.contacts,
                             [&](const ContactPair& pair) { return pair.has(label); });
}

void check_values(const Scene& scene) {
  check_material(scene, "", scene.material);
  for (const auto& [body, material] : scene.materials)
    check_material(scene, "materials: " + body + ": ", material);
  for (const Material& material : scene.layer_materials)
    check_material(scene, "layers: materials: ", material);
  of_scene(scene, "mesh", [&] { check_values(scene.mesh); });
  of_scene(scene, "layers", [&] { check_values(scene.layers); });
  check_friction(scene, "friction", scene.friction);
  if (scene.crown_radius_mm &&
      !(*scene.crown_radius_mm > 0 && length_magnitude.has(*scene.crown_radius_mm)))
    fail(scene, "crown_radius_mm", *scene.crown_radius_mm,
         "(allowed: > 0, up to 1e15 mm, or null for a wall on the edges)");
  of_scene(scene, "", [&] { check_curve("wall", scene.wall); });
  of_scene(scene, "", [&] { check_curve("face", scene.face); });
  check_contacts(scene);
  check_common_face(scene);
  for (const PointSupport& point : scene.point_supports)
    for (const double number :
         {point.at_mm.x(), point.at_mm.y(), point.displacement_mm[0].value_or(0),
          point.displacement_mm[1].value_or(0)})
      if (!std::isfinite(number))
        fail(scene, "point_supports", number, "(allowed: finite numbers)");
  of_scene(scene, "boundary", [&] { check_values(scene.boundary); });
  check_loads(scene, "", scene.temperature_K, scene.clearance_mm, scene.displacement_mm,
              scene.body_force_N_per_mm3);
  check_steps(scene);
}

}  // namespace airybench
