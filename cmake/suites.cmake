# Run by ctest: the entries of the GoogleTest program `program`, one a suite with all its cases and instances. One a case
# would be mostly the time that thousands of processes take to start. The program is asked for its suites when it is newer
# than its last answer.
if(NOT EXISTS "${program}")
  add_test("${name}.NOT_BUILT" "${program}")
  return()
endif()

set(answer "${program}.suites")
if("${program}" IS_NEWER_THAN "${answer}")
  execute_process(COMMAND ${emulator} "${program}" --gtest_list_tests
    OUTPUT_VARIABLE listed RESULT_VARIABLE result)
  # A line that is not indented: SUITE. or INSTANCE/SUITE.
  string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+[.]" suites "${listed}")
  list(TRANSFORM suites REPLACE "^\n?(.*/)?([A-Za-z_][A-Za-z0-9_]*(/[0-9]+)?)[.]$" "\\2")
  list(REMOVE_DUPLICATES suites)
  if(NOT result EQUAL 0 OR NOT suites)
    message(FATAL_ERROR "${program} does not list its tests: ${result}")
  endif()
  file(WRITE "${answer}" "${suites}")
endif()

file(READ "${answer}" suites)
foreach(suite IN LISTS suites)
  add_test("${name}.${suite}" ${emulator} "${program}" "--gtest_filter=${suite}.*:*/${suite}.*")
  # The status is of tests/support/test_main.cpp.
  set_tests_properties("${name}.${suite}" PROPERTIES SKIP_RETURN_CODE 77 ${properties})
endforeach()
