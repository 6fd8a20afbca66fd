# FCLIB's own reader, which tests the files that we write: FCLIB::FCLIB.
include(${CMAKE_CURRENT_LIST_DIR}/find_library_and_header.cmake)
find_library_and_header(FCLIB fclib fclib.h)
