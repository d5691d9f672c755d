# SPDX-License-Identifier: BSD-3-Clause
# Reading Eigen and the standard library is most of what a file of the programs takes to compile; with this it is done once,
# and what a target's own headers ask for once for every eight files. Not for core, whose instructions are counted as they
# are by default (nobody counts them under sanitizers and in the demonstration), and the first not for hal, whose flags are
# others (cmake/flags.cmake). Not by default: every file shall name what it includes, which nobody notices with these. Tests
# (tests/CMakeLists.txt) have their headers read once in any case.
add_library(disflow_headers OBJECT ${PROJECT_SOURCE_DIR}/cmake/precompiled.cc)
target_link_libraries(disflow_headers PRIVATE disflow::core disflow_warnings)
target_precompile_headers(disflow_headers PRIVATE
  <Eigen/Cholesky> <Eigen/Core> <Eigen/Eigenvalues> <Eigen/Geometry>
  <algorithm> <array> <cmath> <deque> <filesystem> <fstream> <functional> <map> <memory> <optional> <span> <string> <vector>)

# disflow_compile_together(<target> [<file to compile alone>...])
function(disflow_compile_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  if(ARGN)
    set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
  # A class of a source file may have members of types of its unnamed namespace; GCC takes files read together for headers.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()
disflow_compile_together(disflow_hal)
if(DISFLOW_SANITIZED OR DISFLOW_COMPILE_QUICKLY)
  disflow_compile_together(disflow_core)
endif()

# What is compiled to be run for a minute: optimising is half of what a file of the programs takes to compile. Behind the
# build type's own -O3; precompiled headers are of use only to what is optimised alike.
if(DISFLOW_COMPILE_QUICKLY)
  set(disflow_program_options -O1)
endif()
target_compile_options(disflow_headers PRIVATE ${disflow_program_options})

function(disflow_precompile folder)
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    get_target_property(type ${target} TYPE)
    if(type MATCHES "^(STATIC_LIBRARY|EXECUTABLE)$")
      # As in the precompiled headers.
      target_compile_options(${target} PRIVATE -ffp-contract=off ${disflow_program_options})
      target_precompile_headers(${target} REUSE_FROM disflow_headers)
      disflow_compile_together(${target})
    endif()
  endforeach()
  get_property(folders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(inner IN LISTS folders)
    disflow_precompile(${inner})
  endforeach()
endfunction()

disflow_precompile(${PROJECT_SOURCE_DIR}/platform)
disflow_precompile(${PROJECT_SOURCE_DIR}/apps)
