// What a user says of a Gmsh model on the command line.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace airybench {

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
};

// From the values of --role, NAME=LABEL, of --parameter, NAME=VALUE, of --mesh-size, "0.5" (mm) or
// "50%", and of --length-unit; empty: not given. Throws std::invalid_argument, one line.
ModelOptions model_options_of(const std::vector<std::string>& roles,
                              const std::vector<std::string>& parameters,
                              const std::string& mesh_size, const std::string& length_unit = "");

// Equal options, and no others, have equal texts.
std::string text_of(const ModelOptions& options);

}  // namespace airybench
