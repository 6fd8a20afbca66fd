// How a Gmsh model becomes a mesh: the options of `meshgen --convert`, which `bench --mesh=MODEL`
// takes too and hands on.
#pragma once

#include <array>

namespace airybench {

struct ModelSetting {
  const char *option, *type, *help;
};

inline constexpr ModelSetting role_setting = {
    "--role", "NAME=ROLE",
    "a Gmsh model's physical curve NAME is displacement, force or contact, or one of these with a "
    "name, force:top; of a CAD file NAME is a curve's number; repeatable"};
inline constexpr ModelSetting parameter_setting = {
    "--parameter", "NAME=NUMBER",
    "in place of what a .geo's DefineConstant gives NAME; repeatable"};
inline constexpr ModelSetting mesh_size_setting = {
    "--mesh-size", "MM",
    "a model's longest edge in mm, where it asks for shorter ones they stay; or a part of all its "
    "sizes, 50%"};
inline constexpr std::array model_settings = {role_setting, parameter_setting, mesh_size_setting};

}  // namespace airybench
