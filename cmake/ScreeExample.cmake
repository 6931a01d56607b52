# scree_add_example(NAME [LABELS ...] [TIMEOUT seconds]): the folder of a scene, whose check.py is a test.
#
# The check runs the scene as a user would, reads the results and states the law that it tests.
function(scree_add_example name)
  cmake_parse_arguments(arg "" "TIMEOUT" "LABELS" ${ARGN})
  if(NOT SCREE_TESTS OR NOT TARGET scree)
    return()
  endif()
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 120)
  endif()
  add_test(NAME example:${name}
    COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/check.py $<TARGET_FILE:scree> ${CMAKE_BINARY_DIR}/examples/${name})
  set_tests_properties(example:${name} PROPERTIES LABELS "example;${arg_LABELS}" TIMEOUT ${arg_TIMEOUT}
    ENVIRONMENT "PYTHONPATH=${PROJECT_SOURCE_DIR}/examples/support;PYTHONDONTWRITEBYTECODE=1")
endfunction()
