// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "disflow/hal/mavlink/frame_decoder.h"

namespace {

using namespace disflow;
using namespace disflow::hal::mavlink;

void Require(bool condition) {
  if (!condition) std::abort();
}

/// What was decoded must be encodable and decode to the same again.
template <class Message>
void CheckRoundTrip(const FrameView& frame) {
  Message message;
  if (DecodePayload(frame, message) != Status::kOk) return;
  std::array<std::byte, kMaxFrameSize> first{};
  const auto first_size = EncodeFrame(message, frame.header, first);
  Require(first_size.ok());
  FrameDecoder decoder;
  FrameView again;
  Require(decoder.Feed(std::span(first).first(first_size.value)) == first_size.value);
  Require(decoder.Next(again));
  Message second_message;
  Require(DecodePayload(again, second_message) == Status::kOk);
  std::array<std::byte, kMaxFrameSize> second{};
  Require(EncodeFrame(second_message, frame.header, second).value == first_size.value);
  Require(first == second);
}

}  // namespace

/// The first byte chooses the size of the pieces; the rest is the stream.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  const std::size_t step = 1U + data[0];
  auto bytes = std::as_bytes(std::span(data + 1, size - 1));
  FrameDecoder decoder;
  FrameView frame;
  std::size_t fed = 0;
  while (!bytes.empty()) {
    const std::size_t taken = decoder.Feed(bytes.first(std::min(step, bytes.size())));
    Require(taken > 0);
    fed += taken;
    bytes = bytes.subspan(taken);
    while (decoder.Next(frame)) {
      CheckRoundTrip<Heartbeat>(frame);
      CheckRoundTrip<Odometry>(frame);
      CheckRoundTrip<DisflowStatus>(frame);
    }
  }
  Require(decoder.counters().skipped_bytes <= fed);

  // The same bytes taken as a payload.
  frame = {};
  frame.payload = std::as_bytes(std::span(data, std::min(size, kMaxPayloadSize)));
  for (const std::uint32_t id : {Heartbeat::kId, Odometry::kId, DisflowStatus::kId}) {
    frame.message_id = id;
    CheckRoundTrip<Heartbeat>(frame);
    CheckRoundTrip<Odometry>(frame);
    CheckRoundTrip<DisflowStatus>(frame);
  }
  return 0;
}
