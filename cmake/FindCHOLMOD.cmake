# CHOLMOD, of SuiteSparse: CHOLMOD::CHOLMOD.
include(${CMAKE_CURRENT_LIST_DIR}/find_library_and_header.cmake)
find_library_and_header(CHOLMOD cholmod cholmod.h suitesparse)
