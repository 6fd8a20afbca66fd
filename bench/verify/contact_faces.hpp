// The contact faces that a user knows: by the label of their edges or, where bodies press on each
// other, by both labels.
#pragma once

#include <string>
#include <vector>

#include "assembly/problem/problem.hpp"

namespace airybench {

struct ContactFace {
  std::string name;       // "contact:sole", "contact:pin against contact:eye"
  std::vector<int> rows;  // of Mesh::boundary; of a pair those of the label that is named first
};

// In the order of their names.
std::vector<ContactFace> contact_faces(const Problem& problem);

// Per row of Mesh::boundary: is it one of the face's, of a pair on either body?
std::vector<bool> is_on_face(const Problem& problem, const ContactFace& face);

}  // namespace airybench
