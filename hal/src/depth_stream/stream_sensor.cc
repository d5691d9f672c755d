// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/depth_stream/stream_sensor.h"

#include <cmath>

#include "disflow/hal/mavlink/frame.h"
#include "disflow/hal/mavlink/telemetry.h"
#include "disflow/saturating.h"

namespace disflow::hal::depth_stream {

Fault StreamSensor::DoNext(std::int64_t timeout_ns, DepthFrame& frame) noexcept {
  SendReady();
  const std::int64_t deadline_ns = clock_.NowNs() + timeout_ns;
  PacketView packet;
  for (;;) {
    while (chunk_next_ < chunk_end_) {
      if (!decoder_.Push(chunk_[chunk_next_++], packet)) continue;
      switch (Handle(packet)) {
        case Outcome::kNothing:
          break;
        case Outcome::kFrame:
          Describe(frame);
          return {};
        case Outcome::kLost:
          return {.status = Status::kCorrupt};
      }
    }
    const Expected<std::size_t> received = link_.Receive(chunk_);
    if (!received.ok()) return {.status = received.status};
    chunk_next_ = 0;
    chunk_end_ = received.value;
    // Also if there are bytes: they may be endless garbage. The next call goes on with them.
    if (clock_.NowNs() >= deadline_ns) return {.status = Status::kTimeout};
  }
}

StreamSensor::Outcome StreamSensor::Handle(const PacketView& packet) noexcept {
  switch (packet.type) {
    case PacketType::kStart:
      Begin(packet);
      break;
    case PacketType::kPixels:
      if (state_ == State::kReceiving &&
          (packet.sequence != sequence_ || !DecodePixels(packet.payload, image_, next_pixel_))) {
        state_ = State::kBroken;
      }
      break;
    case PacketType::kEnd:
      answered_ = packet.sequence;
      return End(packet.sequence);
    case PacketType::kPoll:
      answered_ = packet.sequence;
      SendReady();
      break;
    case PacketType::kBudgets:
      (void)DecodeBudgets(packet.payload, budgets_);  // of another size: from a newer sender
      break;
  }
  return Outcome::kNothing;
}

void StreamSensor::Begin(const PacketView& packet) noexcept {
  if (state_ != State::kIdle) AddSaturating(lost_);  // its end never came
  sequence_ = packet.sequence;
  next_pixel_ = 0;
  const bool readable = DecodeStart(packet.payload, start_);
  const std::size_t pixels = std::size_t{start_.width_px} * start_.height_px;
  const bool fits = pixels > 0 && pixels <= image_.size();
  const bool has_unit = start_.unit_m > 0.0F && std::isfinite(start_.unit_m);
  const bool has_camera =
      start_.camera.IsValid() && start_.camera.CanImage(start_.width_px, start_.height_px);
  state_ = readable && fits && has_unit && has_camera ? State::kReceiving : State::kRefused;
}

StreamSensor::Outcome StreamSensor::End(std::uint32_t sequence) noexcept {
  const State state = state_;
  state_ = State::kIdle;
  if (state == State::kRefused) {
    AddSaturating(refused_);
    return Outcome::kLost;
  }
  if (state == State::kReceiving && sequence == sequence_ &&
      next_pixel_ == std::size_t{start_.width_px} * start_.height_px) {
    AddSaturating(frames_);
    return Outcome::kFrame;
  }
  AddSaturating(lost_);
  return Outcome::kLost;
}

void StreamSensor::Describe(DepthFrame& frame) const noexcept {
  frame = {};
  frame.depth = {image_.data(),        start_.width_px,
                 start_.height_px,     start_.width_px * std::ptrdiff_t{2},
                 DepthFormat::kUint16, start_.unit_m};
  frame.camera = start_.camera;
  frame.stamp_ns = start_.stamp_ns;
}

void StreamSensor::SendReady() noexcept {
  const PacketCounters& packets = decoder_.counters();
  const mavlink::DisflowReady ready{.sequence = answered_,
                                    .frames = frames_,
                                    .frames_lost = lost_,
                                    .frames_refused = refused_,
                                    .packets = packets.packets,
                                    .packets_corrupt = packets.corrupt,
                                    .bytes_lost = link_.counters().overrun_bytes};
  const mavlink::FrameHeader header{.sequence = message_sequence_++,
                                    .system_id = mavlink::TelemetryOptions{}.system_id,
                                    .component_id = kComponentId};
  std::array<std::byte, mavlink::kFrameSize<mavlink::DisflowReady>> bytes{};
  const Expected<std::size_t> size = mavlink::EncodeFrame(ready, header, bytes);
  // A message that the line cannot take is counted by the line; the sender will poll.
  (void)link_.Send(std::span<const std::byte>(bytes).first(size.value));
}

SensorInfo StreamSensor::DoInfo() const noexcept {
  return {.name = "depth stream", .width_px = start_.width_px, .height_px = start_.height_px};
}

SensorCounters StreamSensor::DoCounters() const noexcept {
  return {.frames = frames_, .corrupt = lost_ + refused_, .short_frames = lost_};
}

}  // namespace disflow::hal::depth_stream
