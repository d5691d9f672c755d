// SPDX-License-Identifier: BSD-3-Clause
#include "board_connection.h"

#include <algorithm>
#include <array>

namespace disflow::apps {
namespace {

using namespace hal::depth_stream;
using hal::mavlink::DecodePayload;

constexpr std::int64_t kNap_ns = 100'000;
constexpr std::int64_t kPollEvery_ns = 500'000'000;
constexpr std::int64_t kSendPatience_ns = 10'000'000'000;

void Append(std::vector<std::vector<std::byte>>& packets, std::span<const std::byte> packet) {
  packets.emplace_back(packet.begin(), packet.end());
}

}  // namespace

std::vector<std::vector<std::byte>> BoardConnection::Packets(const DepthFrame& frame,
                                                             std::uint32_t sequence) {
  std::vector<std::vector<std::byte>> packets;
  EncodedPacket buffer;
  const DepthView& depth = frame.depth;
  const FrameStart start{.stamp_ns = frame.stamp_ns,
                         .width_px = static_cast<std::uint16_t>(depth.width_px),
                         .height_px = static_cast<std::uint16_t>(depth.height_px),
                         .unit_m = depth.unit_m,
                         .camera = frame.camera};
  Append(packets, EncodeStart(sequence, start, buffer));
  std::uint32_t index = 0;
  for (int v = 0; v < depth.height_px; ++v) {
    const auto* const row = reinterpret_cast<const std::uint16_t*>(depth.row(v));
    std::span<const std::uint16_t> rest(row, static_cast<std::size_t>(depth.width_px));
    while (!rest.empty()) {
      const auto part = rest.first(std::min(rest.size(), kMaxPixelsPerPacket));
      Append(packets, EncodePixels(sequence, index, part, buffer));
      index += static_cast<std::uint32_t>(part.size());
      rest = rest.subspan(part.size());
    }
  }
  Append(packets, EncodeEnd(sequence, buffer));
  return packets;
}

hal::Fault BoardConnection::Track(const DepthFrame& frame, std::int64_t timeout_ns,
                                  BoardAnswer& answer) {
  return TrackPackets(NextPackets(frame), timeout_ns, answer);
}

hal::Fault BoardConnection::TrackPackets(const std::vector<std::vector<std::byte>>& packets,
                                         std::int64_t timeout_ns, BoardAnswer& answer) {
  awaited_ = ++sequence_;
  answer = {};
  for (const std::vector<std::byte>& packet : packets) {
    const hal::Fault fault = SendAll(packet);
    if (!fault.ok()) return fault;
  }
  return Await(timeout_ns, true, answer);
}

hal::Fault BoardConnection::WaitUntilReady(std::int64_t timeout_ns) {
  EncodedPacket buffer;
  awaited_ = ++sequence_;
  const hal::Fault fault = SendAll(EncodePoll(sequence_, buffer));
  BoardAnswer answer;
  return fault.ok() ? Await(timeout_ns, true, answer) : fault;
}

hal::Fault BoardConnection::SetBudgets(const TimeBudgets& budgets) {
  EncodedPacket buffer;
  return SendAll(EncodeBudgets(sequence_, budgets, buffer));
}

hal::Fault BoardConnection::SendAll(std::span<const std::byte> bytes) {
  const std::int64_t deadline_ns = clock_.NowNs() + kSendPatience_ns;
  for (;;) {
    const hal::Fault fault = link_.Send(bytes);
    if (fault.status != Status::kWouldBlock || clock_.NowNs() > deadline_ns) return fault;
    clock_.SleepUntilNs(clock_.NowNs() + kNap_ns);
  }
}

hal::Fault BoardConnection::AwaitRecorded(std::uint32_t sequence, std::int64_t timeout_ns,
                                          BoardAnswer& answer) {
  sequence_ = sequence;
  awaited_ = sequence;
  answer = {};
  return Await(timeout_ns, false, answer);
}

hal::Fault BoardConnection::Await(std::int64_t timeout_ns, bool poll, BoardAnswer& answer) {
  const std::int64_t begin_ns = clock_.NowNs();
  std::int64_t next_poll_ns = begin_ns + kPollEvery_ns;
  for (;;) {
    bool ready = false;
    const hal::Fault fault = Receive(answer, ready);
    if (!fault.ok() || ready) return fault;
    const std::int64_t now_ns = clock_.NowNs();
    if (now_ns - begin_ns > timeout_ns) {
      return hal::MakeFault(Status::kTimeout,
                            "%s: the controller does not answer; is disflow_firmware on it, and do "
                            "both ends have the same baud rate?",
                            link_.name());
    }
    if (poll && now_ns > next_poll_ns) {
      // The end of the frame, or the answer to it, may have been lost.
      next_poll_ns = now_ns + kPollEvery_ns;
      EncodedPacket buffer;
      const hal::Fault polled = SendAll(EncodePoll(++sequence_, buffer));
      if (!polled.ok()) return polled;
    }
    clock_.SleepUntilNs(now_ns + kNap_ns);
  }
}

hal::Fault BoardConnection::Receive(BoardAnswer& answer, bool& ready) {
  hal::mavlink::FrameView frame;
  for (;;) {
    while (decoder_.Next(frame)) {
      if (Take(frame, answer)) {
        ready = true;
        return {};
      }
    }
    if (rest_.empty()) {
      const Expected<std::size_t> size = link_.Receive(received_);
      if (!size.ok()) {
        return hal::MakeFault(size.status, "%s: %s", link_.name(), Describe(size.status));
      }
      if (size.value == 0) return {};
      rest_ = std::span<const std::byte>(received_).first(size.value);
    }
    rest_ = rest_.subspan(decoder_.Feed(rest_));
  }
}

bool BoardConnection::Take(const hal::mavlink::FrameView& frame, BoardAnswer& answer) const {
  if (DecodePayload(frame, answer.odometry) == Status::kOk) {
    answer.tracked = true;
    return false;
  }
  if (DecodePayload(frame, answer.ready) == Status::kOk) {
    // The answer to any poll since then will do: a slow controller is always behind the newest.
    return answer.ready.sequence - awaited_ <= sequence_ - awaited_;
  }
  if (DecodePayload(frame, answer.status) != Status::kOk) {
    (void)DecodePayload(frame, answer.timing);  // other messages are of no interest here
  }
  return false;
}

}  // namespace disflow::apps
