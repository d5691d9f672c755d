// SPDX-License-Identifier: BSD-3-Clause
#include "links/telemetry_output.h"

#include "disflow/types.h"

namespace disflow::apps {

TelemetryOutput::TelemetryOutput(const Options& options, const hal::SensorInfo& sensor,
                                 hal::CameraPoseHistory* camera_poses, Console& console)
    : sessions_(hal::mavlink::TelemetryOptions{}.system_id, console) {
  for (const std::string& uri : options.links) {
    const auto number = static_cast<std::uint8_t>(lines_.size());
    lines_.emplace_back(uri, number, options, sensor, camera_poses, sessions_, console);
  }
  for (MavlinkLine& line : lines_) line.Open();
}

TelemetryOutput::~TelemetryOutput() {
  for (MavlinkLine& line : lines_) line.Close();
}

void TelemetryOutput::Turn(std::int64_t now_ns) noexcept {
  sessions_.Advance();
  for (MavlinkLine& line : lines_) {
    line.Reopen(now_ns);
    line.AskForTime(now_ns);
  }
}

void TelemetryOutput::Send(std::span<const FrameResult> results, std::int64_t age_ns,
                           std::int64_t now_ns) noexcept {
  if (lines_.empty()) return;
  Turn(now_ns);
  const ClockReading now = ReadClocks();
  stamp_ns_ = results.front().estimate.stamp_ns;
  for (MavlinkLine& line : lines_) line.TakeStates(results);
  // In a replay at full speed a second of the stream passes sooner than one on the clock.
  if (!heartbeat_sent_ || now_ns - heartbeat_ns_ >= kSecond_ns ||
      stamp_ns_ - heartbeat_stamp_ns_ >= kSecond_ns) {
    heartbeat_ns_ = now_ns;
    SendHeartbeats(now);
  }
  for (MavlinkLine& line : lines_) line.Send(results, age_ns, now);
}

void TelemetryOutput::Receive(std::int64_t capture_now_ns) noexcept {
  sessions_.Advance();
  for (MavlinkLine& line : lines_) line.Receive(capture_now_ns);
}

void TelemetryOutput::Answer(const TrackedObjects& objects,
                             std::span<const FrameResult> results) noexcept {
  for (MavlinkLine& line : lines_) line.Answer(objects, results);
}

void TelemetryOutput::KeepAlive(std::int64_t now_ns) noexcept {
  if (lines_.empty()) return;
  Turn(now_ns);
  if (heartbeat_sent_ && now_ns - heartbeat_ns_ < kSecond_ns) return;
  heartbeat_ns_ = now_ns;
  SendHeartbeats(ReadClocks());
}

void TelemetryOutput::SendHeartbeats(const ClockReading& now) noexcept {
  heartbeat_sent_ = true;
  heartbeat_stamp_ns_ = stamp_ns_;
  for (MavlinkLine& line : lines_) line.SendHeartbeats(now);
}

std::vector<std::string> TelemetryOutput::Summary() {
  std::vector<std::string> summary;
  for (MavlinkLine& line : lines_) summary.push_back(line.Summary());
  return summary;
}

bool TelemetryOutput::AnyLost() const noexcept {
  for (const MavlinkLine& line : lines_) {
    if (line.lost()) return true;
  }
  return false;
}

std::span<const int> TelemetryOutput::fds() noexcept {
  fds_.clear();
  for (const MavlinkLine& line : lines_) fds_.push_back(line.fd());
  return fds_;
}

}  // namespace disflow::apps
