# scree_add_plugin(NAME SOURCES ... [LIBRARIES ...] [TEST_SOURCES ...] [TEST_LIBRARIES ...])
#
# Builds the shared library of a plugin, in the tree and outside of it alike. In the tree it goes where the host looks, and
# TEST_SOURCES become the unit test NAME_test, which is linked with the plugin's own objects. Outside, it lies in the
# build folder (hand that to `scree run --plugin-dir`), and `cmake --install` puts it beside scree's own plugins when
# both have one prefix.
#
# The test conformance:NAME puts every entry of the library through the conformance suite of its interface: in the tree
# with SCREE_TESTS, outside of it with BUILD_TESTING when the scree that was found was built with its tests.
#
# Sources are compiled once, into NAME_objects; include folders, definitions and options added to NAME hold for them.
function(scree_add_plugin name)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES;TEST_SOURCES;TEST_LIBRARIES" ${ARGN})
  if(NOT arg_SOURCES OR arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "scree_add_plugin(${name}): give SOURCES, and only the arguments that cmake/ScreePlugin.cmake "
      "names (not: ${arg_UNPARSED_ARGUMENTS})")
  endif()
  add_library(${name}_objects OBJECT ${arg_SOURCES})
  add_library(${name} MODULE $<TARGET_OBJECTS:${name}_objects>)
  foreach(property COMPILE_DEFINITIONS COMPILE_OPTIONS INCLUDE_DIRECTORIES)
    set_property(TARGET ${name}_objects APPEND PROPERTY ${property} $<TARGET_PROPERTY:${name},${property}>)
  endforeach()
  foreach(target ${name} ${name}_objects)
    target_link_libraries(${target} PRIVATE scree::core ${arg_LIBRARIES})
    target_compile_features(${target} PRIVATE cxx_std_20)
    target_compile_options(${target} PRIVATE -ffp-contract=off)
    set_target_properties(${target} PROPERTIES PREFIX "" LINKER_LANGUAGE CXX POSITION_INDEPENDENT_CODE ON
      CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  endforeach()
  install(TARGETS ${name} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/scree/plugins)
  if(TARGET scree_flags)
    _scree_add_plugin_in_tree()
  elseif(BUILD_TESTING AND SCREE_CONFORMANCE)
    add_test(NAME conformance:${name} COMMAND ${SCREE_CONFORMANCE} $<TARGET_FILE:${name}>)
  endif()
endfunction()

# What only a plugin of this repository gets: its warnings, its place, its tests.
macro(_scree_add_plugin_in_tree)
  target_link_libraries(${name} PRIVATE scree_flags)
  target_link_libraries(${name}_objects PRIVATE scree_flags)
  set_target_properties(${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${SCREE_PLUGIN_OUTPUT_DIRECTORY}
    INSTALL_RPATH "$ORIGIN/../..")
  if(NOT SCREE_SANITIZE)
    target_link_options(${name} PRIVATE -Wl,-z,defs)  # a library that LIBRARIES forgets is an error now, not when loaded
  endif()
  add_dependencies(scree_runtime ${name})
  if(SCREE_TESTS)
    add_test(NAME conformance:${name} COMMAND scree_conformance $<TARGET_FILE:${name}>)
  endif()
  if(arg_TEST_SOURCES AND SCREE_TESTS)
    scree_add_test(${name}_test SOURCES $<TARGET_OBJECTS:${name}_objects> ${arg_TEST_SOURCES}
      LIBRARIES ${arg_LIBRARIES} ${arg_TEST_LIBRARIES})
    target_include_directories(${name}_test PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  endif()
endmacro()
