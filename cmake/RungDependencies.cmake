# Third-party packages, all from Debian, and the interface targets over them.
# Of the runtime.
find_package(Threads REQUIRED)
find_package(ZLIB REQUIRED)
find_path(RUNG_SODIUM_INCLUDE sodium.h REQUIRED)
find_library(RUNG_SODIUM_LIBRARY sodium REQUIRED)

# Digests and signatures; its package has no CMake config file.
add_library(rung_sodium INTERFACE)
target_include_directories(rung_sodium SYSTEM INTERFACE "${RUNG_SODIUM_INCLUDE}")
target_link_libraries(rung_sodium INTERFACE "${RUNG_SODIUM_LIBRARY}")

if(RUNG_TESTS)
  find_package(GTest REQUIRED CONFIG)
endif()
if(NOT RUNG_COMPILER)
  return()
endif()

# Of the compiler and its tools.
find_package(fmt 9 REQUIRED CONFIG)
find_package(CLI11 REQUIRED CONFIG)
find_package(nlohmann_json REQUIRED CONFIG)
find_package(EXPAT 2.5 REQUIRED)
find_package(pugixml 1.13 REQUIRED CONFIG)
find_package(tomlplusplus 3.3 REQUIRED CONFIG)
find_path(RUNG_EDIT_INCLUDE histedit.h REQUIRED)
find_library(RUNG_EDIT_LIBRARY edit REQUIRED)
find_path(RUNG_NCURSES_INCLUDE ncurses.h REQUIRED)
find_library(RUNG_NCURSES_LIBRARY ncursesw REQUIRED)
find_library(RUNG_TINFO_LIBRARY tinfo REQUIRED)
find_path(RUNG_UTF8PROC_INCLUDE utf8proc.h REQUIRED)
find_library(RUNG_UTF8PROC_LIBRARY utf8proc REQUIRED)
find_path(RUNG_SECCOMP_INCLUDE seccomp.h REQUIRED)
find_library(RUNG_SECCOMP_LIBRARY seccomp REQUIRED)
find_path(RUNG_MODBUS_INCLUDE modbus.h PATH_SUFFIXES modbus REQUIRED)
find_library(RUNG_MODBUS_LIBRARY modbus REQUIRED)
find_path(RUNG_CIVETWEB_INCLUDE civetweb.h REQUIRED)
find_library(RUNG_CIVETWEB_LIBRARY civetweb REQUIRED)
find_path(RUNG_SYSTEMD_INCLUDE systemd/sd-daemon.h REQUIRED)
find_library(RUNG_SYSTEMD_LIBRARY systemd REQUIRED)
list(APPEND CMAKE_PREFIX_PATH /usr/lib/llvm-19) # LLD's config file is found only with it
find_package(LLVM 19.1 REQUIRED CONFIG) # plain "19" is rejected by LLVM's version file
find_package(LLD 19.1 REQUIRED CONFIG)

# The line editor of the prompt; its package has no CMake config file.
add_library(rung_edit INTERFACE)
target_include_directories(rung_edit SYSTEM INTERFACE "${RUNG_EDIT_INCLUDE}")
target_link_libraries(rung_edit INTERFACE "${RUNG_EDIT_LIBRARY}")

# The whole screen of a terminal; its package has no CMake config file.
add_library(rung_ncurses INTERFACE)
target_include_directories(rung_ncurses SYSTEM INTERFACE "${RUNG_NCURSES_INCLUDE}")
target_link_libraries(rung_ncurses INTERFACE "${RUNG_NCURSES_LIBRARY}" "${RUNG_TINFO_LIBRARY}")

# Modbus TCP; its package has no CMake config file.
add_library(rung_modbus INTERFACE)
target_include_directories(rung_modbus SYSTEM INTERFACE "${RUNG_MODBUS_INCLUDE}")
target_link_libraries(rung_modbus INTERFACE "${RUNG_MODBUS_LIBRARY}")

# The web server of the live page; its package has no CMake config file.
add_library(rung_civetweb INTERFACE)
target_include_directories(rung_civetweb SYSTEM INTERFACE "${RUNG_CIVETWEB_INCLUDE}")
target_link_libraries(rung_civetweb INTERFACE "${RUNG_CIVETWEB_LIBRARY}")

# The service manager; its package has no CMake config file.
add_library(rung_systemd INTERFACE)
target_include_directories(rung_systemd SYSTEM INTERFACE "${RUNG_SYSTEMD_INCLUDE}")
target_link_libraries(rung_systemd INTERFACE "${RUNG_SYSTEMD_LIBRARY}")

# Decoding and widths of characters; its package has no CMake config file.
add_library(rung_utf8proc INTERFACE)
target_include_directories(rung_utf8proc SYSTEM INTERFACE "${RUNG_UTF8PROC_INCLUDE}")
target_link_libraries(rung_utf8proc INTERFACE "${RUNG_UTF8PROC_LIBRARY}")

# Filters of system calls; its package has no CMake config file.
add_library(rung_seccomp INTERFACE)
target_include_directories(rung_seccomp SYSTEM INTERFACE "${RUNG_SECCOMP_INCLUDE}")
target_link_libraries(rung_seccomp INTERFACE "${RUNG_SECCOMP_LIBRARY}")

# The shared libLLVM; the only way our code links LLVM.
add_library(rung_llvm INTERFACE)
target_include_directories(rung_llvm SYSTEM INTERFACE ${LLVM_INCLUDE_DIRS})
separate_arguments(rung_llvm_definitions UNIX_COMMAND "${LLVM_DEFINITIONS}")
target_compile_definitions(rung_llvm INTERFACE ${rung_llvm_definitions})
target_link_libraries(rung_llvm INTERFACE LLVM)

# The in-process ELF linker: static lld on the shared LLVM.
add_library(rung_lld INTERFACE)
target_link_libraries(rung_lld INTERFACE lldELF lldCommon rung_llvm)

# Clang's shared library, for the program that reads headers for rungc bind.
if(RUNG_CLANG)
  find_path(RUNG_CLANG_INCLUDE clang/Tooling/Tooling.h HINTS ${LLVM_INCLUDE_DIRS})
  find_library(RUNG_CLANG_LIBRARY NAMES clang-cpp libclang-cpp.so.${LLVM_VERSION_MAJOR}.${LLVM_VERSION_MINOR}
    HINTS "${LLVM_LIBRARY_DIR}" NO_DEFAULT_PATH)
  if(NOT RUNG_CLANG_INCLUDE OR NOT RUNG_CLANG_LIBRARY)
    message(FATAL_ERROR "rungc bind reads headers by libTooling of clang ${LLVM_VERSION_MAJOR}, which is not there: "
      "install libclang-${LLVM_VERSION_MAJOR}-dev and libclang-cpp${LLVM_VERSION_MAJOR}, or leave the command out by -DRUNG_CLANG=OFF")
  endif()
  add_library(rung_clang INTERFACE)
  target_include_directories(rung_clang SYSTEM INTERFACE "${RUNG_CLANG_INCLUDE}")
  # Its own headers (stddef.h) are found by their folder, whatever program has it loaded.
  target_compile_definitions(rung_clang INTERFACE
    RUNG_CLANG_HEADERS="${LLVM_LIBRARY_DIR}/clang/${LLVM_VERSION_MAJOR}")
  target_link_libraries(rung_clang INTERFACE "${RUNG_CLANG_LIBRARY}" rung_llvm)
endif()
