# Runs after a test program is linked: writes a list for ctest with one test for each suite. (With one process for
# each case, as gtest_discover_tests makes, loading the two hundred libraries of OpenImageIO would take longer than the
# tests.)
#   cmake -D PROGRAM=[emulator;]… -D LIST=… [-D SLOW=suites] -P discover_suites.cmake
cmake_minimum_required(VERSION 3.21)
list(REMOVE_ITEM PROGRAM "")
list(TRANSFORM PROGRAM REPLACE "(.+)" "[=[\\1]=]" OUTPUT_VARIABLE command)
string(REPLACE ";" " " command "${command}")
execute_process(COMMAND ${PROGRAM} --gtest_list_tests
  OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY TIMEOUT 60)
# A line with a suite is not indented and ends with a point; lines with cases are indented.
string(REGEX MATCHALL "\n[A-Za-z0-9_/]+\\.[^\n]*" suites "\n${listed}")
set(tests "")
foreach(suite IN LISTS suites)
  string(REGEX REPLACE "\n([^.]*).*" "\\1" suite "${suite}")
  set(label "")
  if(suite IN_LIST SLOW)
    set(label " LABELS slow")
  endif()
  string(APPEND tests
    "add_test([=[${suite}]=] ${command} [=[--gtest_filter=${suite}.*]=])\n"
    "set_tests_properties([=[${suite}]=] PROPERTIES TIMEOUT 600${label})\n")
endforeach()
file(WRITE ${LIST} "${tests}")
