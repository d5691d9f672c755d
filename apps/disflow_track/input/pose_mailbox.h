// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <mutex>
#include <utility>

#include "disflow/hal/camera_pose_history.h"

namespace disflow::apps {

/// Poses of the camera on their way from another thread of this program to the tracking thread, in
/// their order. When it is full the oldest make way. Neither side waits longer than a few
/// assignments take.
class PoseMailbox {
 public:
  using Pose = Transform<World, hal::Body, double>;

  static constexpr std::size_t kCapacity = 128;

  /// By the other thread.
  void Put(StampNs stamp_ns, const Pose& T_wb) {
    const std::lock_guard lock(mutex_);
    if (count_ == kCapacity) {
      first_ = (first_ + 1) % kCapacity;
      --count_;
    }
    poses_[(first_ + count_) % kCapacity] = {stamp_ns, T_wb};
    ++count_;
  }

  /// By the tracking thread. Poses that the history refuses are counted there.
  /// @param now_ns Now, on the clock of the stamps.
  void MoveTo(hal::CameraPoseHistory& history, std::int64_t now_ns) noexcept {
    const std::lock_guard lock(mutex_);
    for (; count_ > 0; --count_, first_ = (first_ + 1) % kCapacity) {
      (void)history.Add(poses_[first_].first, poses_[first_].second, /*reset_counter=*/0, now_ns);
    }
  }

 private:
  std::mutex mutex_;
  std::array<std::pair<StampNs, Pose>, kCapacity> poses_;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
};

}  // namespace disflow::apps
