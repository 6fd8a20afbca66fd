# Gmsh as a library: Gmsh::Gmsh.
include(${CMAKE_CURRENT_LIST_DIR}/find_library_and_header.cmake)
find_library_and_header(Gmsh gmsh gmsh.h)
