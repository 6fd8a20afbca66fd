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
  set(name ${name_of_${program}})
  install(PROGRAMS $<TARGET_FILE:${program}> DESTINATION ${CMAKE_INSTALL_BINDIR} RENAME ${name})
  add_custom_command(OUTPUT ${man}/${name}.1 VERBATIM
    COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${program}> -D NAME=${name}
            -D VERSION=${PROJECT_VERSION} -D OUTPUT=${man}/${name}.1
            -P ${PROJECT_SOURCE_DIR}/cmake/man_page.cmake
    DEPENDS ${program} ${PROJECT_SOURCE_DIR}/cmake/man_page.cmake)
  list(APPEND man_pages ${man}/${name}.1)
  install(FILES ${man}/${name}.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endforeach()
add_custom_target(man_pages ALL DEPENDS ${man_pages})
install(FILES cmake/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        RENAME airybench)
install(FILES cmake/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        RENAME airybench-meshgen)
install(DIRECTORY meshgen/meshes results docs/bodies DESTINATION ${data}
        PATTERN "figures" EXCLUDE)
list(TRANSFORM studies_with_scenes PREPEND bench/scenes/)
install(DIRECTORY ${studies_with_scenes} DESTINATION ${data}/scenes)
install(FILES README.md CHANGELOG.md CITATION.cff LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

# The library: meshes, assembly, methods, and the verifier.
set(rooms support mesh assembly solvers bench/judging)
foreach(room IN LISTS rooms)
  install(DIRECTORY ${room}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/airybench/${room}
          FILES_MATCHING PATTERN "*.hpp")
endforeach()
# Headers include one another from the project's root.
target_include_directories(airybench_flags INTERFACE
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/airybench>)
add_library(airybench_library INTERFACE)
set_target_properties(airybench_library PROPERTIES EXPORT_NAME airybench)
target_link_libraries(airybench_library INTERFACE airybench_judging)
install(TARGETS airybench_library airybench_judging airybench_solvers airybench_elements
                airybench_assembly airybench_mesh airybench_support airybench_flags
        EXPORT airybench_targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/airybench)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/airybench)
install(EXPORT airybench_targets NAMESPACE airybench:: FILE airybenchTargets.cmake
        DESTINATION ${package})
include(CMakePackageConfigHelpers)
configure_package_config_file(cmake/airybenchConfig.cmake.in
  ${PROJECT_BINARY_DIR}/airybenchConfig.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/airybenchConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/airybenchConfig.cmake
              ${PROJECT_BINARY_DIR}/airybenchConfigVersion.cmake DESTINATION ${package})

set(CPACK_GENERATOR DEB)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "airybench")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS
    "libeigen3-dev, libsuitesparse-dev, libmumps-seq-dev, libblas-dev, liblapack-dev, libboost-dev, libfmt-dev, libssl-dev")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
include(CPack)
