// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <vector>

#include "links/mavlink_line.h"
#include "links/signing_sessions.h"
#include "objects/tracked_object.h"
#include "program/console.h"
#include "program/frame_result.h"
#include "settings/options.h"

namespace disflow::apps {

/// Sends the estimates of all objects over any number of links. A link that fails while running
/// never stops the tracking.
class TelemetryOutput {
 public:
  /// Opens the links.
  /// @throws Failure as MavlinkLine's.
  /// @param sensor Where the frames come from.
  /// @param camera_poses Where the carrier's ODOMETRY goes; null if nothing is received.
  TelemetryOutput(const Options& options, const hal::SensorInfo& sensor,
                  hal::CameraPoseHistory* camera_poses, Console& console);
  TelemetryOutput(const TelemetryOutput&) = delete;
  TelemetryOutput& operator=(const TelemetryOutput&) = delete;
  ~TelemetryOutput();

  /// Pose and status of each object in a frame, and HEARTBEAT if one is due.
  /// @param results In the order of Options::objects.
  /// @param age_ns From capture to now; negative = unknown.
  void Send(std::span<const FrameResult> results, std::int64_t age_ns,
            std::int64_t now_ns) noexcept;
  /// Takes what has come in, a bounded number of bytes.
  /// @param capture_now_ns Now, on the clock of the depth images' stamps.
  void Receive(std::int64_t capture_now_ns) noexcept;
  /// Answers the questions and obeys the commands of those who listen, a bounded number per frame.
  /// @param objects In the order of Options::objects.
  void Answer(const TrackedObjects& objects, std::span<const FrameResult> results) noexcept;
  /// What is due although no frame comes.
  void KeepAlive(std::int64_t now_ns) noexcept;

  /// @return A line per link for people: what was sent and what was lost.
  [[nodiscard]] std::vector<std::string> Summary();
  /// @return true if a link is down now.
  [[nodiscard]] bool AnyLost() const noexcept;
  /// What shows input when there is something to receive, of each link; -1: nothing now.
  [[nodiscard]] std::span<const int> fds() noexcept;

 private:
  /// What is due by the clock alone.
  void Turn(std::int64_t now_ns) noexcept;
  void SendHeartbeats(const ClockReading& now) noexcept;

  SigningSessions sessions_;
  std::deque<MavlinkLine> lines_;
  std::vector<int> fds_;
  bool heartbeat_sent_ = false;
  std::int64_t heartbeat_ns_ = 0;   ///< On the clock.
  StampNs heartbeat_stamp_ns_ = 0;  ///< In the stream.
  StampNs stamp_ns_ = 0;
};

}  // namespace disflow::apps
