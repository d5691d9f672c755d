// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "disflow/hal/mavlink/camera_pose_input.h"
#include "disflow/hal/mavlink/command_input.h"
#include "disflow/hal/mavlink/distance_query_input.h"
#include "disflow/hal/mavlink/frame_decoder.h"
#include "disflow/hal/mavlink/target_telemetry.h"
#include "disflow/hal/mavlink/telemetry.h"
#include "disflow/posix/link.h"
#include "links/link_reader.h"
#include "links/link_stamps.h"
#include "links/signing_sessions.h"
#include "objects/tracked_object.h"
#include "program/console.h"
#include "program/frame_result.h"
#include "settings/options.h"

namespace disflow::apps {

/// One link that carries MAVLink: what is sent on it, on which clock, and what comes in. If it
/// fails that is said once, and it is opened again as soon as that is possible.
class MavlinkLine {
 public:
  /// Does not open the link.
  /// @param number Of the link, for signatures.
  /// @param camera_poses Where the carrier's ODOMETRY goes; null if nothing is received.
  /// @throws Failure kWrongUsage for an address that cannot be parsed, a key that cannot be used,
  /// or a message that needs options which are not given.
  MavlinkLine(const std::string& uri, std::uint8_t number, const Options& options,
              const hal::SensorInfo& sensor, hal::CameraPoseHistory* camera_poses,
              SigningSessions& sessions, Console& console);
  MavlinkLine(const MavlinkLine&) = delete;
  MavlinkLine& operator=(const MavlinkLine&) = delete;

  /// @throws Failure kOutputFailed for a link that cannot be opened.
  void Open();
  void Close() noexcept { link_.get()->Close(); }
  /// A lost link, once per second.
  void Reopen(std::int64_t now_ns) noexcept;

  /// The pose and DISFLOW_STATUS of each object in a frame. Messages whose stamp is not known on
  /// the link's clock are not sent, but counted.
  /// @param results In the order of Options::objects.
  /// @param age_ns From capture to now; negative = unknown.
  void Send(std::span<const FrameResult> results, std::int64_t age_ns,
            const ClockReading& now) noexcept;
  /// What the next HEARTBEATs say.
  void TakeStates(std::span<const FrameResult> results) noexcept;
  /// HEARTBEAT of each object, and SYSTEM_TIME.
  void SendHeartbeats(const ClockReading& now) noexcept;
  /// Asks the autopilot for its clock if that is wanted and due.
  void AskForTime(std::int64_t now_ns) noexcept;
  /// Takes what has come in, a bounded number of bytes, and answers questions for the time.
  /// @param capture_now_ns Now, on the clock of the depth images' stamps.
  void Receive(std::int64_t capture_now_ns) noexcept;
  /// Answers other questions and obeys commands, a bounded number per frame.
  void Answer(const TrackedObjects& objects, std::span<const FrameResult> results) noexcept;

  /// @return What was sent and what was lost, for people.
  [[nodiscard]] std::string Summary();
  [[nodiscard]] bool lost() const noexcept { return lost_; }
  /// What shows input when there is something to receive; -1: nothing.
  [[nodiscard]] int fd() const noexcept { return lost_ ? -1 : link_.fd(); }

 private:
  /// An object as a MAVLink component.
  struct Component {
    std::uint8_t id;
    hal::mavlink::TelemetryEncoder encoder;
    TrackingState state = TrackingState::kInitialising;
  };

  void CheckPose(const std::string& uri, const Options& options) const;
  void SendPose(Component& component, const Estimate& estimate) noexcept;
  template <class Message>
  void SendMessage(Component& component, const Message& message) noexcept;
  void SendOn(std::span<const std::byte> message) noexcept;
  void TakeFrame(const hal::mavlink::FrameView& frame, std::int64_t capture_now_ns) noexcept;
  void AnswerTime(const hal::mavlink::FrameView& frame) noexcept;
  /// @return The object that a message is for; a component's 0 means the first.
  [[nodiscard]] std::optional<std::size_t> ObjectOf(std::uint8_t target_component) const noexcept;
  void AnswerQueries(const TrackedObjects& objects, std::span<const FrameResult> results) noexcept;
  void ObeyCommands(const TrackedObjects& objects) noexcept;
  /// What a person should know of refused messages, once.
  void SayRefusals() noexcept;
  [[nodiscard]] std::string TimeSummary() const;

  Console& console_;
  posix::Link link_;
  LinkReader reader_;
  bool lost_ = false;
  std::int64_t retry_ns_ = 0;
  hal::mavlink::FrameDecoder decoder_;
  hal::mavlink::SigningSession* session_ = nullptr;  ///< Null: nothing is signed or verified.
  std::uint8_t number_;
  std::uint32_t not_signed_ = 0;  ///< Messages that could not be signed.
  bool signature_refusal_said_ = false;
  std::optional<hal::mavlink::CameraPoseInput> camera_pose_;
  bool frame_refusal_said_ = false;
  hal::mavlink::DistanceQueryInput queries_;
  hal::mavlink::CommandInput commands_;
  std::vector<Component> components_;
  hal::mavlink::MavFrame world_;
  Transform<hal::Body, Camera> T_bc_;
  hal::mavlink::EarthOrigin earth_;
  LinkStamps stamps_;
  hal::mavlink::TimeSync time_sync_;
  int time_answers_ = 0;            ///< In this turn.
  std::uint32_t without_time_ = 0;  ///< Frames that were not sent since their stamp is not known.
  std::array<std::byte, hal::mavlink::kMaxFrameSize> buffer_{};
  std::array<std::byte, hal::mavlink::kMaxFrameSize> signed_{};
};

}  // namespace disflow::apps
