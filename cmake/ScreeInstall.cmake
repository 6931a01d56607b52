# Installs libraries, headers, plugins and programs, and the package with which plugins outside the tree build:
# find_package(scree) gives scree::core, scree::host and scree_add_plugin().
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/scree)

# scree_host finds and loads plugins; a program that embeds scree links it.
foreach(library scree_core scree_host)
  if(TARGET ${library})
    set_target_properties(${library} PROPERTIES INSTALL_RPATH "$ORIGIN")
    install(TARGETS ${library} EXPORT scree-targets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  endif()
endforeach()

# Public headers: all of core, but what a folder named `detail` keeps to itself, and the host's.
install(DIRECTORY core/scree DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN *.hpp PATTERN detail EXCLUDE)
if(IS_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/plugins/host/scree)
  install(DIRECTORY plugins/host/scree DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
    FILES_MATCHING PATTERN *.hpp PATTERN detail EXCLUDE)
endif()

install(EXPORT scree-targets NAMESPACE scree:: DESTINATION ${package_folder})
configure_package_config_file(cmake/scree-config.cmake.in ${CMAKE_BINARY_DIR}/scree-config.cmake
  INSTALL_DESTINATION ${package_folder} PATH_VARS CMAKE_INSTALL_BINDIR)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/scree-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/scree-config.cmake ${CMAKE_BINARY_DIR}/scree-config-version.cmake
  cmake/ScreePlugin.cmake DESTINATION ${package_folder})
