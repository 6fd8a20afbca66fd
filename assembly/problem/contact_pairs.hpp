// The edges of contact pairs: of groups that a scene names, and once their meshes match.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "assembly/problem/face_matching.hpp"

namespace airybench {

// Throws TransformError: a label that is no contact group, or given twice.
void check_labels(const Mesh& mesh, const std::vector<ContactPair>& pairs);

// "contacts: contact:a and contact:b", for messages.
std::string place_of(const ContactPair& pair);

// The group of contact edges that meet nothing, and are free.
inline constexpr std::string_view out_of_reach = "out of reach";
void free_unmet_edges(Mesh& mesh, const ContactPair& pair, const std::vector<bool>& is_met);

// Rows of Mesh::boundary: an edge of the first face and the one of the second that it faces, once
// they match. Throws TransformError if there are none.
std::vector<std::array<int, 2>> facing_edges(const Mesh& mesh, const ContactPair& pair,
                                             const FaceMatching& matching);

}  // namespace airybench
