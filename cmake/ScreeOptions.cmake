# What a build of scree can be asked for. The presets in CMakePresets.json set these.
option(SCREE_TESTS "Build the tests" ON)
option(SCREE_BENCHMARKS "Build the benchmarks" OFF)
option(SCREE_NATIVE "Compile for this very machine (-march=native)" ON)
option(SCREE_FUZZ "Build the fuzz targets with libFuzzer; needs clang" OFF)
set(SCREE_SANITIZE "" CACHE STRING "Sanitizers, as for -fsanitize= (address,undefined or thread)")

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

include(GNUInstallDirs)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
set(SCREE_PLUGIN_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib/scree/plugins)

# Debian's own Python: python3-vtk9, with which tests read results, belongs to it and to no other.
set(SCREE_PYTHON /usr/bin/python3 CACHE FILEPATH "Python that runs tests and checks")

# ccache with paths relative to this tree: two clones of it share what they compiled.
find_program(SCREE_CCACHE ccache)
if(SCREE_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} CCACHE_NOHASHDIR=1
    ${SCREE_CCACHE})
endif()

# Private flags of every scree target: warnings are errors, and no product is fused with a sum behind the code's back,
# so that the bits of a result do not depend on inlining or on the machine (ADR 0003).
add_library(scree_flags INTERFACE)
# This very machine, but Eigen is to see no vectors of 512 bits: a sum of eight lanes rounds otherwise than one of four, and
# results are to be the same on machines that have them (ADR 0003). The compiler uses them as it likes: it adds nothing in
# another order.
set(scree_machine "")
if(SCREE_NATIVE)
  list(APPEND scree_machine -march=native -U__AVX512F__)
endif()
target_compile_options(scree_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  -Wnon-virtual-dtor -Woverloaded-virtual $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> -Werror ${scree_machine}
  $<$<CONFIG:Release>:-O3> -ffp-contract=off -fno-math-errno -fno-trapping-math)
find_program(SCREE_MOLD mold)
find_program(SCREE_LLD ld.lld)
if(SCREE_MOLD)
  target_link_options(scree_flags INTERFACE -fuse-ld=mold)
elseif(SCREE_LLD)
  target_link_options(scree_flags INTERFACE -fuse-ld=lld)
endif()
if(SCREE_SANITIZE)
  target_compile_options(scree_flags INTERFACE -fsanitize=${SCREE_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(scree_flags INTERFACE -fsanitize=${SCREE_SANITIZE})
endif()
if(SCREE_FUZZ)
  target_compile_options(scree_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()
