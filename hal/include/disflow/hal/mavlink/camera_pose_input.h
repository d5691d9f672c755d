// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "disflow/hal/camera_pose_history.h"
#include "disflow/hal/mavlink/frame.h"
#include "disflow/hal/mavlink/messages.h"
#include "disflow/hal/sender_clock.h"

namespace disflow::hal::mavlink {

/// Whose ODOMETRY moves the camera, and on which clock it is stamped.
struct CameraPoseSource {
  std::uint8_t system_id = 1;
  MavFrame world = MavFrame::kLocalFrd;  ///< ODOMETRY in another frame is refused.
  /// false: time_usec is on the clock of the depth images' stamps. true: on a clock of the sender's
  /// own; its offset is learnt from when messages arrive, see SenderClock.
  bool own_clock = false;
};

/// What came in besides usable poses; saturating.
struct CameraPoseInputCounters {
  std::uint32_t other_system = 0;  ///< ODOMETRY from another system.
  std::uint32_t other_frame = 0;   ///< In a world frame other than the one wanted.
  std::uint32_t failed = 0;        ///< The sender reported that its estimate failed.
};

/// Puts the carrier's ODOMETRY of one link into a history.
class CameraPoseInput {
 public:
  CameraPoseInput(const CameraPoseSource& source, CameraPoseHistory& history) noexcept
      : source_(source), history_(&history) {}

  /// Other messages are passed over.
  /// @param now_ns Now, on the clock of the depth images.
  void Take(const FrameView& frame, std::int64_t now_ns) noexcept;

  [[nodiscard]] const CameraPoseInputCounters& counters() const noexcept { return counters_; }
  /// frame_id of the last ODOMETRY that was refused for it; 0 = none was.
  [[nodiscard]] std::uint8_t refused_frame() const noexcept { return refused_frame_; }

 private:
  [[nodiscard]] Expected<StampNs> ToCaptureClock(std::uint64_t time_usec,
                                                 std::int64_t now_ns) noexcept;

  CameraPoseSource source_;
  CameraPoseHistory* history_;
  CameraPoseInputCounters counters_;
  std::uint8_t refused_frame_ = 0;
  SenderClock clock_;
};

}  // namespace disflow::hal::mavlink
