# SPDX-License-Identifier: BSD-3-Clause
# What the programs for Linux can do. All of it is on if the programs are built and off otherwise, unless set by
# name, e.g. -DDISFLOW_WITH_LIBCAMERA=OFF. (Not option(): the default must follow DISFLOW_BUILD_APPS when that changes.)
#   DISFLOW_WITH_LIBCAMERA  cameras of libcamera (--sensor libcamera:)
#   DISFLOW_WITH_DDS        ROS 2 over DDS (--sensor dds:, --link dds:)
#   DISFLOW_WITH_ROSBAG     recordings of ROS (--sensor rosbag:)
#   DISFLOW_WITH_VIEW       the live view (--view)
set(disflow_has_programs OFF)
if(DISFLOW_BUILD_APPS AND CMAKE_SYSTEM_NAME STREQUAL "Linux")
  set(disflow_has_programs ON)
endif()
if(DISFLOW_BUILD_APPS OR DISFLOW_BUILD_FUZZERS)
  set(DISFLOW_BUILD_PLATFORM ON)  # they are built on it, as are the features
endif()
foreach(feature LIBCAMERA DDS ROSBAG VIEW)
  if(NOT DEFINED DISFLOW_WITH_${feature})
    set(DISFLOW_WITH_${feature} ${disflow_has_programs})
  endif()
  if(DISFLOW_WITH_${feature})
    set(DISFLOW_BUILD_PLATFORM ON)
  endif()
endforeach()

# Recorded sequences and pictures; ROS sends depth as pictures too.
set(DISFLOW_USES_FILES OFF)
if((DISFLOW_BUILD_APPS OR DISFLOW_BUILD_FUZZERS OR DISFLOW_WITH_DDS OR DISFLOW_WITH_ROSBAG) AND NOT CMAKE_SYSTEM_NAME STREQUAL "Generic")
  set(DISFLOW_USES_FILES ON)
endif()

# As disflow_track --version names it; the rest is always there.
set(disflow_features v4l2 libcamera serial udp mavlink dds rosbag view)
foreach(feature LIBCAMERA DDS ROSBAG VIEW)
  if(NOT DISFLOW_WITH_${feature})
    string(TOLOWER ${feature} name)
    list(REMOVE_ITEM disflow_features ${name})
  endif()
endforeach()
list(JOIN disflow_features " " disflow_features)
