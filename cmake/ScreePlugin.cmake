# scree_add_plugin(NAME SOURCES ... [LIBRARIES ...] [TEST_SOURCES ...] [TEST_LIBRARIES ...])
#
# Builds the shared library of a plugin, in the tree and outside of it alike, and puts it where the host looks.
# TEST_SOURCES become the unit test NAME_test, which is linked with the plugin's own sources.
function(scree_add_plugin name)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES;TEST_SOURCES;TEST_LIBRARIES" ${ARGN})
  add_library(${name} MODULE ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE scree::core ${arg_LIBRARIES})
  target_compile_features(${name} PRIVATE cxx_std_20)
  set_target_properties(${name} PROPERTIES PREFIX "" CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  if(TARGET scree_flags)
    target_link_libraries(${name} PRIVATE scree_flags)
    set_target_properties(${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${SCREE_PLUGIN_OUTPUT_DIRECTORY}
      INSTALL_RPATH "$ORIGIN/../..")
    add_dependencies(scree_runtime ${name})
    install(TARGETS ${name} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/scree/plugins)
    if(arg_TEST_SOURCES)
      scree_add_test(${name}_test SOURCES ${arg_SOURCES} ${arg_TEST_SOURCES}
        LIBRARIES ${arg_LIBRARIES} ${arg_TEST_LIBRARIES})
      target_include_directories(${name}_test PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
    endif()
  endif()
endfunction()
