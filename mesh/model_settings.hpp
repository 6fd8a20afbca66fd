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
    "role of a model's physical curve NAME, of curve 3, curves 1-4 or the rest (default: force): "
    "displacement, force or contact, also with a name, force:top; repeatable"};
inline constexpr ModelSetting parameter_setting = {
    "--parameter", "NAME=NUMBER",
    "replaces the value that DefineConstant gives NAME in a .geo; repeatable"};
inline constexpr ModelSetting mesh_size_setting = {
    "--mesh-size", "MM",
    "longest edge of a model's mesh in mm (shorter sizes of the model stay); or a share of all its "
    "sizes, 50%"};
inline constexpr ModelSetting length_unit_setting = {"--length-unit", "UNIT",
                                                     "unit of a model's lengths: mm, m, inch"};
// Of the process that reads the model: they change no mesh.
inline constexpr double default_model_time_s = 900, default_model_memory_MiB = 4096;
inline constexpr ModelSetting model_time_setting = {
    "--model-time", "SECONDS", "limit of reading and meshing a model in seconds (default: 900)"};
inline constexpr ModelSetting model_memory_setting = {
    "--model-memory", "MIB", "limit of memory for reading and meshing a model (default: 4096)"};
inline constexpr std::array model_settings = {role_setting,       parameter_setting,
                                              mesh_size_setting,  length_unit_setting,
                                              model_time_setting, model_memory_setting};

// setting: "--option=value".
inline bool is_model_limit(std::string_view setting) {
  return setting.starts_with(model_time_setting.option) ||
         setting.starts_with(model_memory_setting.option);
}

}  // namespace airybench
