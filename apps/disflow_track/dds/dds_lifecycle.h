// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "disflow/posix/dds/ros_node.h"
#include "objects/object_channel.h"

namespace disflow::apps {

/// The node's life cycle as ROS 2's managers see it (lifecycle_msgs): active while it tracks,
/// inactive while it is paused. It is configured when it appears, and ends by its own rules: other
/// transitions than these two are refused.
class DdsLifecycle {
 public:
  /// @param node_name With its namespace.
  /// @throws Failure kOutputFailed.
  DdsLifecycle(const std::string& node_name, std::span<ObjectChannel* const> channels,
               posix::RosNode& node);

  /// Answers what was asked, tells what has changed, whoever changed it.
  void Turn();

 private:
  void TellChange();
  [[nodiscard]] bool is_active() const noexcept;
  [[nodiscard]] bool Change(const posix::ros::ChangeStateRequest& request) noexcept;

  std::vector<ObjectChannel*> channels_;
  bool told_active_ = true;  ///< As was told last; a run begins so.
  posix::RosPublisher<posix::ros::TransitionEvent> events_;
  posix::RosService<posix::ros::GetStateRequest, posix::ros::GetStateResponse> get_state_;
  posix::RosService<posix::ros::ChangeStateRequest, posix::ros::ChangeStateResponse> change_state_;
  posix::RosService<posix::ros::GetAvailableStatesRequest, posix::ros::GetAvailableStatesResponse>
      states_;
  posix::RosService<posix::ros::GetAvailableTransitionsRequest,
                    posix::ros::GetAvailableTransitionsResponse>
      transitions_;
};

}  // namespace disflow::apps
