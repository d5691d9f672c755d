// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "disflow/hal/byte_link.h"
#include "disflow/hal/depth_stream/packet.h"
#include "disflow/hal/mavlink/frame_decoder.h"
#include "disflow/posix/monotonic_clock.h"

namespace disflow::firmware_test {

/// Sends no more than the board has room for, and goes on when the board has said that it has read
/// that. A real line is slower than the board; an emulated one brings bytes as fast as the
/// interrupt handler takes them, and how much time the program behind it gets is the host's mood.
/// So the board sets the pace: its answer to a poll tells that all before the poll has been read.
class CreditedLine final : public hal::ByteLink {
 public:
  explicit CreditedLine(hal::ByteLink& line) noexcept : line_(line) {}

  /// @param hurried true: sends whether or not the board has room, until this is called again.
  void set_hurried(bool hurried) noexcept { hurried_ = hurried; }

 private:
  static constexpr std::size_t kBoardBuffer_bytes = 512;  // CmsdkUart::kReceiveCapacity
  static constexpr std::size_t kPollRoom_bytes = 16;
  static constexpr std::size_t kWindow_bytes = kBoardBuffer_bytes - kPollRoom_bytes;
  static_assert(hal::depth_stream::kMaxEncodedSize <= kWindow_bytes, "packets stay whole");
  /// Of no frame and of no poll of the sender's.
  static constexpr std::uint32_t kFirstSequence = 0xC0000000;
  static constexpr std::int64_t kPatience_ns = 60'000'000'000;
  /// A board that restarts forgets a poll.
  static constexpr std::int64_t kPollEvery_ns = 2'000'000'000;
  static constexpr std::int64_t kNap_ns = 100'000;

  hal::Fault DoOpen() noexcept override { return line_.Open(); }
  void DoClose() noexcept override { line_.Close(); }

  hal::Fault DoSend(std::span<const std::byte> message) noexcept override {
    while (!message.empty()) {
      const auto part = message.first(std::min(message.size(), kWindow_bytes));
      if (!hurried_ && unread_ + part.size() > kWindow_bytes) {
        const hal::Fault fault = AwaitCredit();
        if (!fault.ok()) return fault;
      }
      const hal::Fault fault = SendNow(part);
      if (!fault.ok()) return fault;
      unread_ += part.size();
      message = message.subspan(part.size());
    }
    return {};
  }

  Expected<std::size_t> DoReceive(std::span<std::byte> buffer) noexcept override {
    const Status status = Listen();
    const std::size_t size = std::min(buffer.size(), received_.size());
    std::copy_n(received_.begin(), size, buffer.begin());
    received_.erase(received_.begin(), received_.begin() + static_cast<std::ptrdiff_t>(size));
    return {size, size > 0 ? Status::kOk : status};
  }

  [[nodiscard]] const char* DoName() const noexcept override { return line_.name(); }
  [[nodiscard]] hal::LinkCounters DoCounters() const noexcept override { return line_.counters(); }

  /// Until the board has read all that was sent.
  hal::Fault AwaitCredit() noexcept {
    ++sequence_;
    const std::int64_t begin_ns = clock_.NowNs();
    std::int64_t poll_ns = begin_ns;
    while (answered_ != sequence_) {
      const std::int64_t now_ns = clock_.NowNs();
      if (now_ns - begin_ns > kPatience_ns) {
        return hal::MakeFault(Status::kTimeout, "%s: the board does not read", line_.name());
      }
      if (now_ns >= poll_ns) {
        poll_ns = now_ns + kPollEvery_ns;
        hal::depth_stream::EncodedPacket packet;
        const hal::Fault fault = SendNow(hal::depth_stream::EncodePoll(sequence_, packet));
        if (!fault.ok()) return fault;
      }
      const Status status = Listen();
      if (status != Status::kOk) return hal::MakeFault(status, "%s: is gone", line_.name());
      if (answered_ != sequence_) clock_.SleepUntilNs(now_ns + kNap_ns);
    }
    unread_ = 0;
    return {};
  }

  /// To the emulator, which takes the bytes when the board's UART has room.
  hal::Fault SendNow(std::span<const std::byte> bytes) noexcept {
    const std::int64_t deadline_ns = clock_.NowNs() + kPatience_ns;
    for (;;) {
      const hal::Fault fault = line_.Send(bytes);
      if (fault.status != Status::kWouldBlock || clock_.NowNs() > deadline_ns) return fault;
      clock_.SleepUntilNs(clock_.NowNs() + kNap_ns);
    }
  }

  /// Keeps what has come for DoReceive(), and looks for answers in it.
  Status Listen() noexcept {
    std::array<std::byte, 1024> piece;
    for (;;) {
      const Expected<std::size_t> size = line_.Receive(piece);
      if (!size.ok() || size.value == 0) return size.status;
      const auto bytes = std::span<const std::byte>(piece).first(size.value);
      received_.insert(received_.end(), bytes.begin(), bytes.end());
      decoder_.ForEachFrame(bytes, nullptr, [this](const hal::mavlink::FrameView& frame) {
        hal::mavlink::DisflowReady ready;
        if (DecodePayload(frame, ready) == Status::kOk) answered_ = ready.sequence;
      });
    }
  }

  hal::ByteLink& line_;
  posix::MonotonicClock clock_;
  hal::mavlink::FrameDecoder decoder_;
  std::vector<std::byte> received_;
  bool hurried_ = false;
  std::size_t unread_ = 0;  ///< Bytes that the board may not have read yet.
  std::uint32_t sequence_ = kFirstSequence;
  std::uint32_t answered_ = 0;
};

}  // namespace disflow::firmware_test
