// The contact faces that a user knows: by the label of their edges or, where bodies press on each
// other, by both labels.
#pragma once

#include <string>
#include <vector>

#include "assembly/problem/problem.hpp"

namespace airybench {

struct ContactFace {
  std::vector<std::string> labels;  // "contact:sole"; of a pair two
  std::vector<int> rows;            // of Mesh::boundary; of a pair those of the first label
};

// "contact:sole", "contact:pin against contact:eye".
std::string face_name(const std::vector<std::string>& labels);

// In the order of their labels.
std::vector<ContactFace> contact_faces(const Problem& problem);

// Per row of Mesh::boundary: is it one of the face's, of a pair on either body?
std::vector<bool> is_on_face(const Problem& problem, const ContactFace& face);

}  // namespace airybench
