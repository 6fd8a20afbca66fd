# Makes a test of CTest of every suite of an executable, so that its cases share what they set up.
# SPLIT "suite parts ...": suites in so many parts, which run beside each other. LONG "suite;...":
# these are begun before others.
execute_process(COMMAND ${EXECUTABLE} --gtest_list_tests OUTPUT_VARIABLE listed
                COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "#[^\n]*" "" listed "${listed}")
string(REPLACE "\n" ";" lines "${listed}")
separate_arguments(split UNIX_COMMAND "${SPLIT}")
set(script "")
foreach(line IN LISTS lines)
  if(NOT line MATCHES "^([^ ]+)\\. *$")
    continue()
  endif()
  set(suite ${CMAKE_MATCH_1})
  list(FIND LONG ${suite} place)
  set(cost "")
  if(place GREATER -1)
    set(cost "COST 50")
  endif()
  set(parts 1)
  list(FIND split ${suite} place)
  if(place GREATER -1)
    math(EXPR place "${place} + 1")
    list(GET split ${place} parts)
  endif()
  foreach(part RANGE 1 ${parts})
    set(name ${NAME}.${suite})
    set(environment "OPENBLAS_NUM_THREADS=1")  # tests run beside each other
    if(parts GREATER 1)
      string(APPEND name ".${part}of${parts}")
      math(EXPR index "${part} - 1")
      string(APPEND environment ";GTEST_TOTAL_SHARDS=${parts};GTEST_SHARD_INDEX=${index}")
    endif()
    string(APPEND script
      "add_test([[${name}]] [[${EXECUTABLE}]] --gtest_brief=1 [[--gtest_filter=${suite}.*]])\n"
      "set_tests_properties([[${name}]] PROPERTIES ENVIRONMENT [[${environment}]] ${cost})\n")
  endforeach()
endforeach()
file(WRITE ${OUTPUT} "${script}")
