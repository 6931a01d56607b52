# Given build, source, compiler and python: installs the build into a fresh prefix, configures and builds the
# project in `source` against it with nothing but CMAKE_PREFIX_PATH, runs its conformance test, and its scene with the
# installed program.
cmake_minimum_required(VERSION 3.25)

set(prefix ${build}/out_of_tree/prefix)
set(plugin_build ${build}/out_of_tree/build)
set(results ${build}/out_of_tree/results)
file(REMOVE_RECURSE ${build}/out_of_tree)

# A message that ends the test when a step fails; its output only then.
function(run what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${what} failed (${status}):\n${output}")
  endif()
  message(STATUS "${what}: done")
  set(output "${output}" PARENT_SCOPE)
endfunction()

run("install" ${CMAKE_COMMAND} --install ${build} --prefix ${prefix})
run("configure" ${CMAKE_COMMAND} -S ${source} -B ${plugin_build} -G Ninja -D CMAKE_PREFIX_PATH=${prefix}
  -D CMAKE_CXX_COMPILER=${compiler} -D CMAKE_FIND_USE_PACKAGE_REGISTRY=OFF -D BUILD_TESTING=ON)
run("build" ${CMAKE_COMMAND} --build ${plugin_build})
if(NOT EXISTS ${plugin_build}/push.so)
  message(FATAL_ERROR "the build left no push.so in ${plugin_build}")
endif()

run("ctest" ${CMAKE_CTEST_COMMAND} --test-dir ${plugin_build} --verbose --no-tests=error)
foreach(expected "conformance:push" "ForceFieldConformance.copes_with_a_scene_without_bodies/push")
  if(NOT output MATCHES "${expected}")
    message(FATAL_ERROR "ctest did not run ${expected}:\n${output}")
  endif()
endforeach()

# Whoever reads the example should find it as short as it is said to be.
foreach(limit "push.cpp;25" "CMakeLists.txt;5")
  list(GET limit 0 name)
  list(GET limit 1 most)
  file(STRINGS ${source}/${name} lines)
  list(LENGTH lines count)
  if(count GREATER most)
    message(FATAL_ERROR "${name} has ${count} lines, at most ${most} are promised")
  endif()
endforeach()

set(scree ${prefix}/bin/scree)
run("plugins show" ${scree} plugins show force_field:push --plugin-dir ${plugin_build})
if(NOT output MATCHES "acceleration" OR NOT output MATCHES "m/s2")
  message(FATAL_ERROR "`scree plugins show` does not tell about the parameter:\n${output}")
endif()
run("run" ${scree} run ${source}/scene.toml -o ${results} --plugin-dir ${plugin_build})
run("check" ${python} ${source}/check.py ${results})
# Without --plugin-dir the plugin must be unknown, or the run above used another file.
execute_process(COMMAND ${scree} check ${source}/scene.toml RESULT_VARIABLE status ERROR_VARIABLE output)
if(NOT status EQUAL 2 OR NOT output MATCHES "push")
  message(FATAL_ERROR "without --plugin-dir, exit code 2 and the plugin's name were expected, not ${status}:\n${output}")
endif()
