// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace disflow::apps {

/// Scheme and options of `--sensor rosbag:`, for --help.
inline constexpr const char* kRosbagHelp =
    "  rosbag:PATH?depth=TOPIC, or FILE.mcap, FILE.db3, FILE.bag alone\n"
    "               depth images of a recording of ROS (docs/ros2.md): a file .mcap, .db3 or .bag, "
    "or the folder of ros2 bag\n"
    "               record; depth= may be left out if only one topic has depth images and their "
    "CameraInfo.\n"
    "               Options: info=TOPIC (CameraInfo; camera_info beside the images), mask=TOPIC "
    "(mono8),\n"
    "               world=FRAME (the camera's pose in it, from /tf), camera=FRAME (its own; by the "
    "images),\n"
    "               rectified=yes|no (by the topic's name), scale=M (of 16-bit images), first=N, "
    "count=N\n";

}  // namespace disflow::apps
