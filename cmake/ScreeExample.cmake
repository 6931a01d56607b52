# scree_add_example(NAME [LABELS ...] [TIMEOUT seconds] [FULL_TIMEOUT seconds]): the folder of a scene, whose check.py is a
# test.
#
# The check runs the scene as a user would, reads the results and states the law that it tests. With FULL_TIMEOUT it is a
# second test, with the label `full`: the check gets the word `full` and tests its laws on more, or for longer.
function(scree_add_example name)
  cmake_parse_arguments(arg "" "TIMEOUT;FULL_TIMEOUT" "LABELS" ${ARGN})
  if(NOT SCREE_TESTS OR NOT TARGET scree)
    return()
  endif()
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 120)
  endif()
  _scree_add_check(example:${name} "example;${arg_LABELS}" ${arg_TIMEOUT} ${CMAKE_BINARY_DIR}/examples/${name})
  if(arg_FULL_TIMEOUT)
    _scree_add_check(full:${name} "full" ${arg_FULL_TIMEOUT} ${CMAKE_BINARY_DIR}/examples/${name}_full full)
  endif()
endfunction()

# _scree_add_check(TEST LABELS TIMEOUT FOLDER [MODE]): check.py of the current folder as a test.
function(_scree_add_check test labels timeout folder)
  add_test(NAME ${test}
    COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/check.py $<TARGET_FILE:scree> ${folder} ${ARGN})
  set_tests_properties(${test} PROPERTIES LABELS "${labels}" TIMEOUT ${timeout}
    ENVIRONMENT "PYTHONPATH=${PROJECT_SOURCE_DIR}/examples/support;PYTHONDONTWRITEBYTECODE=1")
endfunction()
