// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "disflow/hal/mavlink/camera_pose_input.h"
#include "disflow/hal/mavlink/command_input.h"
#include "disflow/hal/mavlink/distance_query_input.h"
#include "disflow/hal/mavlink/frame_decoder.h"
#include "disflow/hal/mavlink/telemetry.h"
#include "disflow/posix/link.h"
#include "links/link_reader.h"
#include "links/signing_sessions.h"
#include "objects/tracked_object.h"
#include "program/console.h"
#include "program/frame_result.h"
#include "settings/options.h"

namespace disflow::apps {

/// Sends the estimates of all objects over any number of links. A link that fails while running
/// never stops the tracking: it is said once, counted, and opened again as soon as that is
/// possible.
class TelemetryOutput {
 public:
  /// Opens the links.
  /// @throws Failure kWrongUsage for an address that cannot be parsed or a key that cannot be used,
  /// kOutputFailed for a link that cannot be opened.
  /// @param camera_poses Where the carrier's ODOMETRY goes; null if nothing is received.
  TelemetryOutput(const Options& options, hal::CameraPoseHistory* camera_poses, Console& console);
  TelemetryOutput(const TelemetryOutput&) = delete;
  TelemetryOutput& operator=(const TelemetryOutput&) = delete;
  ~TelemetryOutput();

  /// ODOMETRY and DISFLOW_STATUS of each object in a frame, and HEARTBEAT if one is due.
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
  /// HEARTBEAT if one is due although no frame comes.
  void KeepAlive(std::int64_t now_ns) noexcept;

  /// @return A line per link for people: what was sent and what was lost.
  [[nodiscard]] std::vector<std::string> Summary();
  /// @return true if a link is down now.
  [[nodiscard]] bool AnyLost() const noexcept;

 private:
  struct Line {
    posix::Link link;
    LinkReader reader;
    bool lost = false;
    std::int64_t retry_ns = 0;
    hal::mavlink::FrameDecoder decoder;
    hal::mavlink::SigningSession* session = nullptr;  ///< Null: nothing is signed or verified.
    std::uint8_t number = 0;                          ///< The link's, for signatures.
    std::uint32_t not_signed = 0;                     ///< Messages that could not be signed.
    bool signature_refusal_said = false;
    std::optional<hal::mavlink::CameraPoseInput> camera_pose;
    bool frame_refusal_said = false;
    hal::mavlink::DistanceQueryInput queries;
    hal::mavlink::CommandInput commands;
  };

  /// An object as a MAVLink component.
  struct Component {
    std::uint8_t id;
    hal::mavlink::TelemetryEncoder encoder;
    TrackingState state = TrackingState::kInitialising;
  };

  void SendHeartbeats(std::int64_t now_ns) noexcept;
  void Broadcast(Expected<std::size_t> size) noexcept;
  /// @return The object that a message is for; a component's 0 means the first.
  [[nodiscard]] std::optional<std::size_t> ObjectOf(std::uint8_t target_component) const noexcept;
  void AnswerQueries(Line& line, const TrackedObjects& objects,
                     std::span<const FrameResult> results) noexcept;
  void ObeyCommands(Line& line, const TrackedObjects& objects) noexcept;
  void ReceiveOn(Line& line, std::int64_t capture_now_ns) noexcept;
  /// What a person should know of refused messages, once.
  void SayRefusals(Line& line) noexcept;
  /// Signs the message if the link has a key.
  void SendOn(Line& line, std::span<const std::byte> message) noexcept;
  void Reopen(std::int64_t now_ns) noexcept;

  Console& console_;
  SigningSessions sessions_;
  std::deque<Line> lines_;
  std::vector<Component> components_;
  std::array<std::byte, hal::mavlink::kMaxFrameSize> buffer_{};
  std::array<std::byte, hal::mavlink::kMaxFrameSize> signed_{};
  bool heartbeat_sent_ = false;
  std::int64_t heartbeat_ns_ = 0;   ///< On the clock.
  StampNs heartbeat_stamp_ns_ = 0;  ///< In the stream.
  StampNs stamp_ns_ = 0;
};

}  // namespace disflow::apps
