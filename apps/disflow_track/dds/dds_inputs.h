// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "dds/dds_clock.h"
#include "disflow/posix/dds/ros_any_subscription.h"
#include "disflow/posix/dds/ros_node.h"
#include "disflow/posix/ros/ros_transforms.h"
#include "input/mask_mailbox.h"
#include "input/pose_mailbox.h"
#include "settings/dds_address.h"

namespace disflow::apps {

/// Hands a mask on. What is no mask is told as one of a wrong size, with nothing in it.
/// @param clock Is known().
void PutMask(const posix::ros::Image& image, const DdsClock& clock, MaskMailbox& masks);

/// Points into the message.
[[nodiscard]] posix::RosTransform TransformOf(const posix::ros::TransformStamped& message) noexcept;

/// What the program takes from ROS 2: masks and the camera's pose.
class DdsInputs {
 public:
  /// @param poses,masks Null: not wanted. Else they outlive this.
  /// @throws Failure kOutputFailed.
  DdsInputs(const DdsAddress& address, posix::RosNode& node, PoseMailbox* poses,
            MaskMailbox* masks);

  /// Hands on what has come in.
  void Turn(const DdsClock& clock);

 private:
  void TakeTransforms(const DdsClock& clock);

  PoseMailbox* poses_;
  MaskMailbox* masks_;
  posix::RosTransforms transforms_;
  posix::RosAnySubscription<posix::ros::TFMessage> tf_;
  posix::RosAnySubscription<posix::ros::TFMessage> tf_static_;
  posix::RosSubscription<posix::ros::Image> images_;
};

}  // namespace disflow::apps
