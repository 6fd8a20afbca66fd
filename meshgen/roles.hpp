// The role of each curve of a model.
#pragma once

#include <string>
#include <vector>

#include "meshgen/model_options.hpp"
#include "meshgen/plane_model.hpp"

namespace airybench {

// Labels the curves: by their numbers in the options, then by ranges of these, then by their
// physical names, as they are or as the options label them, then by the options' "rest". What is
// left on the boundary is free, "force"; a note lists it. Throws InputError.
void give_roles(PlaneModel& model, const ModelOptions& options, std::vector<std::string>& notes);

// The role that a name may mean: "contct", "Contact", "forces", "contact_left", "left contact".
// Empty: none.
std::string role_meant_by(const std::string& name);

// Throws InputError for a curve whose name resembles a role and which is given none by its name or
// number: that it is free, or of the rest, may not be meant.
void refuse_misspelt_roles(const PlaneModel& model);

}  // namespace airybench
