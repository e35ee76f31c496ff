# Warnings, the linker, and a compiler cache that a fresh clone elsewhere hits too.
add_library(rung_warnings INTERFACE)
target_compile_options(rung_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wundef -Wcast-qual -Wimplicit-fallthrough
  $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor;-Woverloaded-virtual>
  # Table rows name only the fields that differ from the default.
  -Wno-missing-field-initializers
  $<$<COMPILE_LANG_AND_ID:CXX,Clang>:-Wno-missing-designated-field-initializers>
  # clang blames us for what libstdc++ 12 uses inside std::stable_sort.
  $<$<COMPILE_LANG_AND_ID:CXX,Clang>:-Wno-deprecated-declarations>
  # g++ 12 warns wrongly about std::string (GCC bug 105651).
  $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-restrict>
  $<$<BOOL:${RUNG_WERROR}>:-Werror>)

# lld-19 for both compilers; g++ finds it only through -B.
add_link_options(-fuse-ld=lld "-B${LLVM_TOOLS_BINARY_DIR}")

# Same bytes whatever the folder of the clone.
add_compile_options("-ffile-prefix-map=${CMAKE_SOURCE_DIR}/=")

if(RUNG_SANITIZE)
  # The function check reads bytes before a callee's entry, which code made by the JIT does not have.
  add_compile_options("-fsanitize=${RUNG_SANITIZE}" -fno-sanitize-recover=all -fno-omit-frame-pointer
    $<$<CXX_COMPILER_ID:Clang>:-fno-sanitize=function>)
  add_link_options("-fsanitize=${RUNG_SANITIZE}")
endif()

find_program(RUNG_CCACHE ccache)
if(RUNG_CCACHE)
  set(CMAKE_C_COMPILER_LAUNCHER
    env "CCACHE_BASEDIR=${CMAKE_SOURCE_DIR}" CCACHE_NOHASHDIR=1 "${RUNG_CCACHE}")
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_C_COMPILER_LAUNCHER})
endif()
