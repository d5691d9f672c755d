# SPDX-License-Identifier: BSD-3-Clause
# Without optimisation the tracker is about a hundred times slower, and Eigen's inline functions are compiled into the
# user's own files as well. So a build that names no type becomes Release, including the project around this one.
get_property(disflow_is_multi_config GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
if(NOT disflow_is_multi_config AND NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CXX_FLAGS MATCHES "(^| )-O")
  message(STATUS "disflow: no build type was given, so everything is built as Release (-DCMAKE_BUILD_TYPE=... for another)")
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, RelWithDebInfo, Debug, MinSizeRel" FORCE)
  set(CMAKE_BUILD_TYPE Release)
endif()
