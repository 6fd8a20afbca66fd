#include "assembly/problem/materials.hpp"

#include <algorithm>

#include "assembly/problem/scene_errors.hpp"
#include "support/lists.hpp"

namespace airybench {
namespace {

void check_body(const Scene& scene, const std::string& key, const std::string& body,
                const Mesh& mesh) {
  if (std::ranges::count(mesh.body_names, body) == 0)
    fail(scene, key, body,
         "is no body of the mesh " + mesh.name + perhaps(body, mesh.body_names) +
             " (its bodies: " + joined(mesh.body_names) + ")");
}

}  // namespace

std::vector<Material> materials(const Scene& scene, const Mesh& mesh) {
  for (const auto& [body, material] : scene.materials) check_body(scene, "materials", body, mesh);
  std::vector<Material> result;
  for (std::size_t k = 0; k < mesh.body_names.size(); ++k) {
    const auto own = scene.materials.find(mesh.body_names[k]);
    const auto& layers = scene.layer_materials;
    result.push_back(own != scene.materials.end() ? own->second
                     : layers.empty()             ? scene.material
                                                  : layers[k % layers.size()]);
  }
  return result;
}

std::vector<ThermalStrain> thermal_strains(const Scene& scene, const std::string& prefix,
                                           const Mesh& mesh) {
  std::vector<ThermalStrain> strains;
  if (scene.temperature_K.empty()) return strains;
  for (const auto& [body, temperature] : scene.temperature_K)
    check_body(scene, prefix + "temperature_K", body, mesh);
  const std::vector<Material> of_body = materials(scene, mesh);
  for (std::size_t k = 0; k < of_body.size(); ++k) {
    ThermalStrain& strain = strains.emplace_back();
    const auto given = scene.temperature_K.find(mesh.body_names[k]);
    if (given == scene.temperature_K.end()) continue;
    const Material& material = of_body[k];
    if (!material.expansion_per_K)
      fail(scene, prefix + "temperature_K", mesh.body_names[k],
           "whose material has no expansion_per_K (allowed: with one)");
    const bool is_plane_strain = scene.plane == Plane::strain;
    const double expansion =
        *material.expansion_per_K * (is_plane_strain ? 1 + material.poisson : 1);
    const LinearValue<double>& at = given->second;
    const Eigen::Vector2d along = at.at_mm[1] - at.at_mm[0];
    strain.slope_per_mm = expansion * (at.values[1] - at.values[0]) / along.squaredNorm() * along;
    strain.at_origin = expansion * at.at({0, 0});
    if (is_plane_strain) strain.modulus_zz_MPa = material.young_MPa / (1 + material.poisson);
  }
  return strains;
}

}  // namespace airybench
