# find_library_and_header(NAME library header [suffix of the header's folder]): the target NAME::NAME.
# What the find modules of this folder do, for libraries that come without a configuration for CMake
# or a file for pkg-config, at least in one of the releases that we build on.
include(FindPackageHandleStandardArgs)
macro(find_library_and_header name library header)
  find_library(${name}_LIBRARY ${library})
  find_path(${name}_INCLUDE_DIR ${header} PATH_SUFFIXES ${ARGN})
  mark_as_advanced(${name}_LIBRARY ${name}_INCLUDE_DIR)
  find_package_handle_standard_args(${name} DEFAULT_MSG ${name}_LIBRARY ${name}_INCLUDE_DIR)
  if(${name}_FOUND AND NOT TARGET ${name}::${name})
    add_library(${name}::${name} UNKNOWN IMPORTED)
    set_target_properties(${name}::${name} PROPERTIES IMPORTED_LOCATION ${${name}_LIBRARY}
                          INTERFACE_INCLUDE_DIRECTORIES ${${name}_INCLUDE_DIR})
  endif()
endmacro()
