# Third-party packages, all from Debian, and the interface targets over them.
list(APPEND CMAKE_PREFIX_PATH /usr/lib/llvm-19) # LLD's config file is found only with it

find_package(Threads REQUIRED)
find_package(fmt 9 REQUIRED CONFIG)
find_package(GTest REQUIRED CONFIG)
find_package(benchmark REQUIRED CONFIG)
find_package(CLI11 REQUIRED CONFIG)
find_package(nlohmann_json REQUIRED CONFIG)
find_package(EXPAT 2.5 REQUIRED)
find_package(LLVM 19.1 REQUIRED CONFIG) # plain "19" is rejected by LLVM's version file
find_package(LLD 19.1 REQUIRED CONFIG)

# The shared libLLVM; the only way our code links LLVM.
add_library(rung_llvm INTERFACE)
target_include_directories(rung_llvm SYSTEM INTERFACE ${LLVM_INCLUDE_DIRS})
separate_arguments(rung_llvm_definitions UNIX_COMMAND "${LLVM_DEFINITIONS}")
target_compile_definitions(rung_llvm INTERFACE ${rung_llvm_definitions})
target_link_libraries(rung_llvm INTERFACE LLVM)

# The in-process ELF linker: static lld on the shared LLVM.
add_library(rung_lld INTERFACE)
target_link_libraries(rung_lld INTERFACE lldELF lldCommon rung_llvm)
