# What a build of scree can be asked for. The presets in CMakePresets.json set these.
option(SCREE_TESTS "Build the tests" ON)
option(SCREE_BENCHMARKS "Build the benchmarks" OFF)
option(SCREE_NATIVE "Compile for this very machine (-march=native)" ON)
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

find_program(SCREE_CCACHE ccache)
if(SCREE_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${SCREE_CCACHE})
endif()

# Private flags of every scree target: warnings are errors, and no contraction into fused multiply-add across
# statements decides a result (ADR 0003).
add_library(scree_flags INTERFACE)
target_compile_options(scree_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  -Wnon-virtual-dtor -Woverloaded-virtual -Werror $<$<BOOL:${SCREE_NATIVE}>:-march=native>
  $<$<CONFIG:Release>:-O3> -fno-math-errno -fno-trapping-math)
if(SCREE_SANITIZE)
  target_compile_options(scree_flags INTERFACE -fsanitize=${SCREE_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(scree_flags INTERFACE -fsanitize=${SCREE_SANITIZE})
endif()
