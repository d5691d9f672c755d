// SPDX-License-Identifier: BSD-3-Clause
#include "links/telemetry_output.h"

#include <utility>

#include "disflow/saturating.h"
#include "links/choice_command.h"
#include "program/exit_status.h"

namespace disflow::apps {
namespace {

using hal::ByteLink;
using hal::Fault;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

hal::mavlink::TelemetryOptions EncoderOptions(const Options& options, std::uint8_t object_index) {
  hal::mavlink::TelemetryOptions encoder;
  encoder.object_index = object_index;
  if (options.camera_pose.system_id != 0) encoder.pose_frame = options.camera_pose.world;
  return encoder;
}

hal::mavlink::CameraPoseSource PoseSource(const CameraPoseOptions& options) {
  return {.system_id = static_cast<std::uint8_t>(options.system_id),
          .world = options.world,
          .own_clock = options.own_clock};
}

std::string LeftOut(std::uint64_t bytes) {
  return bytes == 0 ? "" : ", " + std::to_string(bytes) + " received bytes left out as too many";
}

std::string NotSigned(std::uint32_t messages) {
  return messages == 0 ? "" : ", " + std::to_string(messages) + " not signed and not sent";
}

/// What was not authentic, each kind if there was any.
std::string Refused(const hal::mavlink::DecoderCounters& counters) {
  std::string text;
  const auto add = [&text](std::uint32_t count, const char* what) {
    if (count != 0) text += ", " + std::to_string(count) + " received " + what;
  };
  add(counters.without_signature, "unsigned");
  add(counters.wrong_signature, "with a wrong signature");
  add(counters.replayed, "replayed");
  add(counters.outdated, "more than a minute old");
  add(counters.streams_refused, "of too many senders");
  return text;
}

}  // namespace

TelemetryOutput::TelemetryOutput(const Options& options, hal::CameraPoseHistory* camera_poses,
                                 Console& console)
    : console_(console), sessions_(hal::mavlink::TelemetryOptions{}.system_id, console) {
  for (const ObjectOptions& object : options.objects) {
    components_.push_back(
        {.id = static_cast<std::uint8_t>(hal::mavlink::kFirstComponentId + object.index),
         .encoder = hal::mavlink::TelemetryEncoder(EncoderOptions(options, object.index))});
  }
  for (const std::string& uri : options.links) {
    Line& line = lines_.emplace_back();
    if (camera_poses != nullptr) {
      line.camera_pose.emplace(PoseSource(options.camera_pose), *camera_poses);
    }
    Require(line.link.Configure(uri), kWrongUsage);
    line.number = static_cast<std::uint8_t>(lines_.size() - 1);
    if (!line.link.key_file().empty()) line.session = &sessions_.Open(line.link.key_file());
  }
  for (Line& line : lines_) Require(line.link.get()->Open());
}

TelemetryOutput::~TelemetryOutput() {
  for (Line& line : lines_) line.link.get()->Close();
}

void TelemetryOutput::Send(std::span<const FrameResult> results, std::int64_t age_ns,
                           std::int64_t now_ns) noexcept {
  if (lines_.empty()) return;
  sessions_.Advance();
  Reopen(now_ns);
  for (std::size_t i = 0; i < components_.size(); ++i)
    components_[i].state = results[i].estimate.state;
  stamp_ns_ = results.front().estimate.stamp_ns;
  // In a replay at full speed a second of the stream passes sooner than one on the clock.
  if (!heartbeat_sent_ || now_ns - heartbeat_ns_ >= kSecond_ns ||
      stamp_ns_ - heartbeat_stamp_ns_ >= kSecond_ns) {
    SendHeartbeats(now_ns);
  }
  for (std::size_t i = 0; i < components_.size(); ++i) {
    const FrameResult& result = results[i];
    Broadcast(components_[i].encoder.EncodeOdometry(result.estimate, buffer_));
    const hal::mavlink::SendContext context{
        .age_ns = age_ns, .sensor = result.sensor, .totals = result.totals};
    Broadcast(components_[i].encoder.EncodeStatus(result.estimate, context, buffer_));
  }
}

void TelemetryOutput::Receive(std::int64_t capture_now_ns) noexcept {
  sessions_.Advance();
  for (Line& line : lines_) {
    if (!line.lost) ReceiveOn(line, capture_now_ns);
  }
}

void TelemetryOutput::ReceiveOn(Line& line, std::int64_t capture_now_ns) noexcept {
  line.decoder.ForEachFrame(line.reader.Read(*line.link.get()), line.session,
                            [&](const hal::mavlink::FrameView& frame) {
                              line.queries.Take(frame);
                              line.commands.Take(frame);
                              if (line.camera_pose) line.camera_pose->Take(frame, capture_now_ns);
                            });
  SayRefusals(line);
}

void TelemetryOutput::SayRefusals(Line& line) noexcept {
  // Not while nothing changes: this runs once per frame.
  if (!line.signature_refusal_said) {
    const std::string refused = Refused(line.decoder.counters());
    line.signature_refusal_said = !refused.empty();
    if (!refused.empty()) {
      console_.Say(std::string(line.link.get()->name()) + ": messages are left out" + refused +
                   "; do both ends sign with the same key, and are their clocks right?");
    }
  }
  if (!line.camera_pose || line.camera_pose->refused_frame() == 0 || line.frame_refusal_said)
    return;
  line.frame_refusal_said = true;
  console_.Say(std::string(line.link.get()->name()) + ": ODOMETRY with frame_id " +
               std::to_string(line.camera_pose->refused_frame()) +
               " is not in the frame that --camera-world names and is left out");
}

void TelemetryOutput::Answer(const TrackedObjects& objects,
                             std::span<const FrameResult> results) noexcept {
  for (Line& line : lines_) {
    AnswerQueries(line, objects, results);
    ObeyCommands(line, objects);
  }
}

std::optional<std::size_t> TelemetryOutput::ObjectOf(std::uint8_t target_component) const noexcept {
  if (target_component == 0) return 0;
  for (std::size_t i = 0; i < components_.size(); ++i) {
    if (components_[i].id == target_component) return i;
  }
  return std::nullopt;
}

void TelemetryOutput::AnswerQueries(Line& line, const TrackedObjects& objects,
                                    std::span<const FrameResult> results) noexcept {
  for (const hal::mavlink::DisflowQuery& query : line.queries.waiting()) {
    const std::optional<std::size_t> i = ObjectOf(query.target_component);
    if (!i) continue;
    const auto answer =
        hal::mavlink::AnswerQuery(query, results[*i].estimate.stamp_ns,
                                  [&](const Vec3& x_m) { return objects[*i]->Query(x_m); });
    // The buffer holds every message, so encoding cannot fail.
    const auto size = components_[*i].encoder.EncodeMessage(answer, buffer_);
    SendOn(line, std::span(buffer_).first(size.value));
  }
  line.queries.Clear();
}

void TelemetryOutput::ObeyCommands(Line& line, const TrackedObjects& objects) noexcept {
  using hal::mavlink::CommandAck;
  for (const hal::mavlink::ReceivedCommand& received : line.commands.waiting()) {
    const std::optional<std::size_t> i = ObjectOf(received.command.target_component);
    if (!i) continue;
    std::uint8_t result = CommandAck::kUnsupported;
    if (IsChoiceCommand(received.command)) {
      std::optional<ObjectChoice> choice = ChoiceOf(received.command);
      const bool obeyed = line.link.may_choose() && choice.has_value();
      if (obeyed) objects[*i]->channel().Choose(std::move(*choice));
      result = obeyed ? CommandAck::kAccepted : CommandAck::kDenied;
    }
    const auto size =
        components_[*i].encoder.EncodeMessage(hal::mavlink::AnswerTo(received, result), buffer_);
    SendOn(line, std::span(buffer_).first(size.value));
  }
  line.commands.Clear();
}

void TelemetryOutput::KeepAlive(std::int64_t now_ns) noexcept {
  if (lines_.empty()) return;
  sessions_.Advance();
  Reopen(now_ns);
  if (!heartbeat_sent_ || now_ns - heartbeat_ns_ >= kSecond_ns) SendHeartbeats(now_ns);
}

void TelemetryOutput::SendHeartbeats(std::int64_t now_ns) noexcept {
  heartbeat_sent_ = true;
  heartbeat_ns_ = now_ns;
  heartbeat_stamp_ns_ = stamp_ns_;
  for (Component& component : components_)
    Broadcast(component.encoder.EncodeHeartbeat(component.state, buffer_));
}

void TelemetryOutput::Broadcast(Expected<std::size_t> size) noexcept {
  // The buffer holds every message, so encoding cannot fail.
  if (!size.ok()) return;
  for (Line& line : lines_) SendOn(line, std::span(buffer_).first(size.value));
}

void TelemetryOutput::SendOn(Line& line, std::span<const std::byte> message) noexcept {
  if (line.lost) return;
  if (line.session != nullptr) {
    const auto size = line.session->Sign(message, line.number, signed_);
    // Only if a peer has used up all times that there are; unsigned it must not go out.
    if (!size.ok()) return AddSaturating(line.not_signed);
    message = std::span(signed_).first(size.value);
  }
  const Fault fault = line.link.get()->Send(message);
  // A full buffer is counted by the link itself and is no reason to open it anew.
  if (fault.ok() || fault.status == Status::kWouldBlock) return;
  line.lost = true;
  line.retry_ns = 0;
  console_.Say(std::string(fault.message) +
               "; tracking goes on, the link is tried again every second");
}

void TelemetryOutput::Reopen(std::int64_t now_ns) noexcept {
  for (Line& line : lines_) {
    if (!line.lost) continue;
    if (line.retry_ns == 0) line.retry_ns = now_ns + kSecond_ns;
    if (now_ns < line.retry_ns) continue;
    line.retry_ns = now_ns + kSecond_ns;
    if (!line.link.get()->Open().ok()) continue;
    line.lost = false;
    console_.Say(std::string(line.link.get()->name()) + ": is back");
  }
}

std::vector<std::string> TelemetryOutput::Summary() {
  std::vector<std::string> summary;
  for (Line& line : lines_) {
    const ByteLink& link = *line.link.get();
    const hal::LinkCounters counters = link.counters();
    summary.push_back(std::string(link.name()) + ": " + std::to_string(counters.sent_messages) +
                      " messages sent, " + std::to_string(counters.dropped_messages) +
                      " dropped, " + std::to_string(counters.refused_messages) + " refused, " +
                      std::to_string(counters.reconnects) + " reconnects" +
                      NotSigned(line.not_signed) + Refused(line.decoder.counters()) +
                      LeftOut(line.reader.dropped_bytes()) + (line.lost ? ", lost" : ""));
  }
  return summary;
}

bool TelemetryOutput::AnyLost() const noexcept {
  for (const Line& line : lines_) {
    if (line.lost) return true;
  }
  return false;
}

}  // namespace disflow::apps
