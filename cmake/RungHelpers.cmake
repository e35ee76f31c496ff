# The few functions by which every folder declares its targets.

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

# Adds the files of the folders that the pattern fits to the caller's arg_SOURCES; a folder without one is an error.
macro(rung_add_sources pattern)
  foreach(folder IN ITEMS ${ARGN})
    file(GLOB found CONFIGURE_DEPENDS "${folder}/${pattern}")
    if(NOT found)
      message(FATAL_ERROR "${folder} has no ${pattern}")
    endif()
    list(APPEND arg_SOURCES ${found})
  endforeach()
endmacro()

# rung_add_library(NAME [FOLDERS folder...] [SOURCES file...] LIBS target...): a static library of every *.cpp in the folders,
# and of the sources; an interface library without any.
function(rung_add_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "FOLDERS;SOURCES;LIBS")
  rung_add_sources("*.cpp" ${arg_FOLDERS})
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

# What tests need, for `./dev test`, which builds no more than that, and for `./dev test --changed`. Each test says it beside
# its add_test(); one that does not is an error of configuring. The list is build/tests.tsv, which tools/dev/tests.py reads.
#
# rung_test_needs(TESTS name... [TARGETS target...] [IF_BUILT target...] [READS path...]): what is to be built before (IF_BUILT:
# where this build has it), and which files and folders of the repository the tests read. Not to be listed: the folder of the
# CMakeLists.txt, and what a script or the sources of a program name in full ("examples/gsk-mill"). `READS .` is any file.
function(rung_test_needs)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "" "TESTS;TARGETS;IF_BUILT;READS")
  if(arg_UNPARSED_ARGUMENTS OR NOT arg_TESTS)
    message(FATAL_ERROR "rung_test_needs(TESTS name... [TARGETS target...] [IF_BUILT target...] [READS path...])")
  endif()
  cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY "${PROJECT_SOURCE_DIR}" OUTPUT_VARIABLE folder)
  foreach(path IN LISTS arg_READS)
    if(NOT EXISTS "${PROJECT_SOURCE_DIR}/${path}")
      message(FATAL_ERROR "${arg_TESTS}: there is no ${path} to read")
    endif()
  endforeach()
  set(targets ${arg_TARGETS})
  foreach(target IN LISTS arg_IF_BUILT)
    list(APPEND targets "$<$<TARGET_EXISTS:${target}>:${target}>")
  endforeach()
  list(JOIN targets " " targets)
  list(JOIN arg_READS " " reads)
  foreach(test IN LISTS arg_TESTS)
    if(NOT TEST ${test})
      message(FATAL_ERROR "rung_test_needs: ${test} is not a test of this folder")
    endif()
    set_property(GLOBAL APPEND PROPERTY RUNG_TESTS_STATED ${test})
    set_property(GLOBAL APPEND PROPERTY RUNG_TEST_LINES "test\t${test}\t${folder}\t${targets}\t${reads}\t")
  endforeach()
  set_property(GLOBAL APPEND PROPERTY RUNG_TEST_TARGETS ${arg_TARGETS})
endfunction()

# rung_test_family(NAME TARGET [LABEL label] [READS path...]): tests named NAME.*, which only the built program knows.
function(rung_test_family name target)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "LABEL" "READS")
  cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY "${PROJECT_SOURCE_DIR}" OUTPUT_VARIABLE folder)
  list(JOIN arg_READS " " reads)
  set_property(GLOBAL APPEND PROPERTY RUNG_TEST_TARGETS ${target})
  set_property(GLOBAL APPEND PROPERTY RUNG_TEST_LINES "family\t${name}.\t${folder}\t${target}\t${reads}\t${arg_LABEL}")
endfunction()

# Writes the list, when all folders are read.
function(rung_write_test_needs)
  get_property(stated GLOBAL PROPERTY RUNG_TESTS_STATED)
  get_property(targets GLOBAL PROPERTY RUNG_TEST_TARGETS)
  foreach(target IN LISTS targets)
    if(NOT TARGET ${target})
      message(FATAL_ERROR "rung_test_needs: there is no target ${target}")
    endif()
  endforeach()
  set(folders "${PROJECT_SOURCE_DIR}")
  set(silent "")
  while(folders)
    list(POP_FRONT folders folder)
    get_property(below DIRECTORY "${folder}" PROPERTY SUBDIRECTORIES)
    list(APPEND folders ${below})
    get_property(tests DIRECTORY "${folder}" PROPERTY TESTS)
    list(REMOVE_ITEM tests ${stated} "")
    # rung_add_test() leaves TARGET.cmake there, gtest_discover_tests() would TARGET[1]_include.cmake
    get_property(discovered DIRECTORY "${folder}" PROPERTY TEST_INCLUDE_FILES)
    list(TRANSFORM discovered REPLACE ".*/([A-Za-z0-9_-]+)[^/]*" "\\1")
    list(REMOVE_ITEM discovered ${targets} "")
    list(APPEND silent ${tests} ${discovered})
  endwhile()
  if(silent)
    message(FATAL_ERROR "No rung_test_needs() (cmake/RungHelpers.cmake) says what these tests need: ${silent}")
  endif()
  get_property(lines GLOBAL PROPERTY RUNG_TEST_LINES)
  list(JOIN lines "\n" lines)
  file(GENERATE OUTPUT "${PROJECT_BINARY_DIR}/tests.tsv"
    CONTENT "# kind\tname\tfolder\ttargets\tfiles and folders it reads\tlabel\n${lines}\n")
endfunction()

# rung_add_test(NAME [FOLDERS folder...] [SOURCES file...] LIBS target... [READS path...] [LABEL label] [LONG]): GoogleTest
# program build/bin/tests/rung_test_NAME of every *_test.cpp in the folders, and of the sources. Each of its suites is an
# entry NAME.SUITE of ctest (suites.cmake). Its main() goes to the root of the repository, so that files are found by their
# path in it. READS: as for rung_test_needs, what the sources do not name. LONG: it runs long, so it is optimised and
# started before others.
function(rung_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "LONG" "LABEL" "FOLDERS;SOURCES;LIBS;READS")
  rung_add_sources("*_test.cpp" ${arg_FOLDERS})
  set(target rung_test_${name})
  set(rung_headers tests)
  if(NOT arg_LONG)
    set(rung_headers tests_not_optimised)
  endif()
  rung_add_program(${target} SOURCES ${arg_SOURCES} LIBS ${arg_LIBS} rung_test_main GTest::gmock)
  set(folder "${PROJECT_BINARY_DIR}/bin/tests")
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${folder}")
  set(properties TIMEOUT ${rung_patience})
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
set(properties "@properties@")
include("@PROJECT_SOURCE_DIR@/cmake/suites.cmake")
]])
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${CMAKE_CURRENT_BINARY_DIR}/${target}.cmake")
  rung_test_family(${name} ${target} LABEL ${arg_LABEL} READS ${arg_READS})
endfunction()

# rung_add_version(NAME HEADER file NAMESPACE name FUNCTION name COMMENT text [FILES file...] [FOLDERS folder...]): library
# rung_NAME with the function that the header declares, which gives a hash of the files and of the sources in the folders
# of the project: another one for other sources.
function(rung_add_version name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "HEADER;NAMESPACE;FUNCTION;COMMENT" "FILES;FOLDERS")
  foreach(folder IN LISTS arg_FOLDERS)
    set(here "${PROJECT_SOURCE_DIR}/${folder}")
    file(GLOB found CONFIGURE_DEPENDS "${here}/*.cpp" "${here}/*.h" "${here}/*.hpp" "${here}/*.def")
    list(APPEND arg_FILES ${found})
  endforeach()
  list(JOIN arg_FILES "," files)
  set(version "${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp")
  set(script "${PROJECT_SOURCE_DIR}/cmake/embed_version.cmake")
  add_custom_command(OUTPUT "${version}"
    COMMAND "${CMAKE_COMMAND}" "-DOUT=${version}" "-DHEADER=${arg_HEADER}" "-DNAMESPACE=${arg_NAMESPACE}"
      "-DFUNCTION=${arg_FUNCTION}" "-DFILES=${files}" -P "${script}"
    DEPENDS ${arg_FILES} "${script}"
    COMMENT "${arg_COMMENT}" VERBATIM)
  rung_add_library(rung_${name} SOURCES "${version}")
endfunction()

# rung_embed(VARIABLE HEADER file NAMESPACE name FUNCTION name FOLDER folder FILES file...): a source, named by the variable,
# with the function that the header declares, which gives the files of the folder as texts (rtlib/text/embedded.h).
function(rung_embed variable)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "HEADER;NAMESPACE;FUNCTION;FOLDER" "FILES")
  list(JOIN arg_FILES "," files)
  list(TRANSFORM arg_FILES PREPEND "${arg_FOLDER}/")
  set(source "${CMAKE_CURRENT_BINARY_DIR}/${arg_FUNCTION}.cpp")
  set(script "${PROJECT_SOURCE_DIR}/cmake/embed.cmake")
  add_custom_command(OUTPUT "${source}"
    COMMAND "${CMAKE_COMMAND}" "-DOUT=${source}" "-DHEADER=${arg_HEADER}" "-DNAMESPACE=${arg_NAMESPACE}"
      "-DFUNCTION=${arg_FUNCTION}" "-DFOLDER=${arg_FOLDER}" "-DFILES=${files}" -P "${script}"
    DEPENDS ${arg_FILES} "${script}"
    COMMENT "Embedding ${arg_FOLDER}" VERBATIM)
  set(${variable} "${source}" PARENT_SCOPE)
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
