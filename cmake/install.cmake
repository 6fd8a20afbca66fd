# What `cmake --install` and `cpack` give: the programs airybench and airybench-meshgen with their
# manual pages and completion, meshes and scenes, and the library with its headers for
# find_package(airybench).
include(GNUInstallDirs)
set(data ${CMAKE_INSTALL_DATADIR}/airybench)

# `bench` is no name for a command among others.
set(man ${PROJECT_BINARY_DIR}/man)
foreach(program IN ITEMS bench meshgen)
  if(NOT TARGET ${program})
    continue()
  endif()
  set(name_of_bench airybench)
  set(name_of_meshgen airybench-meshgen)
  set(help_of_bench --help-all)
  set(help_of_meshgen --help)
  set(name ${name_of_${program}})
  if(BUILD_SHARED_LIBS)
    set_target_properties(${program} PROPERTIES
                          INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
  endif()
  install(TARGETS ${program})
  set(installed "\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_BINDIR}")
  install(CODE "file(RENAME \"${installed}/${program}\" \"${installed}/${name}\")")
  add_custom_command(OUTPUT ${man}/${name}.1.gz VERBATIM
    COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${program}> -D NAME=${name}
            -D HELP=${help_of_${program}} -D VERSION=${PROJECT_VERSION} -D OUTPUT=${man}/${name}.1.gz
            -P ${PROJECT_SOURCE_DIR}/cmake/man_page.cmake
    DEPENDS ${program} ${PROJECT_SOURCE_DIR}/cmake/man_page.cmake)
  list(APPEND man_pages ${man}/${name}.1.gz)
  install(FILES ${man}/${name}.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endforeach()
add_custom_target(man_pages ALL DEPENDS ${man_pages})
install(FILES cmake/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        RENAME airybench)
install(FILES cmake/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        RENAME airybench-meshgen)
install(DIRECTORY meshgen/meshes bench/scenes bench/external/templates validation results docs/bodies DESTINATION ${data}
        PATTERN "figures" EXCLUDE PATTERN "__pycache__" EXCLUDE)
install(DIRECTORY plots DESTINATION ${data}  # meshgen --show, claims.py
        FILES_MATCHING PATTERN "*.py" PATTERN "*.json"
        PATTERN "__pycache__" EXCLUDE PATTERN "page" EXCLUDE PATTERN "figure" EXCLUDE)
install(FILES README.md CHANGELOG.md CITATION.cff LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

# The library: meshes, assembly, methods, and the verifier.
foreach(room IN ITEMS support mesh assembly solvers verify)
  install(DIRECTORY ${room}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/airybench/${room}
          FILES_MATCHING PATTERN "*.hpp")
endforeach()
add_library(airybench_library INTERFACE)
set_target_properties(airybench_library PROPERTIES EXPORT_NAME airybench)
target_link_libraries(airybench_library INTERFACE airybench_verify)
install(TARGETS airybench_library airybench_verify airybench_solvers airybench_elements
                airybench_assembly airybench_mesh airybench_support
        EXPORT airybench_targets)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/airybench)
install(EXPORT airybench_targets NAMESPACE airybench:: FILE airybenchTargets.cmake
        DESTINATION ${package})
include(CMakePackageConfigHelpers)
configure_package_config_file(cmake/airybenchConfig.cmake.in
  ${PROJECT_BINARY_DIR}/airybenchConfig.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/airybenchConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/airybenchConfig.cmake
              ${PROJECT_BINARY_DIR}/airybenchConfigVersion.cmake
              cmake/FindCHOLMOD.cmake cmake/FindMUMPS.cmake cmake/FindUMFPACK.cmake
              cmake/find_library_and_header.cmake
        DESTINATION ${package})

# The Debian package. Its maintainer is who builds it, by the variables of Debian's own tools.
set(maintainer "The airybench developers <airybench@users.noreply.github.com>")
if(DEFINED ENV{DEBEMAIL})
  set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
set(changelog ${PROJECT_BINARY_DIR}/changelog.gz)
add_custom_command(OUTPUT ${changelog} VERBATIM
  COMMAND ${CMAKE_COMMAND} -D VERSION=${PROJECT_VERSION} -D CITATION=${PROJECT_SOURCE_DIR}/CITATION.cff
          -D MAINTAINER=${maintainer} -D OUTPUT=${changelog}
          -P ${PROJECT_SOURCE_DIR}/cmake/debian_changelog.cmake
  DEPENDS CITATION.cff cmake/debian_changelog.cmake)
add_custom_target(debian_changelog ALL DEPENDS ${changelog})
install(FILES ${changelog} cmake/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(CPACK_GENERATOR DEB)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER ${maintainer})
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "Contact with dry friction, solved in stresses: an Airy function on
Hsieh-Clough-Tocher triangles, four families of solvers and a dozen
preconditioners, compared with hybridized and displacement methods on the same
problems. No time is shown without the error that belongs to it.")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS
    "libeigen3-dev, libsuitesparse-dev, libmumps-seq-dev, libblas-dev, liblapack-dev, libboost-dev, libfmt-dev, libssl-dev, python3-matplotlib, python3-pandas, python3-scipy")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
include(CPack)
