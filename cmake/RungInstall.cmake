# Where things are installed (GNUInstallDirs), and what makes the two libraries usable from other projects. A project that
# has Rung as a part of it uses the same names, and installs itself alone.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(rung_cmake_folder "${CMAKE_INSTALL_LIBDIR}/cmake/Rung")

# As pkg-config finds it: below the prefix, or an absolute folder as some distributions give it.
function(rung_below_prefix result folder)
  if(NOT IS_ABSOLUTE "${folder}")
    string(PREPEND folder "\${prefix}/")
  endif()
  set(${result} "${folder}" PARENT_SCOPE)
endfunction()

# rung_install_library(NAME HEADERS file... DESCRIPTION text REQUIRES pkg-config...): the shared library rung_NAME as
# Rung::NAME, with its headers, which lie in a folder "rung" here and there.
function(rung_install_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "DESCRIPTION;REQUIRES" "HEADERS")
  add_library(Rung::${name} ALIAS rung_${name})
  if(NOT PROJECT_IS_TOP_LEVEL)
    return()
  endif()
  set_target_properties(rung_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(rung_${name} INTERFACE "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
  install(TARGETS rung_${name} EXPORT rung-${name} LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}")
  install(EXPORT rung-${name} NAMESPACE Rung:: FILE rung-${name}-targets.cmake DESTINATION "${rung_cmake_folder}")
  install(FILES ${arg_HEADERS} DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/rung")

  set(rung_pc_name "rung-${name}")
  set(rung_pc_description "${arg_DESCRIPTION}")
  set(rung_pc_requires "${arg_REQUIRES}")
  set(rung_pc_prefix "${CMAKE_INSTALL_PREFIX}")
  if(NOT IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}" AND NOT CMAKE_INSTALL_PREFIX STREQUAL "/usr")
    # From the file's own place, for `cmake --install --prefix` and trees that are moved. In /usr the plain folder, which
    # pkg-config knows as one where compilers look anyway.
    string(REGEX REPLACE "[^/]+" ".." rung_upwards "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
    set(rung_pc_prefix "\${pcfiledir}/${rung_upwards}")
  endif()
  rung_below_prefix(rung_pc_libdir "${CMAKE_INSTALL_LIBDIR}")
  rung_below_prefix(rung_pc_includedir "${CMAKE_INSTALL_INCLUDEDIR}")
  configure_file("${PROJECT_SOURCE_DIR}/cmake/rung.pc.in" "${PROJECT_BINARY_DIR}/rung-${name}.pc" @ONLY)
  install(FILES "${PROJECT_BINARY_DIR}/rung-${name}.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
endfunction()

if(NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()
configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/RungConfig.cmake.in" "${PROJECT_BINARY_DIR}/RungConfig.cmake"
  INSTALL_DESTINATION "${rung_cmake_folder}" NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/RungConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/RungConfig.cmake" "${PROJECT_BINARY_DIR}/RungConfigVersion.cmake"
  DESTINATION "${rung_cmake_folder}")
