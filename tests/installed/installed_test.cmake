# Installs the project, builds a program outside of it with the installed copy, runs that and the
# installed command.
#   cmake -D BUILD=... -D SOURCE=... -D PLACE=... -P installed_test.cmake
file(REMOVE_RECURSE ${PLACE})
set(prefix ${PLACE}/prefix)
function(step)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE said ERROR_VARIABLE said RESULT_VARIABLE code
                  WORKING_DIRECTORY ${PLACE})
  if(code)
    message(FATAL_ERROR "${ARGN}\n${code}: ${said}")
  endif()
  set(said "${said}" PARENT_SCOPE)
endfunction()
file(MAKE_DIRECTORY ${PLACE})
step(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
step(${CMAKE_COMMAND} -S ${SOURCE} -B outside -D CMAKE_PREFIX_PATH=${prefix})
step(${CMAKE_COMMAND} --build outside)
step(outside/outside ${prefix}/share/airybench/meshes/Mesh0.msh 3STEPD)
if(NOT said MATCHES "^3STEPD: resultant -[0-9.]+ N, error of the stresses [0-9.]+e-1[0-9]")
  message(FATAL_ERROR "outside: ${said}")
endif()
set(ENV{AIRYBENCH_CACHE_DIR} ${PLACE}/cache)
set(meshes Mesh0)
if(EXISTS ${prefix}/bin/airybench-meshgen)
  set(meshes Mesh0,${prefix}/share/airybench/bodies/punch.geo)
endif()
step(${prefix}/bin/airybench --mesh=${meshes} --method=HYBRID --repetitions=1 --out=results)
if(NOT said MATCHES "Mesh0/default/HYBRID[^\n]* ok")
  message(FATAL_ERROR "airybench: ${said}")
endif()
# Everything that the completion offers is an option.
execute_process(COMMAND bash -c "PATH=${prefix}/bin:$PATH
  . ${prefix}/share/bash-completion/completions/airybench
  COMP_WORDS=(airybench --mes) COMP_CWORD=1; _airybench; echo \${COMPREPLY[*]}"
  OUTPUT_VARIABLE said COMMAND_ERROR_IS_FATAL ANY)
if(NOT said STREQUAL "--mesh --mesh-size\n")
  message(FATAL_ERROR "completion: ${said}")
endif()
file(READ ${prefix}/share/man/man1/airybench.1 page)
if(NOT page MATCHES "\\.SH NAME\nairybench " OR NOT page MATCHES "mesh")
  message(FATAL_ERROR "manual page: ${page}")
endif()
