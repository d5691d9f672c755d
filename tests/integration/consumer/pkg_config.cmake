# SPDX-License-Identifier: BSD-3-Clause
# A C program is compiled with what pkg-config says of the installed library, and run.
# DISFLOW_BUILD, WORK, SOURCE, CC, PKG_CONFIG, VERSION
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
run(${PKG_CONFIG} --cflags --libs disflow)
separate_arguments(flags UNIX_COMMAND "${output}")
run(${CC} -std=c99 -O2 ${SOURCE} ${flags} -o ${WORK}/track)
run(${WORK}/track)
if(NOT output MATCHES "surface: ok, [1-9]")
  message(FATAL_ERROR "the program ran, but says:\n${output}")
endif()
