# SPDX-License-Identifier: BSD-3-Clause
# Compiles SOURCE with the options that disflow::core hands to its users, and -Werror: it is warned of, and compiles.
string(REPLACE "," ";" options "${OPTIONS}")
execute_process(
  COMMAND ${CXX} -std=c++20 -Werror ${options} -I${CORE_INCLUDE} -isystem ${EIGEN_INCLUDE} -c ${SOURCE} -o ${WORK}/tracker_on_stack.o
  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
message(STATUS "${output}")
if(NOT result EQUAL 0)
  message(FATAL_ERROR "the warning has become an error")
endif()
if(NOT output MATCHES "frame[^\n]*(larger than|exceeds limit)")
  message(FATAL_ERROR "nothing is said of the stack")
endif()
