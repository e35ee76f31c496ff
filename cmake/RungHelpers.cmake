# The few functions by which every folder declares its targets.

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

# rung_add_test(NAME [FOLDERS folder...] [SOURCES file...] LIBS target... [LABEL label] [TIMEOUT seconds] [LONG]):
# GoogleTest program build/bin/tests/rung_test_NAME of every *_test.cpp in the folders, and of the sources. Each of its
# suites is an entry NAME.SUITE of ctest (suites.cmake). Tests run in the root of the repository, so that files are found by
# their path in it. LONG: it runs long, so it is optimised and started before others.
function(rung_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "LONG" "LABEL;TIMEOUT" "FOLDERS;SOURCES;LIBS")
  foreach(folder IN LISTS arg_FOLDERS)
    file(GLOB tests CONFIGURE_DEPENDS ${folder}/*_test.cpp)
    if(NOT tests)
      message(FATAL_ERROR "${folder} has no *_test.cpp")
    endif()
    list(APPEND arg_SOURCES ${tests})
  endforeach()
  set(target rung_test_${name})
  set(rung_headers tests)
  if(NOT arg_LONG)
    set(rung_headers tests_not_optimised)
  endif()
  rung_add_program(${target} SOURCES ${arg_SOURCES} LIBS ${arg_LIBS} rung_test_main GTest::gmock)
  set(folder "${PROJECT_BINARY_DIR}/bin/tests")
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${folder}")
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 600)
  endif()
  set(properties TIMEOUT ${arg_TIMEOUT})
  if(arg_LONG)
    list(APPEND properties COST 60) # seconds, as ctest measures those of others
  else()
    target_compile_options(${target} PRIVATE ${rung_not_optimised})
  endif()
  if(arg_LABEL)
    list(APPEND properties LABELS ${arg_LABEL})
    set_property(GLOBAL APPEND PROPERTY RUNG_TESTS_OF_${arg_LABEL} ${target})
  endif()
  file(CONFIGURE OUTPUT "${target}.cmake" @ONLY CONTENT [[
set(name "@name@")
set(program "@folder@/@target@")
set(emulator "@CMAKE_CROSSCOMPILING_EMULATOR@")
set(root "@PROJECT_SOURCE_DIR@")
set(properties "@properties@")
include("@PROJECT_SOURCE_DIR@/cmake/suites.cmake")
]])
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${CMAKE_CURRENT_BINARY_DIR}/${target}.cmake")
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
