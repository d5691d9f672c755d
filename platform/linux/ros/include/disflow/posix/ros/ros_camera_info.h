// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "disflow/geometry/pinhole_camera.h"
#include "disflow/hal/fault.h"

namespace disflow::posix {

/// A sensor_msgs/CameraInfo as it came; nothing of it is trusted.
struct RosCameraInfo {
  std::uint32_t width_px = 0;  ///< Of the whole sensor, as it was calibrated.
  std::uint32_t height_px = 0;
  std::string_view distortion_model;
  std::span<const double> d;
  std::span<const double, 9> k;
  std::span<const double, 12> p;
  std::uint32_t binning_x = 0;  ///< 0 is 1.
  std::uint32_t binning_y = 0;
  std::uint32_t roi_x_px = 0;
  std::uint32_t roi_y_px = 0;
  std::uint32_t roi_width_px = 0;  ///< 0: the whole sensor.
  std::uint32_t roi_height_px = 0;
};

/// Intrinsics of the images that belong to a CameraInfo, and how large these must be.
struct RosIntrinsics {
  std::uint32_t width_px = 0;
  std::uint32_t height_px = 0;
  PinholeCamera camera;
};

/// By the meaning that REP 104 gives the fields: P for rectified images, K for others, both moved
/// by the region of interest and divided by the binning.
/// @param rectified The images are: their distortion has been undone.
/// @return kUnsupported for what no pinhole describes, with what to do; kInvalidIntrinsics for no
/// calibration.
[[nodiscard]] hal::Fault ReadCameraInfo(const RosCameraInfo& info, bool rectified,
                                        RosIntrinsics& intrinsics) noexcept;

/// @return Whether the name of a topic says that its images are rectified, as image_proc's and
/// realsense2_camera's do: `…/image_rect`, `…/image_rect_raw`, also with a transport behind.
[[nodiscard]] bool IsRectifiedTopic(std::string_view topic) noexcept;

/// @return The topic of the CameraInfo that belongs to images, beside theirs, as ROS's
/// image_transport has it.
[[nodiscard]] std::string CameraInfoTopic(std::string_view image_topic);

/// @return Whether images of this topic are compressed depth, as its last part says.
[[nodiscard]] bool IsCompressedDepthTopic(std::string_view topic) noexcept;

}  // namespace disflow::posix
