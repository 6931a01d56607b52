# scree_add_fuzz(NAME SOURCES ... [LIBRARIES ...] [FINDINGS FOLDER]): what reads bytes from outside meets bytes that nobody
# wrote on purpose. SOURCES define LLVMFuzzerTestOneInput() and scree::fuzz::write_seeds() (tests/fuzz/fuzz.hpp).
#
# NAME_replay, with any compiler: the test `fuzz:NAME` gives it every seed, what lies in the folder FINDINGS, and some thousand
# variants of them; it also writes the seeds, and takes single files. NAME, with SCREE_FUZZ and clang: libFuzzer itself, which
# looks for new ones (`./dev fuzz NAME`).
function(scree_add_fuzz name)
  if(NOT SCREE_TESTS)
    return()
  endif()
  cmake_parse_arguments(arg "" "FINDINGS" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name}_replay ${arg_SOURCES} ${CMAKE_SOURCE_DIR}/tests/fuzz/replay.cpp)
  add_test(NAME fuzz:${name} COMMAND ${name}_replay ${arg_FINDINGS})
  set(programs ${name}_replay)
  if(SCREE_FUZZ)
    add_executable(${name} ${arg_SOURCES})
    target_link_options(${name} PRIVATE -fsanitize=fuzzer)
    list(APPEND programs ${name})
  endif()
  foreach(program IN LISTS programs)
    target_link_libraries(${program} PRIVATE scree::core scree_flags scree_test_flags scree_test_support ${arg_LIBRARIES})
    set_target_properties(${program} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/fuzz)
  endforeach()
endfunction()
