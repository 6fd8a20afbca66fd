// Meshes of other programs that Gmsh does not read, as MSH 2.2.
#pragma once

#include <string>

#include "meshgen/deck.hpp"

namespace airybench {

// A triangle or quadrilateral of a body, its corners first, with the next number.
void add_plane_element(Deck& deck, std::vector<long> nodes, std::size_t corners,
                       const std::string& body);

// FreeFEM's savemesh, also a .msh: "vertices triangles edges", then "x y label", "a b c region" and
// "a b label". The edges of a label are a physical curve of that name, label 0 is none; regions are
// bodies.
bool is_of_freefem(const std::string& text);
// Throws InputError: line, what is wrong. So does the next.
std::string msh_of_freefem(const std::string& text);

// Wavefront's .obj: its v and f, of three or four corners; vertices in one place are one.
std::string msh_of_obj(const std::string& text);

}  // namespace airybench
