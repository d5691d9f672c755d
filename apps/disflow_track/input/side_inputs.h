// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "disflow/hal/camera_pose_history.h"
#include "disflow/hal/depth_sensor.h"
#include "disflow/posix/mask_source.h"
#include "input/mask_mailbox.h"
#include "input/pose_mailbox.h"
#include "program/console.h"
#include "settings/options.h"

namespace disflow::apps {

/// What other processes and machines say about a depth image: masks and the camera's pose.
class SideInputs {
 public:
  SideInputs(const Options& options, const hal::SensorInfo& sensor);

  /// Where the links put the camera's poses; null if nobody moves the camera.
  [[nodiscard]] hal::CameraPoseHistory* camera_poses() noexcept {
    return poses_ && !pose_mailbox_ ? &*poses_ : nullptr;
  }
  /// Where another thread puts the camera's poses or masks; null if they come by another way.
  [[nodiscard]] PoseMailbox* pose_mailbox() noexcept {
    return pose_mailbox_ ? &*pose_mailbox_ : nullptr;
  }
  [[nodiscard]] MaskMailbox* mask_mailbox() noexcept { return mask_mailbox_; }
  /// Adds to the frame what belongs to it. What is missing is counted, and the frame goes without.
  void Attach(DepthFrame& frame, Console& console) noexcept;

  /// @return A line per input for people.
  [[nodiscard]] std::vector<std::string> Summary() const;

 private:
  void TellOfMasks(Status status, const DepthView& depth, Console& console) noexcept;

  std::unique_ptr<posix::MaskSource> masks_;  ///< Null: none are wanted.
  bool said_wrong_size_ = false;
  bool said_corrupt_ = false;
  MaskMailbox* mask_mailbox_ = nullptr;  ///< The same as masks_, if it is one.
  std::optional<hal::CameraPoseHistory> poses_;
  std::optional<PoseMailbox> pose_mailbox_;
};

}  // namespace disflow::apps
