# MUMPS in double precision, sequential, with a stub of MPI inside: MUMPS::MUMPS.
include(${CMAKE_CURRENT_LIST_DIR}/find_library_and_header.cmake)
find_library_and_header(MUMPS dmumps_seq dmumps_c.h)
