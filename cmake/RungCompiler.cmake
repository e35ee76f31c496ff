# Warnings, the linker, and a compiler cache that a fresh clone elsewhere hits too.
add_library(rung_warnings INTERFACE)
target_compile_options(rung_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wundef -Wcast-qual -Wimplicit-fallthrough
  $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor;-Woverloaded-virtual>
  # A new enumerator shows where it has to be thought of.
  -Werror=switch
  # Table rows name only the fields that differ from the default.
  -Wno-missing-field-initializers
  $<$<COMPILE_LANG_AND_ID:CXX,Clang>:-Wno-missing-designated-field-initializers>
  # clang blames us for what libstdc++ 12 uses inside std::stable_sort.
  $<$<COMPILE_LANG_AND_ID:CXX,Clang>:-Wno-deprecated-declarations>
  # g++ 12 warns wrongly about std::string (GCC bug 105651).
  $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-restrict>
  $<$<BOOL:${RUNG_WERROR}>:-Werror>)

# lld-19 for both compilers; g++ finds it only through -B. The runtime alone has the compiler's own linker.
if(RUNG_COMPILER)
  add_link_options(-fuse-ld=lld "-B${LLVM_TOOLS_BINARY_DIR}")
endif()

# Same bytes whatever the folder of the clone.
add_compile_options("-ffile-prefix-map=${PROJECT_SOURCE_DIR}/=")

set(rung_instrumentation "")
if(RUNG_SANITIZE)
  # The function check reads bytes before a callee's entry, which code made by the JIT does not have.
  list(APPEND rung_instrumentation "-fsanitize=${RUNG_SANITIZE}" -fno-sanitize-recover=all -fno-omit-frame-pointer
    $<$<CXX_COMPILER_ID:Clang>:-fno-sanitize=function>)
endif()
if(RUNG_COVERAGE)
  list(APPEND rung_instrumentation -fprofile-instr-generate -fcoverage-mapping)
endif()
add_compile_options(${rung_instrumentation})
add_link_options(${rung_instrumentation})
if(RUNG_SANITIZE MATCHES "undefined") # a program in C has our libraries in C++
  add_link_options("$<$<LINK_LANG_AND_ID:C,Clang>:-fsanitize-link-c++-runtime;-lstdc++>")
endif()

# Takes the instrumentation from a program that valgrind runs, or whose instructions are counted. Such a program has
# sources of its own only: the libraries stay instrumented.
function(rung_do_not_instrument target)
  set_target_properties(${target} PROPERTIES DISABLE_PRECOMPILE_HEADERS ON) # which are instrumented
  foreach(property IN ITEMS COMPILE_OPTIONS LINK_OPTIONS)
    get_target_property(options ${target} ${property})
    if(options AND rung_instrumentation)
      list(REMOVE_ITEM options ${rung_instrumentation})
      set_target_properties(${target} PROPERTIES ${property} "${options}")
    endif()
  endforeach()
endfunction()

find_program(RUNG_CCACHE ccache)
set(rung_caches_headers OFF)
if(RUNG_CCACHE AND PROJECT_IS_TOP_LEVEL)
  set(CMAKE_C_COMPILER_LAUNCHER
    env "CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}" CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros
    CCACHE_PCH_EXTSUM=1 "${RUNG_CCACHE}")
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_C_COMPILER_LAUNCHER})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
    set(rung_caches_headers ON) # see RungHeaders
    add_compile_options("$<$<COMPILE_LANGUAGE:CXX>:SHELL:-Xclang -fno-pch-timestamp>")
    # Of CMake's own way the cache does not see that it names a file.
    set(CMAKE_CXX_COMPILE_OPTIONS_USE_PCH -include-pch <PCH_FILE>)
  endif()
endif()
