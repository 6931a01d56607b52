# The few functions with which scree's folders describe themselves.

# What a run needs, program and plugins, and all benchmarks: `dev run` and `dev bench` build these and nothing else.
add_custom_target(scree_runtime)
add_custom_target(scree_benchmarks)

# scree_add_subfolders(FOLDER...): enters every folder below that has a CMakeLists.txt, in name order. A new plugin is
# a new folder and nothing else.
function(scree_add_subfolders)
  foreach(top IN LISTS ARGN)
    file(GLOB_RECURSE lists CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}
         ${CMAKE_CURRENT_SOURCE_DIR}/${top}/CMakeLists.txt)
    list(SORT lists)
    foreach(list_file IN LISTS lists)
      get_filename_component(folder ${list_file} DIRECTORY)
      # A project of its own (an example of an out-of-tree plugin, a test fixture) is not part of this build.
      file(STRINGS ${list_file} own_project REGEX "^project\\(")
      if(NOT own_project)
        add_subdirectory(${folder})
      endif()
    endforeach()
  endforeach()
endfunction()

# What is tested is built as users get it; the tests' own code only has to compile soon (a fifth sooner at -O1).
add_library(scree_test_flags INTERFACE)
target_compile_options(scree_test_flags INTERFACE $<$<CONFIG:Release>:-O1>)

# scree_add_test(NAME SOURCES ... [LIBRARIES ...] [ENVIRONMENT ...] [LABELS ...]): a GoogleTest program; each case is a
# test of CTest. The label `full` keeps a long test out of `./dev test`; `./dev test --full` runs it.
function(scree_add_test name)
  if(NOT SCREE_TESTS)
    return()
  endif()
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES;ENVIRONMENT;LABELS" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE scree::core scree_flags scree_test_flags GTest::gtest_main ${arg_LIBRARIES})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  gtest_discover_tests(${name} TEST_PREFIX ${name}: DISCOVERY_MODE PRE_TEST
    PROPERTIES ENVIRONMENT "${arg_ENVIRONMENT}" LABELS "${arg_LABELS}")
endfunction()

# scree_add_program(NAME SOURCES ... [LIBRARIES ...]): a program that users run; it is installed.
function(scree_add_program name)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE scree::core scree_flags scree_large_pages ${arg_LIBRARIES})
  set_target_properties(${name} PROPERTIES INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
  add_dependencies(scree_runtime ${name})
  install(TARGETS ${name} EXPORT scree-targets RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()

# scree_add_benchmark(NAME SOURCES ... [LIBRARIES ...]): a Google Benchmark program; `./dev bench NAME` runs it.
function(scree_add_benchmark name)
  if(NOT SCREE_BENCHMARKS)
    return()
  endif()
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE scree::core scree_flags scree_large_pages benchmark::benchmark ${arg_LIBRARIES})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/benchmarks)
  add_dependencies(scree_benchmarks ${name})
endfunction()

include(ScreeExample)
include(ScreeFuzz)
include(ScreePlugin)
