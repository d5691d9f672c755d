# SPDX-License-Identifier: BSD-3-Clause
# Configures, builds and runs the consumer project; see CMakeLists.txt for the variables.
include(${CMAKE_CURRENT_LIST_DIR}/check_commands.cmake)
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    string(REPLACE ";" " " command "${ARGV}")
    message(FATAL_ERROR "${command}\nended with ${result}:\n${output}")
  endif()
  message(STATUS "${output}")
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
set(options -G ${GENERATOR} -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DCMAKE_CXX_COMPILER=${CXX} "-DCMAKE_CXX_FLAGS=${FLAGS}"
  "-DCMAKE_EXE_LINKER_FLAGS=${LINK_FLAGS}" -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
if(WAY STREQUAL "installed")
  run(${CMAKE_COMMAND} --install ${DISFLOW_BUILD} --prefix ${WORK}/prefix)
  list(APPEND options -DCMAKE_PREFIX_PATH=${WORK}/prefix -DCMAKE_BUILD_TYPE=Release)
else()
  list(APPEND options -DDISFLOW_SOURCE=${DISFLOW_SOURCE})
endif()
if(WAY STREQUAL "subdirectory")
  # Neither optimised nor debuggable: quick to build, and the assertions hold. The flags warn of much that this project's
  # own do not; that must not stop anybody.
  list(APPEND options -DCMAKE_BUILD_TYPE=None
    "-DCMAKE_CXX_FLAGS=${FLAGS} -Wall -Wextra -Wfloat-conversion -Wold-style-cast -Wfloat-equal -Wsign-promo")
elseif(WAY STREQUAL "no_build_type")
  # To configure is enough: the commands tell how it would be built.
  run(${CMAKE_COMMAND} -S ${PROJECT} -B ${WORK}/build ${options})
  if(NOT output MATCHES "disflow: no build type was given, so everything is built as Release")
    message(FATAL_ERROR "nothing is said about the build type")
  endif()
  check_all_commands_match(${WORK}/build " -O[23] ")
  return()
endif()
run(${CMAKE_COMMAND} -S ${PROJECT} -B ${WORK}/build ${options})
if(WAY STREQUAL "subdirectory")
  check_only_core_and_hal_are_built(${WORK}/build ${DISFLOW_SOURCE} ${PROJECT})
  # Some do, and it takes half of the time.
  run(${CMAKE_COMMAND} -S ${PROJECT} -B ${WORK}/build -DCMAKE_UNITY_BUILD=ON)
endif()
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)
run(${WORK}/build/own_profile)
