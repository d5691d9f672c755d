# SPDX-License-Identifier: BSD-3-Clause
# What every user's compiler has to read for #include "disflow/tracker.h". Nearly all of it is Eigen/Core and
# Eigen/Geometry with the standard headers that they include, which cannot be left out while the interface has vectors
# and poses. The bound on core's own share is what it is now; what needs more belongs into a .cc or an
# _impl.h file.
set(max_own_lines 7025)
set(not_for_users Eigen/Dense Eigen/Eigenvalues disflow/tracker_impl.h disflow/depth/segmenter_impl.h disflow/depth/segmenter_choice_impl.h disflow/depth/segmenter_anywhere_impl.h
  disflow/depth/model_gate.h disflow/depth/edge_sampler.h disflow/flow/pose_search.h disflow/flow/turn_search.h)

execute_process(COMMAND ${CXX} -std=c++20 -E -I${CORE_INCLUDE} -isystem ${EIGEN_INCLUDE} ${SOURCE}
  RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE error)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${error}")
endif()
foreach(header IN LISTS not_for_users)
  string(FIND "${text}" "/${header}\"" place)
  if(NOT place EQUAL -1)
    message(FATAL_ERROR "tracker.h includes ${header}, which is for those only who compile the tracker")
  endif()
endforeach()

# Lines of the headers that are core's.
execute_process(COMMAND ${CXX} -std=c++20 -MM -I${CORE_INCLUDE} -isystem ${EIGEN_INCLUDE} ${SOURCE}
  OUTPUT_VARIABLE rule COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^ \\\n]+\\.h" headers "${rule}")
set(own_lines 0)
foreach(header IN LISTS headers)
  file(READ ${header} lines)
  string(REGEX REPLACE "[^\n]" "" lines "${lines}")
  string(LENGTH "${lines}" count)
  math(EXPR own_lines "${own_lines} + ${count}")
endforeach()
message(STATUS "tracker.h: ${own_lines} lines of core's own (at most ${max_own_lines})")
if(own_lines GREATER max_own_lines)
  message(FATAL_ERROR "core's headers under tracker.h have grown to ${own_lines} lines, more than ${max_own_lines}")
endif()
