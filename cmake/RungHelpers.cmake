# The few functions by which every folder declares its targets.
include(GoogleTest)

# Seconds until a test counts as one that never ends, also on a busy machine and with a sanitizer; what a test waits for has
# limits of its own.
set(rung_patience 1800)

# Adds the given folders, each of which has a CMakeLists.txt; one that is not there is an error.
macro(rung_add_subdirectories)
  foreach(rung_folder IN ITEMS ${ARGN})
    add_subdirectory(${rung_folder})
  endforeach()
endmacro()

# Includes are written from the root of the repository; the C ABI headers as "rung/NAME.h".
function(rung_target_defaults target scope)
  target_include_directories(${target} ${scope} "${PROJECT_SOURCE_DIR}" "${PROJECT_SOURCE_DIR}/rtlib/abi")
  if(NOT scope STREQUAL "INTERFACE")
    rung_use_headers(${target})
  endif()
endfunction()

# rung_add_library(NAME SOURCES file... LIBS target...): a static library, or an interface library without SOURCES.
function(rung_add_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LIBS")
  if(arg_SOURCES)
    add_library(${name} STATIC ${arg_SOURCES})
    rung_target_defaults(${name} PUBLIC)
    target_link_libraries(${name} PUBLIC ${arg_LIBS} PRIVATE rung_warnings)
  else()
    add_library(${name} INTERFACE)
    rung_target_defaults(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE ${arg_LIBS})
  endif()
endfunction()

# A shared library has no symbols for others but those of a version script, and lacks none. (The runtime of a sanitizer is
# the program's.)
function(rung_export_only target script)
  target_link_options(${target} PRIVATE "LINKER:--version-script,${script}")
  set_target_properties(${target} PROPERTIES LINK_DEPENDS "${script}")
  if(NOT RUNG_SANITIZE)
    target_link_options(${target} PRIVATE LINKER:-z,defs)
  endif()
endfunction()

# rung_add_program(NAME SOURCES file... LIBS target...): a command in build/bin.
function(rung_add_program name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LIBS")
  add_executable(${name} ${arg_SOURCES})
  rung_target_defaults(${name} PRIVATE)
  target_link_libraries(${name} PRIVATE ${arg_LIBS} rung_warnings)
endfunction()

# rung_add_test(NAME SOURCES file... LIBS target... [LABEL label] [WHOLE]): GoogleTest program
# build/bin/tests/rung_test_NAME. Each case is a ctest entry, or with WHOLE the program is one entry (for thousands of
# short cases). Its main() goes to the root of the repository, so that files are found by their path in it.
function(rung_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "WHOLE" "LABEL" "SOURCES;LIBS")
  set(target rung_test_${name})
  set(rung_headers tests)
  rung_add_program(${target} SOURCES ${arg_SOURCES} LIBS ${arg_LIBS} GTest::gmock rung_test_main)
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin/tests")
  set(properties TIMEOUT ${rung_patience})
  if(arg_LABEL)
    list(APPEND properties LABELS ${arg_LABEL})
    set_property(GLOBAL APPEND PROPERTY RUNG_TESTS_OF_${arg_LABEL} ${target})
  endif()
  if(arg_WHOLE)
    add_test(NAME ${name} COMMAND ${target})
    set_tests_properties(${name} PROPERTIES ${properties})
  else()
    gtest_discover_tests(${target} TEST_PREFIX "${name}." DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT ${rung_patience}
      PROPERTIES ${properties})
  endif()
endfunction()

# rung_add_fuzzer(NAME SOURCES file... LIBS target...): libFuzzer program build/bin/fuzz/rung_fuzz_NAME.
function(rung_add_fuzzer name)
  if(NOT RUNG_FUZZ)
    return()
  endif()
  set(target rung_fuzz_${name})
  rung_add_program(${target} ${ARGN})
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin/fuzz")
  target_link_options(${target} PRIVATE -fsanitize=fuzzer)
endfunction()
