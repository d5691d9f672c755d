// SPDX-License-Identifier: BSD-3-Clause
#include "links/mavlink_line.h"

#include <cstdio>
#include <utility>

#include "disflow/saturating.h"
#include "disflow/types.h"
#include "links/choice_command.h"
#include "links/link_words.h"
#include "program/exit_status.h"
#include "settings/camera_in_body.h"

namespace disflow::apps {
namespace {

namespace mavlink = hal::mavlink;
using Pose = hal::LinkAddress::Pose;

mavlink::TelemetryOptions EncoderOptions(const Options& options, std::uint8_t object_index) {
  mavlink::TelemetryOptions encoder;
  encoder.object_index = object_index;
  if (options.camera_pose.system_id != 0) encoder.pose_frame = options.camera_pose.world;
  return encoder;
}

mavlink::CameraPoseSource PoseSource(const CameraPoseOptions& options) {
  return {.system_id = static_cast<std::uint8_t>(options.system_id),
          .world = options.world,
          .own_clock = options.own_clock};
}

}  // namespace

MavlinkLine::MavlinkLine(const std::string& uri, std::uint8_t number, const Options& options,
                         const hal::SensorInfo& sensor, hal::CameraPoseHistory* camera_poses,
                         SigningSessions& sessions, Console& console)
    : console_(console),
      number_(number),
      world_(options.camera_pose.world),
      T_bc_(CameraInBody(options.camera_pose).Cast<float>()),
      earth_(static_cast<std::uint8_t>(options.camera_pose.system_id)),
      stamps_((Require(link_.Configure(uri), kWrongUsage), link_.address().stamps), sensor) {
  CheckPose(uri, options);
  for (const ObjectOptions& object : options.objects) {
    components_.push_back(
        {.id = static_cast<std::uint8_t>(mavlink::kFirstComponentId + object.index),
         .encoder = mavlink::TelemetryEncoder(EncoderOptions(options, object.index))});
  }
  if (camera_poses != nullptr) camera_pose_.emplace(PoseSource(options.camera_pose), *camera_poses);
  if (link_.address().key_file[0] != '\0') session_ = &sessions.Open(link_.address().key_file);
}

void MavlinkLine::CheckPose(const std::string& uri, const Options& options) const {
  if (link_.address().pose != Pose::kFollowTarget) return;
  const bool is_geographic =
      world_ == mavlink::MavFrame::kLocalNed || world_ == mavlink::MavFrame::kLocalEnu;
  if (options.camera_pose.system_id != 0 && is_geographic) return;
  throw Failure(kWrongUsage, "--link " + uri +
                                 ": send=follow_target says where on Earth the object is: it needs "
                                 "--camera-pose SYSTEM and --camera-world ned or enu");
}

void MavlinkLine::Open() { Require(link_.get()->Open()); }

void MavlinkLine::Reopen(std::int64_t now_ns) noexcept {
  if (!lost_) return;
  if (retry_ns_ == 0) retry_ns_ = now_ns + kSecond_ns;
  if (now_ns < retry_ns_) return;
  retry_ns_ = now_ns + kSecond_ns;
  if (!link_.get()->Open().ok()) return;
  lost_ = false;
  console_.Say(std::string(link_.get()->name()) + ": is back");
}

void MavlinkLine::Send(std::span<const FrameResult> results, std::int64_t age_ns,
                       const ClockReading& now) noexcept {
  const StampNs capture_ns = results.front().estimate.stamp_ns;
  stamps_.Play(capture_ns, now);
  for (std::size_t i = 0; i < components_.size(); ++i) {
    const FrameResult& result = results[i];
    const std::optional<StampNs> stamp_ns = stamps_.Of(result.estimate.stamp_ns, now, time_sync_);
    if (!stamp_ns) {
      AddSaturating(without_time_);
      continue;
    }
    Estimate estimate = result.estimate;
    estimate.stamp_ns = *stamp_ns;
    SendPose(components_[i], estimate);
    const mavlink::SendContext context{
        .age_ns = age_ns, .sensor = result.sensor, .totals = result.totals};
    SendMessage(components_[i], mavlink::MakeStatus(estimate, context));
  }
}

void MavlinkLine::SendPose(Component& component, const Estimate& estimate) noexcept {
  switch (link_.address().pose) {
    case Pose::kOdometry: {
      const auto size = component.encoder.EncodeOdometry(estimate, buffer_);
      return SendOn(std::span(buffer_).first(size.value));
    }
    case Pose::kLandingTarget: {
      const auto number = static_cast<std::uint8_t>(component.id - mavlink::kFirstComponentId);
      const auto target = mavlink::MakeLandingTarget(estimate, T_bc_, world_, number);
      if (target.ok()) SendMessage(component, target.value);
      return;
    }
    case Pose::kFollowTarget: {
      const auto target = mavlink::MakeFollowTarget(estimate, world_, earth_);
      if (target.ok()) SendMessage(component, target.value);
      return;
    }
  }
}

void MavlinkLine::TakeStates(std::span<const FrameResult> results) noexcept {
  for (std::size_t i = 0; i < components_.size(); ++i) {
    components_[i].state = results[i].estimate.state;
  }
}

void MavlinkLine::SendHeartbeats(const ClockReading& now) noexcept {
  for (Component& component : components_) {
    SendMessage(component, mavlink::MakeHeartbeat(component.state));
  }
  SendMessage(components_.front(), mavlink::MakeSystemTime(now.monotonic_ns, now.epoch_ns));
}

void MavlinkLine::AskForTime(std::int64_t now_ns) noexcept {
  mavlink::TimeSyncMessage question;
  if (!stamps_.wants_autopilot() || lost_ || !time_sync_.Ask(now_ns, question)) return;
  SendMessage(components_.front(), question);
}

template <class Message>
void MavlinkLine::SendMessage(Component& component, const Message& message) noexcept {
  // The buffer holds every message, so encoding cannot fail.
  const auto size = component.encoder.EncodeMessage(message, buffer_);
  SendOn(std::span(buffer_).first(size.value));
}

void MavlinkLine::SendOn(std::span<const std::byte> message) noexcept {
  if (lost_) return;
  if (session_ != nullptr) {
    const auto size = session_->Sign(message, number_, signed_);
    // Only if a peer has used up all times that there are; unsigned it must not go out.
    if (!size.ok()) return AddSaturating(not_signed_);
    message = std::span(signed_).first(size.value);
  }
  const hal::Fault fault = link_.get()->Send(message);
  // A full buffer is counted by the link itself and is no reason to open it anew.
  if (fault.ok() || fault.status == Status::kWouldBlock) return;
  lost_ = true;
  retry_ns_ = 0;
  console_.Say(std::string(fault.message) +
               "; tracking goes on, the link is tried again every second");
}

void MavlinkLine::Receive(std::int64_t capture_now_ns) noexcept {
  if (lost_) return;
  time_answers_ = 0;
  decoder_.ForEachFrame(reader_.Read(*link_.get()), session_,
                        [&](const mavlink::FrameView& frame) { TakeFrame(frame, capture_now_ns); });
  SayRefusals();
}

void MavlinkLine::TakeFrame(const mavlink::FrameView& frame, std::int64_t capture_now_ns) noexcept {
  if (frame.message_id == mavlink::TimeSyncMessage::kId) return AnswerTime(frame);
  queries_.Take(frame);
  commands_.Take(frame);
  earth_.Take(frame);
  if (camera_pose_) camera_pose_->Take(frame, capture_now_ns);
}

void MavlinkLine::AnswerTime(const mavlink::FrameView& frame) noexcept {
  // More than all who share a link ask between two frames.
  constexpr int kMostAnswers = 8;
  const ClockReading now = ReadClocks();
  mavlink::TimeSyncMessage question;
  if (!mavlink::IsTimeQuestion(frame, question)) return time_sync_.Take(frame, now.monotonic_ns);
  const std::optional<StampNs> own_ns = stamps_.Now(now, time_sync_);
  if (!own_ns || ++time_answers_ > kMostAnswers) return;
  SendMessage(components_.front(), mavlink::AnswerTo(question, frame.header, *own_ns));
}

void MavlinkLine::SayRefusals() noexcept {
  // Not while nothing changes: this runs once per frame.
  if (!signature_refusal_said_) {
    const std::string refused = NotAuthentic(decoder_.counters());
    signature_refusal_said_ = !refused.empty();
    if (!refused.empty()) {
      console_.Say(std::string(link_.get()->name()) + ": messages are left out" + refused +
                   "; do both ends sign with the same key, and are their clocks right?");
    }
  }
  if (!camera_pose_ || camera_pose_->refused_frame() == 0 || frame_refusal_said_) return;
  frame_refusal_said_ = true;
  console_.Say(std::string(link_.get()->name()) + ": ODOMETRY with frame_id " +
               std::to_string(camera_pose_->refused_frame()) +
               " is not in the frame that --camera-world names and is left out");
}

void MavlinkLine::Answer(const TrackedObjects& objects,
                         std::span<const FrameResult> results) noexcept {
  AnswerQueries(objects, results);
  ObeyCommands(objects);
}

std::optional<std::size_t> MavlinkLine::ObjectOf(std::uint8_t target_component) const noexcept {
  if (target_component == 0) return 0;
  for (std::size_t i = 0; i < components_.size(); ++i) {
    if (components_[i].id == target_component) return i;
  }
  return std::nullopt;
}

void MavlinkLine::AnswerQueries(const TrackedObjects& objects,
                                std::span<const FrameResult> results) noexcept {
  if (queries_.waiting().empty()) return;
  const ClockReading now = ReadClocks();
  for (const mavlink::DisflowQuery& query : queries_.waiting()) {
    const std::optional<std::size_t> i = ObjectOf(query.target_component);
    if (!i) continue;
    const auto stamp_ns = stamps_.Of(results[*i].estimate.stamp_ns, now, time_sync_);
    if (!stamp_ns) continue;
    SendMessage(components_[*i], mavlink::AnswerQuery(query, *stamp_ns, [&](const Vec3& x_m) {
                  return objects[*i]->Query(x_m);
                }));
  }
  queries_.Clear();
}

void MavlinkLine::ObeyCommands(const TrackedObjects& objects) noexcept {
  using mavlink::CommandAck;
  for (const mavlink::ReceivedCommand& received : commands_.waiting()) {
    const std::optional<std::size_t> i = ObjectOf(received.command.target_component);
    if (!i) continue;
    std::uint8_t result = CommandAck::kUnsupported;
    if (IsChoiceCommand(received.command)) {
      std::optional<ObjectChoice> choice = ChoiceOf(received.command);
      const bool obeyed = link_.address().may_choose && choice.has_value();
      if (obeyed) objects[*i]->channel().Choose(std::move(*choice));
      result = obeyed ? CommandAck::kAccepted : CommandAck::kDenied;
    }
    SendMessage(components_[*i], mavlink::AnswerTo(received, result));
  }
  commands_.Clear();
}

std::string MavlinkLine::Summary() {
  const hal::ByteLink& link = *link_.get();
  const hal::LinkCounters counters = link.counters();
  return std::string(link.name()) + ": " + std::to_string(counters.sent_messages) +
         " messages sent, " + std::to_string(counters.dropped_messages) + " dropped, " +
         std::to_string(counters.refused_messages) + " refused, " +
         std::to_string(counters.reconnects) + " reconnects" + NotSigned(not_signed_) +
         NotAuthentic(decoder_.counters()) + LeftOut(reader_.dropped_bytes()) + TimeSummary() +
         (lost_ ? ", lost" : "");
}

std::string MavlinkLine::TimeSummary() const {
  std::string text;
  if (stamps_.wants_autopilot()) {
    text += ClockWords(time_sync_.OffsetAt(ReadClocks().monotonic_ns), time_sync_.restarts());
  }
  if (without_time_ > 0) {
    text += ", " + std::to_string(without_time_) + " poses not sent since their stamp is not known";
  }
  return text;
}

}  // namespace disflow::apps
