# Headers that most sources of a group of targets include, compiled once for each group. A source names what it uses all the
# same: the preset `gcc` builds without this (CMAKE_DISABLE_PRECOMPILE_HEADERS).
set(rung_headers_standard
  <algorithm> <array> <bit> <charconv> <cmath> <cstdint> <cstdio> <cstring> <filesystem> <functional> <iterator> <map>
  <memory> <optional> <span> <string> <string_view> <unordered_map> <utility> <vector>)

# rung_add_headers(GROUP HEADERS <header>... OURS header... LIBS target...): ours by their path in the repository
function(rung_add_headers group)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "HEADERS;OURS;LIBS")
  list(TRANSFORM arg_OURS REPLACE "(.+)" "\"\\1\"")
  set(target rung_headers_${group})
  add_library(${target} OBJECT "${PROJECT_SOURCE_DIR}/cmake/headers.cpp")
  target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}" "${PROJECT_SOURCE_DIR}/rtlib/abi")
  target_link_libraries(${target} PRIVATE ${arg_LIBS} rung_warnings)
  target_precompile_headers(${target} PRIVATE ${rung_headers_standard} ${arg_HEADERS} ${arg_OURS})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    target_compile_options(${target} PRIVATE -fpch-instantiate-templates)
  endif()
  if(rung_caches_headers)
    set(header "${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/${target}.dir/cmake_pch.hxx")
    add_custom_command(OUTPUT "${header}.pch.sum"
      COMMAND "${PROJECT_SOURCE_DIR}/cmake/header-sum" "${header}.pch.sum" "${CMAKE_CXX_COMPILER}" -std=c++20
        "-I$<JOIN:$<TARGET_PROPERTY:${target},INCLUDE_DIRECTORIES>,;-I>" -x c++ "${header}"
      DEPENDS "${header}.pch" "${PROJECT_SOURCE_DIR}/cmake/header-sum" COMMAND_EXPAND_LISTS VERBATIM
      COMMENT "Digest of the headers of ${group}")
    add_custom_target(${target}_sum DEPENDS "${header}.pch.sum")
  endif()
endfunction()

# The sources of a target get the headers of the group that the variable `rung_headers` of its folder names.
function(rung_use_headers target)
  if(NOT rung_headers)
    return()
  endif()
  target_precompile_headers(${target} REUSE_FROM rung_headers_${rung_headers})
  if(rung_caches_headers)
    add_dependencies(${target} rung_headers_${rung_headers}_sum)
  endif()
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "EXECUTABLE") # else -fPIE, with which the headers were not compiled
    target_compile_options(${target} PRIVATE -fPIC)
  endif()
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    if(source MATCHES "[.]c$")
      set_source_files_properties("${source}" PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
    endif()
  endforeach()
endfunction()
