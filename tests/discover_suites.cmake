# Run after a test program was linked: writes a list for ctest with a test for each of its suites. (A
# process for each case, as gtest_discover_tests makes, would spend more time loading the two hundred
# libraries behind OpenImageIO than testing.)
#   cmake -D PROGRAM=[emulator;]… -D LIST=… [-D SLOW=suites] -P discover_suites.cmake
cmake_minimum_required(VERSION 3.21)
list(REMOVE_ITEM PROGRAM "")
list(TRANSFORM PROGRAM REPLACE "(.+)" "[=[\\1]=]" OUTPUT_VARIABLE command)
string(REPLACE ";" " " command "${command}")
execute_process(COMMAND ${PROGRAM} --gtest_list_tests
  OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY TIMEOUT 60)
# A suite stands at the beginning of its line and ends in a point; its cases are indented.
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
