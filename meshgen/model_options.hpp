// What a user says of a Gmsh model on the command line.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mesh/model_settings.hpp"

namespace airybench {

// Of the process that reads and meshes a model (in_a_child.hpp).
struct ModelLimits {
  double time_s = default_model_time_s;
  double memory_MiB = default_model_memory_MiB;
};

struct ModelOptions {
  // Labels ("force:top") by what they are given to: a physical curve's name or number, a curve's
  // number "3", numbers "1-4", or "rest".
  std::map<std::string, std::string> roles;
  // Numbers in place of the model's own, by the names that it defines them with.
  std::map<std::string, double> parameters;
  // No edge is asked to be longer; where the model asks for shorter ones, they stay.
  std::optional<double> longest_edge_mm;
  // All sizes that the model asks for are multiplied by this.
  std::optional<double> size_factor;
  double length_unit_mm = 1;     // of the model's lengths
  std::optional<int> algorithm;  // in place of the model's; Gmsh's number
  ModelLimits limits = {};       // no part of text_of()
};

// From the values of --role, NAME=LABEL, of --parameter, NAME=VALUE, of --mesh-size, "0.5" (mm) or
// "50%", and of --length-unit; empty: not given. Throws std::invalid_argument, one line.
ModelOptions model_options_of(const std::vector<std::string>& roles,
                              const std::vector<std::string>& parameters,
                              const std::string& mesh_size, const std::string& length_unit = "");

// From the values of --model-time and --model-memory; empty: the default. Throws alike.
ModelLimits model_limits_of(const std::string& time_s, const std::string& memory_MiB);

// Equal options, but for limits, and no others, have equal texts.
std::string text_of(const ModelOptions& options);

}  // namespace airybench
