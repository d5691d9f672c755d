// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "disflow/posix/dds/ros_messages.h"
#include "input/pose_mailbox.h"

namespace disflow::apps {

/// As much of ROS's tf tree as leads from the world to the camera.
class DdsTransforms {
 public:
  static constexpr std::size_t kMaxFrames = 1024;  ///< Of the tree; those beyond are left out.
  static constexpr int kMaxDepth = 64;
  static constexpr std::size_t kMaxName = 255;  ///< A longer one is no frame's.

  /// Where the camera is.
  struct CameraPose {
    std::int64_t ros_ns = 0;  ///< Of the newest of the moving links that have come.
    PoseMailbox::Pose T_wc;
  };

  DdsTransforms(std::string world, std::string camera)
      : world_(std::move(world)), camera_(std::move(camera)) {}

  /// @param fixed From /tf_static. What is no transform is left out.
  void Add(const posix::ros::TransformStamped& message, bool fixed);
  /// @return Nothing if the world does not lead to the camera, or if none of the moving links
  /// between them has come since the last call.
  [[nodiscard]] std::optional<CameraPose> Camera();

 private:
  struct Link {
    std::string parent;
    PoseMailbox::Pose T_parent_child;
    std::int64_t ros_ns = 0;
    bool fixed = false;
    bool has_come = true;  ///< Since Camera() was called last.
  };

  std::string world_;
  std::string camera_;
  std::map<std::string, Link> links_;  ///< By the child's name.
};

}  // namespace disflow::apps
