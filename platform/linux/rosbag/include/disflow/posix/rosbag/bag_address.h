// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>

#include "disflow/hal/fault.h"
#include "disflow/host/uri.h"

namespace disflow::posix {

/// What of which recording is played.
struct BagOptions {
  std::filesystem::path path;  ///< A file, or the folder that `ros2 bag record` made.
  /// sensor_msgs/Image, or CompressedImage of compressedDepth; empty: the only one that has its
  /// intrinsics.
  std::string depth_topic;
  std::string info_topic;         ///< sensor_msgs/CameraInfo; empty: beside the images.
  std::string mask_topic;         ///< sensor_msgs/Image, mono8 or 8UC1; empty: none.
  std::string world_frame;        ///< The camera's pose in it is taken from /tf; empty: none.
  std::string camera_frame;       ///< Of /tf; empty: as the images' headers say.
  std::optional<bool> rectified;  ///< Nothing: by the depth topic's name.
  std::optional<double> unit_m;   ///< Of 16-bit images; nothing: 0.001 for 16UC1, as REP 118 says.
  int first = 0;                  ///< Images left out at the start.
  int count = std::numeric_limits<int>::max();  ///< Images played at most.
};

/// Sets what follows from the depth topic's name and is not said: info_topic, rectified.
void SetTopicDefaults(BagOptions& options);

/// Reads `rosbag:PATH?depth=TOPIC&info=TOPIC&mask=TOPIC&world=FRAME&camera=FRAME&
/// rectified=yes|no&scale=M&first=N&count=N`.
/// @param options Unchanged unless the result is ok.
[[nodiscard]] hal::Fault ParseBagUri(const host::Uri& uri, BagOptions& options);

}  // namespace disflow::posix
