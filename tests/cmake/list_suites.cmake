# Asks a test program for its suites and writes them as tests of ctest; see kerf_add_test(), which sets the variables:
# name, program, each, except (filters), properties (as set_tests_properties() takes
# them), suites (the file that is written).
cmake_minimum_required(VERSION 3.25)
list(JOIN except ":" except)
execute_process(COMMAND ${program} --gtest_list_tests "--gtest_filter=-${except}" OUTPUT_VARIABLE listed
  RESULT_VARIABLE result TIMEOUT 60)
if(NOT result STREQUAL 0)
  message(FATAL_ERROR "${program} --gtest_list_tests ends with ${result}")
endif()

set(text "")
# add(<name> <filter>): of the tests of a suite, or one of them.
function(add_filtered test filter)
  string(APPEND text
    "add_test([=[${name}.${test}]=] [=[${program}]=] --gtest_brief=1 [=[--gtest_filter=${filter}-${except}]=])\n"
    "set_tests_properties([=[${name}.${test}]=] PROPERTIES ${properties})\n")
  set(text "${text}" PARENT_SCOPE)
endfunction()

string(REGEX REPLACE "  # [^\n]*" "" listed "${listed}")  # types and values of parameters
string(REGEX MATCHALL "[^\n]+" listed "${listed}")
foreach(line IN LISTS listed)
  if(line MATCHES "^([^ ]+)[.]$")
    set(suite ${CMAKE_MATCH_1})
    string(REGEX REPLACE "^.*/" "" plain ${suite})  # what instances are called comes before
    set(is_split FALSE)
    if(each STREQUAL "*" OR plain IN_LIST each)
      set(is_split TRUE)
    else()
      add_filtered(${suite} "${suite}.*")
    endif()
  elseif(is_split AND line MATCHES "^  ([^ ]+)$")
    add_filtered(${suite}.${CMAKE_MATCH_1} ${suite}.${CMAKE_MATCH_1})
  endif()
endforeach()
if(text STREQUAL "")
  message(FATAL_ERROR "${program} has no tests")
endif()
file(WRITE ${suites} "${text}")
