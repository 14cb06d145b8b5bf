# All test programs of this build, without programs that none of them needs.
add_custom_target(kerf_tests)

# kerf_is_left_out(<variable> <set>): whether tests of the set, functions or programs, are left out by KERF_TEST_SET.
function(kerf_is_left_out variable set)
  set(is_left_out TRUE)
  if(KERF_TEST_SET STREQUAL "all" OR KERF_TEST_SET STREQUAL set)
    set(is_left_out FALSE)
  endif()
  set(${variable} ${is_left_out} PARENT_SCOPE)
endfunction()

# kerf_add_test(<name> LABEL <label> TIMEOUT <seconds> SOURCES <file>... [OF_FUNCTIONS] [SUPPORT <target>]
#               [LIBRARIES <target>...] [EACH <suite>...] [UNSANITIZED <filter>...] [DATA <filter>...] [ALONE]
#               [PROCESSORS <n>] [COST <seconds>] [ENVIRONMENT <variable>=<value>...])
#
# OF_FUNCTIONS: what it calls is in the same process, so that sanitizers see it; else it is a test of programs. Where
# KERF_TEST_SET leaves it out it is built only if it is asked for by its name, and is no test of ctest.
# SUPPORT: what it shares with others, in place of kerf_test_support.
#
# One program. Each of its suites is a test of ctest, <name>.<suite>, in a process of its own: what a suite sets up is
# made once. EACH: suites whose tests take so long that each is a test of ctest, <name>.<suite>.<test>, so that they run
# side by side; `*` for all. UNSANITIZED: cases, as --gtest_filter names them, that sanitizers cannot run. DATA: those
# that reach hardly a line which others do not, and that KERF_TEST_SLICE leaves out. ALONE: nothing runs beside them.
# PROCESSORS: how many each keeps busy. COST: of the longest, because long ones start first. TIMEOUT: of each test of
# ctest.
function(kerf_add_test name)
  cmake_parse_arguments(ARG "ALONE;OF_FUNCTIONS" "LABEL;TIMEOUT;PROCESSORS;COST;SUPPORT"
    "SOURCES;LIBRARIES;EACH;UNSANITIZED;DATA;ENVIRONMENT" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  if(NOT ARG_SUPPORT)
    set(ARG_SUPPORT kerf_test_support)
  endif()
  target_link_libraries(${name} PRIVATE ${ARG_SUPPORT} ${ARG_LIBRARIES})
  target_precompile_headers(${name} REUSE_FROM kerf_test_shapes)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  if(NOT KERF_TEST_PROGRAMS)
    add_dependencies(${name} kerf kerf-worker)
  endif()
  set(of programs)
  if(ARG_OF_FUNCTIONS)
    set(of functions)
  endif()
  kerf_is_left_out(is_left_out ${of})
  if(is_left_out)
    set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL TRUE)
    return()
  endif()
  add_dependencies(kerf_tests ${name})
  kerf_test_properties(properties ${ARG_LABEL} ${ARG_TIMEOUT})
  list(JOIN properties " " properties)
  foreach(property PROCESSORS COST ENVIRONMENT)
    if(ARG_${property})
      string(APPEND properties " ${property} [=[${ARG_${property}}]=]")
    endif()
  endforeach()
  if(ARG_ALONE)
    string(APPEND properties " RUN_SERIAL TRUE")
  endif()
  set(except)
  if(KERF_SANITIZE)
    list(APPEND except ${ARG_UNSANITIZED})
  endif()
  if(KERF_TEST_SLICE)
    list(APPEND except ${ARG_DATA})
  endif()
  # The program says which suites it has once it is built, and ctest includes what was written of them then.
  set(list ${CMAKE_CURRENT_BINARY_DIR}/${name}_list.cmake)
  set(suites ${CMAKE_CURRENT_BINARY_DIR}/${name}_suites.cmake)
  file(GENERATE OUTPUT ${list} CONTENT "set(name ${name})
set(program [=[$<TARGET_FILE:${name}>]=])
set(each [=[${ARG_EACH}]=])
set(except [=[${except}]=])
set(properties [==[${properties}]==])
set(suites [=[${suites}]=])
include([=[${PROJECT_SOURCE_DIR}/tests/cmake/list_suites.cmake]=])
")
  set_property(TARGET ${name} APPEND PROPERTY LINK_DEPENDS ${list})
  add_custom_command(TARGET ${name} POST_BUILD COMMAND ${CMAKE_COMMAND} -P ${list} BYPRODUCTS ${suites} VERBATIM)
  set(include ${CMAKE_CURRENT_BINARY_DIR}/${name}_include.cmake)
  file(WRITE ${include} "if(EXISTS [=[${suites}]=])
  include([=[${suites}]=])
else()
  add_test(${name}_was_not_built ${name}_was_not_built)
endif()
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${include})
endfunction()

# kerf_test_properties(<variable> <label> <seconds>): what every test of ctest has. Sanitizers take several times as
# long.
function(kerf_test_properties variable label seconds)
  if(KERF_SANITIZE)
    math(EXPR seconds "10 * ${seconds}")
  endif()
  set(${variable} LABELS ${label} TIMEOUT ${seconds} SKIP_RETURN_CODE 77 PARENT_SCOPE)
endfunction()

# kerf_add_ranks_test(<program> <label> <number of ranks>...): the program's tests, all of them under mpirun.
function(kerf_add_ranks_test program label)
  foreach(ranks ${ARGN})
    add_test(NAME ${program}.${ranks} COMMAND ${MPIEXEC_EXECUTABLE} --oversubscribe -n ${ranks}
      $<TARGET_FILE:${program}> --gtest_brief=1)
    kerf_test_properties(properties ${label} 120)
    set_tests_properties(${program}.${ranks} PROPERTIES ${properties} PROCESSORS ${ranks}
      ENVIRONMENT "OMPI_ALLOW_RUN_AS_ROOT=1;OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1;ASAN_OPTIONS=detect_leaks=0")
  endforeach()
endfunction()
