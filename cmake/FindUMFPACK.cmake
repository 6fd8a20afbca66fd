# UMFPACK, of SuiteSparse: UMFPACK::UMFPACK.
include(${CMAKE_CURRENT_LIST_DIR}/find_library_and_header.cmake)
find_library_and_header(UMFPACK umfpack umfpack.h suitesparse)
