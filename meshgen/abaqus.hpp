// Files of Abaqus and CalculiX.
#pragma once

#include <string>

namespace airybench {

// The plane mesh of an .inp as MSH 2.2. A body is the set of a *SOLID SECTION or *SHELL SECTION;
// without one the sets of *ELSET that share out the elements, or of *ELEMENT. Edges of a node set,
// an element set of lines or a *SURFACE are a physical curve of its name. Throws InputError: line,
// what is wrong.
std::string msh_of_abaqus(const std::string& text);

}  // namespace airybench
