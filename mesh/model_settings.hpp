// How a Gmsh model becomes a mesh: the options of `meshgen --convert`, which `bench --mesh=MODEL`
// takes too and hands on.
#pragma once

#include <array>
#include <string_view>

namespace airybench {

struct ModelSetting {
  const char *option, *type, *help;
};

inline constexpr ModelSetting role_setting = {
    "--role", "NAME=ROLE",
    "a model's physical curve NAME, curve 3, curves 1-4 or the rest (default: force) are "
    "displacement, force or contact, or one of these with a name, force:top; repeatable"};
inline constexpr ModelSetting parameter_setting = {
    "--parameter", "NAME=NUMBER",
    "in place of what a .geo's DefineConstant gives NAME; repeatable"};
inline constexpr ModelSetting mesh_size_setting = {
    "--mesh-size", "MM",
    "a model's longest edge in mm, where it asks for shorter ones they stay; or a part of all its "
    "sizes, 50%"};
inline constexpr ModelSetting length_unit_setting = {"--length-unit", "UNIT",
                                                     "unit of a model's lengths: mm, m, inch"};
// Of the process that reads the model: they change no mesh.
inline constexpr double default_model_time_s = 900, default_model_memory_MiB = 4096;
inline constexpr ModelSetting model_time_setting = {
    "--model-time", "SECONDS", "that reading and meshing a model may take (default: 900)"};
inline constexpr ModelSetting model_memory_setting = {
    "--model-memory", "MIB", "of memory that reading and meshing a model may take (default: 4096)"};
inline constexpr std::array model_settings = {role_setting,       parameter_setting,
                                              mesh_size_setting,  length_unit_setting,
                                              model_time_setting, model_memory_setting};

// setting: "--option=value".
inline bool is_model_limit(std::string_view setting) {
  return setting.starts_with(model_time_setting.option) ||
         setting.starts_with(model_memory_setting.option);
}

}  // namespace airybench
