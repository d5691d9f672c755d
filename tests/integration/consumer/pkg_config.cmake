# SPDX-License-Identifier: BSD-3-Clause
# A C program and one in C++ are compiled with what pkg-config says of the installed library, and run.
# DISFLOW_BUILD, WORK, C_SOURCE, CXX_SOURCE, CC, CXX, PKG_CONFIG, VERSION
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output
    OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT result EQUAL 0)
    string(REPLACE ";" " " command "${ARGV}")
    message(FATAL_ERROR "${command}\nended with ${result}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${DISFLOW_BUILD} --prefix ${WORK}/prefix)
file(GLOB_RECURSE described ${WORK}/prefix/*/disflow.pc)
cmake_path(GET described PARENT_PATH folder)
set(ENV{PKG_CONFIG_PATH} ${folder})
# If there is a shared library, it is taken.
set(ENV{LD_LIBRARY_PATH} ${folder}/..)
run(${PKG_CONFIG} --modversion disflow)
if(NOT output STREQUAL VERSION)
  message(FATAL_ERROR "pkg-config says version ${output}, the project's is ${VERSION}")
endif()

# try(<program> <packages> <what the program has to say> <compiler and its options...>)
function(try program packages expected)
  run(${PKG_CONFIG} --cflags --libs ${packages})
  separate_arguments(flags UNIX_COMMAND "${output}")
  run(${ARGN} ${flags} -o ${WORK}/${program})
  run(${WORK}/${program})
  if(NOT output MATCHES "${expected}")
    message(FATAL_ERROR "${program} ran, but says:\n${output}")
  endif()
endfunction()
try(in_c disflow "surface: ok, [1-9]" ${CC} -std=c99 -O2 ${C_SOURCE})
# Its headers name Eigen's.
try(in_cxx "disflow;eigen3" "a finger there is 0[.][1-9]" ${CXX} -std=c++20 -O2 ${CXX_SOURCE})
