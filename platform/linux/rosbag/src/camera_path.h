// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "disflow/depth/depth_frame.h"
#include "disflow/hal/camera_pose_history.h"
#include "disflow/posix/ros/ros_transforms.h"
#include "topic_stream.h"

namespace disflow::posix {

/// The camera's pose in the world at the moments of a recording's images, from its /tf and
/// /tf_static: as those who listen to them have it (docs/ros2.md), but that nothing comes late.
class CameraPath {
 public:
  /// Reads /tf_static to its end.
  [[nodiscard]] hal::Fault Open(const std::vector<std::filesystem::path>& files,
                                const std::string& world, const std::string& camera);
  /// Back to the first pose. @return kNotFound if the world does not lead to the camera.
  [[nodiscard]] hal::Fault Restart(const std::vector<std::filesystem::path>& files);
  /// Adds the pose of the frame's moment, if there is one. @return What cannot be read at all; what
  /// is damaged is passed over: whoever reads the frames says it.
  [[nodiscard]] hal::Fault Accompany(DepthFrame& frame);

 private:
  /// @return kEndOfStream, and nothing is taken, behind the last pose.
  [[nodiscard]] hal::Fault Take();

  TopicStream stream_;
  std::string world_;
  std::string camera_;
  std::optional<RosTransforms> fixed_;
  std::optional<RosTransforms> transforms_;
  std::optional<RosTransforms::CameraPose> next_;  ///< Not in the history yet.
  std::optional<hal::CameraPoseHistory> history_;
};

}  // namespace disflow::posix
