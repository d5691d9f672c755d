// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "disflow/posix/dds/ros_messages.h"
#include "program/frame_result.h"

/// @file
/// From an Estimate to ROS 2 messages. Frames: docs/ros2.md.

namespace disflow::apps {

/// The names that stand in messages. Messages point to them: they outlive all messages.
struct DdsFrames {
  std::string camera;
  std::string object;
  std::string world;  ///< Empty: none.
};

[[nodiscard]] posix::ros::Header RosHeader(std::int64_t ros_ns, const std::string& frame) noexcept;

/// Pose in the camera's frame; twist in the object's, as nav_msgs/Odometry wants it.
[[nodiscard]] posix::ros::Odometry MakeRosOdometry(const Estimate& estimate, std::int64_t ros_ns,
                                                   const DdsFrames& frames) noexcept;
[[nodiscard]] posix::ros::PoseWithCovarianceStamped MakeRosPose(const Estimate& estimate,
                                                                std::int64_t ros_ns,
                                                                const DdsFrames& frames) noexcept;
/// In the camera's axes.
[[nodiscard]] posix::ros::TwistWithCovarianceStamped MakeRosTwist(const Estimate& estimate,
                                                                  std::int64_t ros_ns,
                                                                  const DdsFrames& frames) noexcept;
[[nodiscard]] posix::ros::TransformStamped MakeRosTransform(const Estimate& estimate,
                                                            std::int64_t ros_ns,
                                                            const DdsFrames& frames) noexcept;

/// Where the camera is in the world.
[[nodiscard]] posix::ros::TransformStamped MakeRosCameraTransform(
    const Transform<World, Camera>& T_wc, std::int64_t ros_ns, const DdsFrames& frames) noexcept;

/// Where the object has been: in the world if the camera's pose is known, else in the camera's
/// frame. The last kCapacity poses.
class DdsPath {
 public:
  static constexpr std::size_t kCapacity = 1000;

  /// Forgets the poses of an object frame or of a parent frame that is no more.
  void Add(const Estimate& estimate, std::int64_t ros_ns, const DdsFrames& frames);
  [[nodiscard]] posix::ros::Path Message() noexcept;
  [[nodiscard]] bool empty() const noexcept { return poses_.empty(); }

 private:
  std::vector<posix::ros::PoseStamped> poses_;
  const std::string* frame_ = nullptr;
  std::uint8_t reset_counter_ = 0;
};

}  // namespace disflow::apps
