// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "disflow/posix/ros/ros_camera_info.h"
#include "disflow/posix/ros/ros_depth_decoder.h"
#include "disflow/posix/ros/ros_transforms.h"
#include "disflow/types.h"
#include "message_reader.h"

namespace disflow::posix {

/// A message as it lies in a bag; nothing of it is trusted.
struct BagMessage {
  Serialization serialization = Serialization::kCdr;
  std::string_view type;  ///< `sensor_msgs/msg/Image`, in ROS 1 `sensor_msgs/Image`.
  std::span<std::uint8_t> data;
};

/// @return Whether a type is one of the package sensor_msgs, of ROS 2 or ROS 1.
[[nodiscard]] bool IsSensorType(std::string_view type, std::string_view name) noexcept;
/// The same of a message's.
[[nodiscard]] inline bool IsSensorMessage(const BagMessage& message,
                                          std::string_view name) noexcept {
  return IsSensorType(message.type, name);
}

/// @return The frame that stands in the header of a message that begins with one; empty: none.
[[nodiscard]] std::string_view ReadFrameName(const BagMessage& message);

/// The functions below point into the message.
/// @return kTruncated for a message that ends too soon or is none, kCorrupt for one without a
/// stamp.
[[nodiscard]] hal::Fault ReadImage(const BagMessage& message, StampNs& stamp_ns, RosImage& image);

/// Reads a tf2_msgs/TFMessage, or ROS 1's tf/tfMessage.
/// @param transforms Those that are whole.
[[nodiscard]] hal::Fault ReadTransforms(const BagMessage& message,
                                        std::vector<RosTransform>& transforms);

struct CompressedImage {
  std::string_view format;
  std::span<const std::uint8_t> data;
};
[[nodiscard]] hal::Fault ReadCompressedImage(const BagMessage& message, StampNs& stamp_ns,
                                             CompressedImage& image);

/// Reads a sensor_msgs/CameraInfo and what it means; see ReadCameraInfo().
/// @param stamp_ns 0 if it has none: recordings of RealSense cameras hold one for all images.
[[nodiscard]] hal::Fault ReadIntrinsics(const BagMessage& message, bool rectified,
                                        StampNs& stamp_ns, RosIntrinsics& intrinsics);

}  // namespace disflow::posix
